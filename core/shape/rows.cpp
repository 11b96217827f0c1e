// Translation groups: like parts at equal distances on a line.
#include <cmath>
#include <optional>

#include "core/shape/symmetry_search.h"

namespace parsel {
namespace {

class RowSearch {
 public:
  explicit RowSearch(SymmetrySearch& search) : search_(search), options_(search.options) {}

  /// `set`: parts that are moved images of each other.
  void find(const Parts& set) {
    for (int round = 0; round < options_.row_rounds; ++round) {
      if (!take_rows(set)) break;
    }
  }

  /// A row whose mirror image stands there as single parts is two rows: one of them only missed its tolerance.
  void complete(const SymmetryGroup& row, const Parts& kind) {
    for (int axis = 0; axis < 3; ++axis) {
      const Parts free = search_.free_of(kind);
      for (const PartIndex first : free) {
        const double offset = (centre(row.parts.front())[axis] + centre(first)[axis]) / 2;
        if (!search_.mirrors(row.parts.front(), first, axis, offset)) continue;
        Parts image = image_of(row, axis, offset, free);
        if (image.size() != row.parts.size()) continue;
        Vec3 delta = row.delta;
        delta[axis] *= -1;
        add(std::move(image), delta);
        break;
      }
    }
  }

 private:
  const Vec3& centre(PartIndex p) const { return search_.centre(p); }

  bool take_rows(const Parts& set) {
    const Parts free = search_.free_of(set);
    if (free.size() < 3) return false;
    std::vector<Parts> rows;
    for (const PartIndex start : free) {
      for (const PartIndex next : nearest(free, start)) {
        Parts row = row_from(free, start, next);
        if (row.size() >= 3) rows.push_back(std::move(row));
      }
    }
    std::stable_sort(rows.begin(), rows.end(), [&](const Parts& a, const Parts& b) {
      if (a.size() != b.size()) return a.size() > b.size();
      return spacing(a) < spacing(b) - options_.position;
    });
    bool taken = false;
    for (const Parts& row : rows) {
      if (!std::all_of(row.begin(), row.end(), [&](PartIndex p) { return search_.is_free(p); })) continue;
      if (is_diagonal(row) && is_crossed(row, rows)) continue;
      const double steps = static_cast<double>(row.size() - 1);
      add(row, snapped((centre(row.back()) - centre(row.front())) / steps, steps));
      taken = true;
    }
    return taken;
  }

  void add(Parts parts, const Vec3& delta) {
    SymmetryGroup group;
    group.kind = SymmetryGroup::Kind::translation;
    group.parts = std::move(parts);
    group.delta = delta;
    search_.add_group(std::move(group));
  }

  Parts image_of(const SymmetryGroup& row, int axis, double offset, const Parts& free) {
    Parts image;
    for (const PartIndex p : row.parts) {
      const auto found =
          std::find_if(free.begin(), free.end(), [&](PartIndex q) { return search_.mirrors(p, q, axis, offset); });
      if (found == free.end() || std::find(image.begin(), image.end(), *found) != image.end()) break;
      image.push_back(*found);
    }
    return image;
  }

  bool is_diagonal(const Parts& row) const {
    const Vec3 way = centre(row.back()) - centre(row.front());
    return (way.cwiseAbs().array() > options_.position).count() > 1;
  }

  static bool is_crossed(const Parts& row, const std::vector<Parts>& rows) {
    const auto shares = [&](const Parts& other) {
      const auto common = std::count_if(
          row.begin(), row.end(), [&](PartIndex p) { return std::find(other.begin(), other.end(), p) != other.end(); });
      return common == 1;  // more would be the same line with other steps
    };
    return std::any_of(rows.begin(), rows.end(), shares);
  }

  double spacing(const Parts& row) const { return (centre(row[1]) - centre(row[0])).norm(); }

  /// A row that runs along a global axis within tolerance is put on it.
  Vec3 snapped(const Vec3& delta, double steps) const {
    Vec3 out = delta;
    for (int axis = 0; axis < 3; ++axis) {
      if (std::abs(delta[axis]) * steps <= options_.position) out[axis] = 0;
    }
    return out;
  }

  Parts nearest(const Parts& free, PartIndex from) const {
    std::vector<std::pair<double, PartIndex>> by_distance;
    for (const PartIndex p : free) {
      const double d = (centre(p) - centre(from)).norm();
      if (p != from && d > options_.position) by_distance.emplace_back(d, p);
    }
    const std::size_t kept = std::min(options_.row_neighbours, by_distance.size());
    std::partial_sort(by_distance.begin(), by_distance.begin() + static_cast<std::ptrdiff_t>(kept), by_distance.end());
    Parts out;
    for (std::size_t i = 0; i < kept; ++i) out.push_back(by_distance[i].second);
    return out;
  }

  /// Whether every part is within tolerance of equal steps between the first and the last.
  bool is_even(const Parts& row) const {
    const Vec3 start = centre(row.front());
    const Vec3 step = (centre(row.back()) - start) / static_cast<double>(row.size() - 1);
    for (std::size_t k = 0; k < row.size(); ++k) {
      const Vec3 expected = start + static_cast<double>(k) * step;
      if ((centre(row[k]) - expected).norm() > options_.position) return false;
    }
    return true;
  }

  /// The parts at equal distances from `start` on, when nothing comes before it and the row runs from the smaller
  /// coordinate to the larger, so that each row is found once and always the same way round.
  Parts row_from(const Parts& free, PartIndex start, PartIndex next) const {
    const Vec3 delta = centre(next) - centre(start);
    int axis = 0;
    delta.cwiseAbs().maxCoeff(&axis);
    if (delta[axis] < 0) return {};
    // A single step may be off by the errors of two parts; the row as a whole is held to one.
    const double slack = std::min(2 * options_.position, options_.row_step * delta.norm());
    const auto at = [&](const Vec3& where) -> std::optional<PartIndex> {
      std::optional<PartIndex> best;
      double best_distance = slack;
      for (const PartIndex p : free) {
        const double d = (centre(p) - where).norm();
        if (d <= best_distance) best_distance = d, best = p;
      }
      return best;
    };
    if (at(centre(start) - delta)) return {};
    Parts row = {start, next};
    // Each step starts from the last part found, so that small errors do not add up along a long row.
    while (const auto more = at(centre(row.back()) + delta)) row.push_back(*more);
    while (row.size() > 2 && !is_even(row)) row.pop_back();
    return row;
  }

  SymmetrySearch& search_;
  const SymmetryOptions& options_;
};

}  // namespace

void SymmetrySearch::find_rows(const Parts& kind) {
  const auto same = [&](PartIndex a, PartIndex b) {
    return same_extents(a, b) && congruence.carries(a, b, Mat3::Identity());
  };
  const std::size_t before = found.groups.size();
  RowSearch rows(*this);
  for (const Parts& set : classes(free_of(kind), same)) rows.find(set);
  // By index: completing adds to the list, and what was added needs no completing itself.
  for (std::size_t g = before, end = found.groups.size(); g < end; ++g) {
    const SymmetryGroup row = found.groups[g];
    rows.complete(row, kind);
  }
}

}  // namespace parsel
