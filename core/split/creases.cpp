#include "core/split/creases.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <optional>
#include <utility>

namespace parsel::split {
namespace {

/// Points this near to a plane lie on it, in half-diagonals.
constexpr double on_plane = 5e-4;

struct Plane {
  Vec3 normal;  ///< unit
  double offset = 0;

  double distance(const Vec3& p) const { return normal.dot(p) - offset; }
};

/// What two neighbouring fragments have in common.
struct Border {
  double creased = 0, plain = 0;  ///< lengths
};

/// One plane's cut of a region: the fragments, by position in the region's list of triangles, and what it is worth.
struct Cut {
  std::vector<std::uint32_t> fragment;
  std::uint32_t count = 1;
  double worth = 0;
};

std::uint32_t root_of(std::vector<std::uint32_t>& parent, std::uint32_t i) {
  while (parent[i] != i) i = parent[i] = parent[parent[i]];
  return i;
}

class Regions {
 public:
  Regions(const PartMesh& mesh, const Seams& seams, bool turned, const CreaseOptions& options)
      : mesh_(mesh), seams_(seams), options_(options) {
    for (const Triangle& t : mesh.triangles) {
      const Vec3 n = (corner(t[1]) - corner(t[0])).cross(corner(t[2]) - corner(t[0]));
      normals_.push_back(n.norm() > 1e-30 ? Vec3(n.normalized() * (turned ? -1 : 1)) : Vec3(Vec3::Zero()));
    }
    creased_.resize(seams.across.size());
    for (HalfEdge h = 0; h < creased_.size(); ++h) creased_[h] = is_crease(h);
  }

  Components run() {
    const Components closed = components(seams_, [&](HalfEdge h) { return !creased_[h]; });
    found_.of.assign(mesh_.triangles.size(), 0);
    region_of_.assign(mesh_.triangles.size(), 0);
    std::vector<std::vector<std::uint32_t>> waiting(closed.count);
    for (std::uint32_t t = 0; t < mesh_.triangles.size(); ++t) waiting[closed.of[t]].push_back(t);
    std::reverse(waiting.begin(), waiting.end());
    while (!waiting.empty()) {
      const std::vector<std::uint32_t> region = std::move(waiting.back());
      waiting.pop_back();
      const Cut cut = best_cut(region);
      if (cut.count < 2) {
        for (const std::uint32_t t : region) found_.of[t] = found_.count;
        ++found_.count;
        continue;
      }
      std::vector<std::vector<std::uint32_t>> parts(cut.count);
      for (std::size_t i = 0; i < region.size(); ++i) parts[cut.fragment[i]].push_back(region[i]);
      for (auto& part : parts) waiting.push_back(std::move(part));
    }
    return std::move(found_);
  }

 private:
  const Vec3& corner(std::uint32_t v) const { return mesh_.positions[v]; }
  const Vec3& start(HalfEdge h) const { return corner(mesh_.triangles[h / 3][h % 3]); }
  const Vec3& end(HalfEdge h) const { return corner(mesh_.triangles[h / 3][(h + 1) % 3]); }
  const Vec3& apex(HalfEdge h) const { return corner(mesh_.triangles[h / 3][(h + 2) % 3]); }
  double length(HalfEdge h) const { return (end(h) - start(h)).norm(); }
  Vec3 centre(std::uint32_t t) const { return (start(3 * t) + end(3 * t) + apex(3 * t)) / 3; }

  bool is_crease(HalfEdge h) const {
    const HalfEdge other = seams_.across[h];
    if (other == no_edge) return false;
    const Vec3 &a = normals_[h / 3], &b = normals_[other / 3];
    if (a.isZero() || b.isZero() || a.dot(b) > std::cos(options_.angle)) return false;
    return a.dot(apex(other) - start(h)) > 0;
  }

  bool inside(HalfEdge h, std::uint32_t region) const {
    return seams_.across[h] != no_edge && region_of_[seams_.across[h] / 3] == region;
  }

  /// The planes of the faces at creases within the region, those along most of them first.
  std::vector<Plane> planes(const std::vector<std::uint32_t>& region, std::uint32_t mark) const {
    std::map<std::array<std::int64_t, 4>, std::pair<double, Plane>> weighed;
    for (const std::uint32_t t : region) {
      for (HalfEdge h = 3 * t; h < 3 * t + 3; ++h) {
        if (!creased_[h] || !inside(h, mark)) continue;
        Vec3 n = normals_[t];
        int axis = 0;
        n.cwiseAbs().maxCoeff(&axis);
        if (n[axis] < 0) n = -n;
        const double d = n.dot(start(h));
        const std::array<std::int64_t, 4> key = {std::llround(n[0] * 30), std::llround(n[1] * 30),
                                                 std::llround(n[2] * 30), std::llround(d * 400)};
        auto& [weight, plane] = weighed.try_emplace(key, 0.0, Plane{n, d}).first->second;
        weight += length(h);
      }
    }
    std::vector<std::pair<double, Plane>> all;
    for (const auto& [key, entry] : weighed) {
      if (entry.first > options_.length) all.push_back(entry);
    }
    std::stable_sort(all.begin(), all.end(), [](const auto& a, const auto& b) { return a.first > b.first; });
    std::vector<Plane> best;
    for (std::size_t i = 0; i < std::min(all.size(), options_.planes); ++i) best.push_back(all[i].second);
    return best;
  }

  Cut best_cut(const std::vector<std::uint32_t>& region) {
    Cut best;
    if (region.size() < 2 || region.size() > options_.most_triangles) return best;
    const std::uint32_t mark = ++marks_;
    for (std::uint32_t i = 0; i < region.size(); ++i) region_of_[region[i]] = mark;
    for (const Plane& plane : planes(region, mark)) {
      if (visited_ + region.size() > options_.visits) break;
      visited_ += region.size();
      Cut cut = cut_along(plane, region, mark);
      if (cut.count > 1 && cut.worth > best.worth) best = std::move(cut);
    }
    return best;
  }

  /// Above or below: by its centre; a face in the plane goes to where its solid is.
  bool above(std::uint32_t t, const Plane& plane) const {
    const double d = plane.distance(centre(t));
    return std::abs(d) < on_plane ? plane.normal.dot(normals_[t]) < 0 : d > 0;
  }

  Cut cut_along(const Plane& plane, const std::vector<std::uint32_t>& region, std::uint32_t mark) {
    if (position_.size() < mesh_.triangles.size()) position_.resize(mesh_.triangles.size());
    std::vector<bool> side(region.size());
    for (std::uint32_t i = 0; i < region.size(); ++i) {
      position_[region[i]] = i;
      side[i] = above(region[i], plane);
    }
    // Fragments: what hangs together on one side.
    std::vector<std::uint32_t> parent(region.size());
    std::iota(parent.begin(), parent.end(), 0u);
    for (std::uint32_t i = 0; i < region.size(); ++i) {
      for (HalfEdge h = 3 * region[i]; h < 3 * region[i] + 3; ++h) {
        if (!inside(h, mark)) continue;
        const std::uint32_t j = position_[seams_.across[h] / 3];
        if (side[i] == side[j]) parent[root_of(parent, i)] = root_of(parent, j);
      }
    }
    std::map<std::pair<std::uint32_t, std::uint32_t>, Border> borders;
    for (std::uint32_t i = 0; i < region.size(); ++i) measure(plane, region[i], i, side, parent, mark, borders);
    // Fragments stay together where too little of their border is creased.
    Cut cut;
    for (const auto& [pair, border] : borders) {
      if (border.creased >= options_.length && border.creased >= options_.share * (border.creased + border.plain)) {
        continue;
      }
      parent[root_of(parent, pair.first)] = root_of(parent, pair.second);
    }
    for (const auto& [pair, border] : borders) {
      if (root_of(parent, pair.first) == root_of(parent, pair.second)) continue;
      cut.worth += border.creased * border.creased / (border.creased + border.plain);
    }
    std::map<std::uint32_t, std::uint32_t> numbers;
    cut.fragment.resize(region.size());
    for (std::uint32_t i = 0; i < region.size(); ++i) {
      const auto number = static_cast<std::uint32_t>(numbers.size());
      cut.fragment[i] = numbers.try_emplace(root_of(parent, i), number).first->second;
    }
    cut.count = static_cast<std::uint32_t>(numbers.size());
    return cut;
  }

  /// Adds what a triangle has of the borders between fragments: its edges in the plane, and where the plane crosses it.
  void measure(const Plane& plane, std::uint32_t t, std::uint32_t i, const std::vector<bool>& side,
               std::vector<std::uint32_t>& parent, std::uint32_t mark,
               std::map<std::pair<std::uint32_t, std::uint32_t>, Border>& borders) const {
    std::array<double, 3> d{};
    for (std::size_t k = 0; k < 3; ++k) d[k] = plane.distance(corner(mesh_.triangles[t][k]));
    const auto border = [&](std::uint32_t j) -> Border& {
      const std::uint32_t a = root_of(parent, i), b = root_of(parent, j);
      return borders[{std::min(a, b), std::max(a, b)}];
    };
    std::optional<std::uint32_t> beyond;
    for (std::uint32_t k = 0; k < 3; ++k) {
      const HalfEdge h = 3 * t + k;
      if (!inside(h, mark)) continue;
      const std::uint32_t j = position_[seams_.across[h] / 3];
      if (side[i] == side[j]) continue;
      beyond = j;
      const bool in_plane = std::abs(d[k]) < on_plane && std::abs(d[(k + 1) % 3]) < on_plane;
      if (creased_[h]) {
        border(j).creased += length(h) / 2;  // seen from both sides
      } else if (in_plane) {
        border(j).plain += length(h) / 2;
      }
    }
    if (!beyond) return;
    std::vector<Vec3> crossings;
    for (std::size_t k = 0; k < 3; ++k) {
      const double from = d[k], to = d[(k + 1) % 3];
      if (std::min(from, to) > -on_plane || std::max(from, to) < on_plane) continue;
      const Vec3 &a = corner(mesh_.triangles[t][k]), &b = corner(mesh_.triangles[t][(k + 1) % 3]);
      crossings.push_back(a + (b - a) * (from / (from - to)));
    }
    if (crossings.size() == 2) border(*beyond).plain += (crossings[0] - crossings[1]).norm();
  }

  const PartMesh& mesh_;
  const Seams& seams_;
  const CreaseOptions& options_;
  std::vector<Vec3> normals_;  ///< by triangle, outwards; zero where it has no area
  std::vector<bool> creased_;  ///< by half-edge
  Components found_;
  std::uint32_t marks_ = 0;
  std::size_t visited_ = 0;
  std::vector<std::uint32_t> region_of_, position_;  ///< by triangle: the mark of its region; its place in the list
};

}  // namespace

Components crease_regions(const PartMesh& mesh, const Seams& seams, bool turned, const CreaseOptions& options) {
  return Regions(mesh, seams, turned, options).run();
}

}  // namespace parsel::split
