#include "core/split/behind.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <optional>

namespace parsel::split {
namespace {

/// Rays begin this far behind their face, in half-diagonals: faces that coincide with it are not behind it.
constexpr double just_behind = 1e-6;

struct Surface {
  std::vector<std::uint32_t> triangles;
  Vec3 normal_sum = Vec3::Zero();  ///< by area
  double area = 0, volume = 0;     ///< volume: six times, signed
  bool is_whole = true;            ///< nothing of it hangs together with another piece
  bool is_closed = true;           ///< every edge has two triangles
};

class Behind {
 public:
  Behind(const PartMesh& mesh, const Seams& seams, bool turned, const Components& pieces, const BehindOptions& options)
      : mesh_(mesh), seams_(seams), sign_(turned ? -1 : 1), pieces_(pieces), options_(options) {}

  Components run() {
    gather();
    std::vector<std::uint32_t> host(pieces_.count);
    std::iota(host.begin(), host.end(), 0u);
    for (std::uint32_t i = 0; i < pieces_.count; ++i) {
      if (!is_sheet(surfaces_[i]) && !is_hollow(surfaces_[i])) continue;
      if (const auto behind = piece_behind(i)) host[root(host, i)] = root(host, *behind);
    }
    Components joined;
    std::map<std::uint32_t, std::uint32_t> numbers;
    for (const std::uint32_t piece : pieces_.of) {
      const auto next = static_cast<std::uint32_t>(numbers.size());
      joined.of.push_back(numbers.try_emplace(root(host, piece), next).first->second);
    }
    joined.count = static_cast<std::uint32_t>(numbers.size());
    return joined;
  }

 private:
  static std::uint32_t root(std::vector<std::uint32_t>& parent, std::uint32_t i) {
    while (parent[i] != i) i = parent[i] = parent[parent[i]];
    return i;
  }

  const Vec3& corner(std::uint32_t t, std::size_t k) const { return mesh_.positions[mesh_.triangles[t][k]]; }
  Vec3 centre(std::uint32_t t) const { return (corner(t, 0) + corner(t, 1) + corner(t, 2)) / 3; }
  /// Outwards, twice as long as the triangle's area.
  Vec3 normal(std::uint32_t t) const {
    return sign_ * (corner(t, 1) - corner(t, 0)).cross(corner(t, 2) - corner(t, 0));
  }

  void gather() {
    surfaces_.resize(pieces_.count);
    for (std::uint32_t t = 0; t < pieces_.of.size(); ++t) {
      Surface& own = surfaces_[pieces_.of[t]];
      const Vec3 n = normal(t), &from = corner(own.triangles.empty() ? t : own.triangles.front(), 0);
      own.triangles.push_back(t);
      own.normal_sum += n / 2;
      own.area += n.norm() / 2;
      own.volume += n.dot(corner(t, 0) - from);
      for (HalfEdge h = 3 * t; h < 3 * t + 3; ++h) {
        const HalfEdge other = seams_.across[h];
        if (other == no_edge) {
          own.is_closed = false;
        } else if (pieces_.of[other / 3] != pieces_.of[t]) {
          own.is_whole = false;
        }
      }
    }
  }

  bool is_hollow(const Surface& s) const { return s.is_whole && s.is_closed && s.volume < 0; }

  bool is_sheet(const Surface& s) const {
    if (s.is_whole || s.normal_sum.norm() < options_.flat_cosine * s.area) return false;
    const Vec3 mean = s.normal_sum.normalized();
    double along = 0;
    for (const std::uint32_t t : s.triangles) {
      const Vec3 n = normal(t);
      if (n.dot(mean) >= options_.flat_cosine * n.norm()) along += n.norm() / 2;
    }
    return along >= options_.flat_share * s.area;
  }

  /// The piece that more than half of the rays end at, by area.
  std::optional<std::uint32_t> piece_behind(std::uint32_t piece) {
    std::vector<std::uint32_t> from = surfaces_[piece].triangles;
    const auto larger = [&](std::uint32_t a, std::uint32_t b) {
      const double x = normal(a).squaredNorm(), y = normal(b).squaredNorm();
      return x != y ? x > y : a < b;
    };
    const std::size_t count = std::min(from.size(), options_.rays);
    std::partial_sort(from.begin(), from.begin() + static_cast<std::ptrdiff_t>(count), from.end(), larger);
    std::map<std::uint32_t, double> votes;
    double all = 0;
    for (std::size_t i = 0; i < count; ++i) {
      const Vec3 n = normal(from[i]);
      const double area = n.norm() / 2;
      if (!(area > 0) || visited_ + mesh_.triangles.size() > options_.visits) continue;
      visited_ += mesh_.triangles.size();
      all += area;
      const auto hit = first_hit(centre(from[i]), -n.normalized());
      if (hit && pieces_.of[*hit] != piece) votes[pieces_.of[*hit]] += area;
    }
    for (const auto& [other, area] : votes) {
      if (area > all / 2) return other;
    }
    return std::nullopt;
  }

  /// The nearest triangle along a ray, if the ray leaves a solid there (Möller and Trumbore 1997).
  std::optional<std::uint32_t> first_hit(const Vec3& origin, const Vec3& direction) const {
    std::optional<std::uint32_t> nearest;
    double least = std::numeric_limits<double>::infinity();
    for (std::uint32_t t = 0; t < mesh_.triangles.size(); ++t) {
      const Vec3 &a = corner(t, 0), u = corner(t, 1) - a, v = corner(t, 2) - a, p = direction.cross(v);
      const double determinant = u.dot(p);
      if (std::abs(determinant) < 1e-18) continue;
      const Vec3 s = origin - a;
      const double first = s.dot(p) / determinant;
      if (first < 0 || first > 1) continue;
      const Vec3 q = s.cross(u);
      const double second = direction.dot(q) / determinant, distance = v.dot(q) / determinant;
      if (second < 0 || first + second > 1 || distance < just_behind || distance >= least) continue;
      least = distance;
      nearest = t;
    }
    if (!nearest || direction.dot(normal(*nearest)) <= 0) return std::nullopt;
    return nearest;
  }

  const PartMesh& mesh_;
  const Seams& seams_;
  double sign_;
  const Components& pieces_;
  const BehindOptions& options_;
  std::vector<Surface> surfaces_;
  std::size_t visited_ = 0;
};

}  // namespace

Components join_behind(const PartMesh& mesh, const Seams& seams, bool turned, const Components& pieces,
                       const BehindOptions& options) {
  return Behind(mesh, seams, turned, pieces, options).run();
}

}  // namespace parsel::split
