// The mesh of a part: what the importer reads, what the abstraction looks at, and what an edit later moves.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "core/base/geometry.h"

namespace parsel {

using Mat4 = Eigen::Matrix4d;

/// Vertex indices of one triangle.
using Triangle = std::array<std::uint32_t, 3>;

/// One primitive of one node's mesh. Instances of a mesh are parts of their own, each with its own copy.
struct PartMesh {
  std::string label;              ///< as given in the file, without counters
  std::string name;               ///< as given in the file
  int node = -1;                  ///< glTF node index
  int primitive = -1;             ///< index of the primitive in the node's mesh
  Mat4 world = Mat4::Identity();  ///< of the node, column vectors, in model units: model = world · (x, y, z, 1)
  /// Element i is element i of the POSITION accessor (sparse, normalised and quantised values resolved), times `world`,
  /// in the normalised frame. A vertex that is not finite in the file is NaN here; no triangle uses it.
  std::vector<Vec3> positions;
  /// Strips and fans are unrolled; degenerate triangles of a strip and triangles with a non-finite vertex are left out.
  std::vector<Triangle> triangles;
};

}  // namespace parsel
