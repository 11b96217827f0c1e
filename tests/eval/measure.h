// What an edit does to the geometry, looked at with nothing of the propagation's own: parts that now lie in each other,
// parts that touched and no longer do, cells that are inverted. Lengths in the normalised frame.
#pragma once

#include <array>
#include <bitset>
#include <optional>
#include <string>
#include <vector>

#include "core/edit/cage.h"
#include "core/edit/evaluate.h"
#include "core/shape/abstraction.h"
#include "core/shape/surface.h"

namespace parsel::eval {

/// A part's box is divided into this many cells along each of its axes.
inline constexpr int cells_per_axis = 12;
inline constexpr std::size_t cell_count = cells_per_axis * cells_per_axis * cells_per_axis;

/// How far two parts that touched may come apart before it counts, and how near they must be at rest to touch.
inline constexpr double touching = 0.01;

struct PairOfParts {
  std::string a, b;   ///< ids; an instance that the edit added goes by the id of its source
  double amount = 0;  ///< volume that the two newly share, or distance by which they came apart
};

struct Damage {
  bool finite = true;                       ///< all corners
  double least_jacobian = 1;                ///< relative to rest, over all cells' corners; ≤ 0 is inverted
  std::string least_jacobian_of;            ///< the part
  double overlap = 0;                       ///< volume that parts newly share, over all pairs
  double gap = 0;                           ///< largest
  std::vector<PairOfParts> overlaps, gaps;  ///< worst first, at most 5
};

/// Knows a shape at rest; measures states of it.
///
/// Overlap: a part is the set of cells of its box that its surface passes through or encloses. Counted is the volume,
/// as deformed, of cells of one part whose centre lies in such a cell of the other now and did not at rest; of the two
/// directions the smaller one. A cell is a twelfth of its box, so parts that slide along each other give a little.
///
/// Gap: parts that touched at rest (surfaces nearer than `touching`): by how much the nearest of the points that
/// touched is now farther from the other's surface.
///
/// After a change_count, instances are measured as copies of the one they come from, and must touch what all instances
/// touched.
class Gauge {
 public:
  explicit Gauge(const Abstraction& abstraction);
  Damage measure(const State& state) const;
  std::size_t contacts() const { return contacts_.size(); }

 private:
  struct Solid {
    std::bitset<cell_count> cells;
    Vec3 low, high;  ///< of the box at rest
  };
  struct Contact {
    PartIndex a, b;
    std::vector<Vec3> points;  ///< of a's surface, in local coordinates, that touch b
    double distance = 0;       ///< the nearest of them, at rest
  };
  struct Thing {
    PartIndex part;  ///< whose mesh it shows
    Corners corners;
    bool copied = false;  ///< an instance whose number the edit changed
    bool moved = false;
  };
  std::vector<Thing> things(const State& state) const;
  double new_overlap(const Thing& a, const Thing& b) const;
  double gap(const Contact& contact, const Thing& a, const Thing& b) const;
  bool shared_by_group(const Contact& contact) const;
  PartMesh deformed(const Thing& thing) const;

  const Abstraction& abstraction_;
  PartData<Solid> solids_;
  std::vector<Contact> contacts_;
};

}  // namespace parsel::eval
