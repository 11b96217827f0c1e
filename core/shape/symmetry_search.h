// What the searches for rings, rows and mirror images share: the parts, what is found so far, and their comparisons.
#pragma once

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "core/base/geometry.h"
#include "core/base/index.h"
#include "core/shape/congruence.h"
#include "core/shape/hexahedron.h"
#include "core/shape/symmetry.h"

namespace parsel {

using Parts = std::vector<PartIndex>;

/// Splits parts into sets whose members agree with the set's first.
template <class Agree>
std::vector<Parts> classes(const Parts& parts, const Agree& agree) {
  std::vector<Parts> sets;
  for (const PartIndex p : parts) {
    const auto set = std::find_if(sets.begin(), sets.end(), [&](const Parts& s) { return agree(s.front(), p); });
    if (set == sets.end()) {
      sets.push_back({p});
    } else {
      set->push_back(p);
    }
  }
  return sets;
}

class SymmetrySearch {
 public:
  static constexpr std::size_t none = static_cast<std::size_t>(-1);

  SymmetrySearch(const PartData<PartMesh>& meshes, const PartData<Hexahedron>& part_boxes,
                 const SymmetryOptions& tolerances)
      : boxes(part_boxes), options(tolerances), congruence(meshes, tolerances), group_of_(meshes.size(), none) {}

  /// The searches add what they find among parts of one kind. Rings go before rows, rows before mirror images.
  void find_rings(const Parts& kind);
  void find_rows(const Parts& kind);
  void find_reflections(const Parts& kind);

  std::size_t group_of(PartIndex p) const { return group_of_[p]; }
  bool is_free(PartIndex p) const { return group_of_[p] == none; }
  Parts free_of(const Parts& parts) const;
  void add_group(SymmetryGroup group);

  const Vec3& centre(PartIndex p) const { return congruence.centre(p); }
  /// Extents along the axes agree.
  bool same_extents(PartIndex a, PartIndex b) const;
  /// Boxes have the same sides in some order, and the surfaces about the same area: what turning does not change.
  bool same_size(PartIndex a, PartIndex b) const;
  /// Whether b is the image of a about coordinate[axis] = offset, surfaces included.
  bool mirrors(PartIndex a, PartIndex b, int axis, double offset);

  const PartData<Hexahedron>& boxes;
  const SymmetryOptions& options;
  Congruence congruence;
  Symmetries found;

 private:
  PartData<std::size_t> group_of_;  ///< index into found.groups, or none
};

/// diag(1, 1, 1) with -1 at `axis`.
Mat3 mirror_matrix(int axis);
/// Turned by k · 2π/n about the axis.
Mat3 turn(const Vec3& axis, std::size_t k, std::size_t n);

}  // namespace parsel
