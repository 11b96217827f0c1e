// From states of the shape to edits of nodes: which nodes move, come and go.
#pragma once

#include "core/export/apply_mesh.h"
#include "core/export/apply_options.h"

namespace parsel::apply {

struct NodeEdits {
  std::vector<NodeEdit> nodes;  ///< every node of the scene with a mesh that the edit may concern, ascending
  bool any = false;             ///< whether the file changes at all
};

/// Reads what the state makes of every part. Instances beyond the file's nodes get new nodes beside the first instance:
/// placed there when they are moved copies of it, else with its transform and a mesh of their own. Error: a shape or
/// state that is not of this file, corners that are not finite.
Result<NodeEdits> plan_nodes(gltf::File& file, gltf::Scene& scene, const Shape& shape, const State& state,
                             const ApplyOptions& options, std::vector<Warning>& warnings);

/// Takes out of the scene the nodes that show nothing any more, and the groups that this leaves empty. A node that is
/// needed for its children only loses its mesh.
void remove_nodes(gltf::File& file, gltf::Scene& scene, const std::vector<NodeEdit>& edits,
                  std::vector<Warning>& warnings);

}  // namespace parsel::apply
