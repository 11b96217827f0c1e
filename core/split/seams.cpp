#include "core/split/seams.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "core/split/weld.h"

namespace parsel::split {
namespace {

/// A fan of hundreds of faces is no edge of a solid; and looking for partners takes the square of their number.
constexpr std::size_t most_spokes = 64;

class Stitcher {
 public:
  Stitcher(const PartMesh& mesh, bool turned, Seams& seams) : mesh_(mesh), turned_(turned), seams_(seams) {}

  void run() {
    const auto count = static_cast<HalfEdge>(3 * mesh_.triangles.size());
    seams_.across.assign(count, no_edge);
    const std::vector<HalfEdge> edges = by_edge(count);
    std::vector<HalfEdge> fan;
    for (std::size_t first = 0, next = 0; first < edges.size(); first = next) {
      while (next < edges.size() && low(edges[next]) == low(edges[first]) && high(edges[next]) == high(edges[first])) {
        ++next;
      }
      if (next - first == 2) {
        glue(edges[first], edges[first + 1]);
      } else if (next - first > 2) {
        fan.assign(edges.begin() + static_cast<std::ptrdiff_t>(first),
                   edges.begin() + static_cast<std::ptrdiff_t>(next));
        glue_fan(fan);
      }
    }
  }

 private:
  std::uint32_t corner(HalfEdge h) const { return seams_.place[mesh_.triangles[h / 3][h % 3]]; }
  std::uint32_t from(HalfEdge h) const { return corner(h); }
  std::uint32_t to(HalfEdge h) const { return corner(h - h % 3 + (h + 1) % 3); }
  std::uint32_t low(HalfEdge h) const { return std::min(from(h), to(h)); }
  std::uint32_t high(HalfEdge h) const { return std::max(from(h), to(h)); }

  /// Half-edges that lead somewhere, those of one edge together: put into buckets by their low vertex, and sorted there.
  std::vector<HalfEdge> by_edge(HalfEdge count) const {
    std::vector<std::uint32_t> end(seams_.place.size() + 1, 0);
    for (HalfEdge h = 0; h < count; ++h) {
      if (from(h) != to(h)) ++end[low(h) + 1];
    }
    std::partial_sum(end.begin(), end.end(), end.begin());
    std::vector<HalfEdge> edges(end.back());
    for (HalfEdge h = 0; h < count; ++h) {
      if (from(h) != to(h)) edges[end[low(h)]++] = h;
    }
    for (std::size_t v = 0; v < seams_.place.size(); ++v) {
      const auto at = [&](std::uint32_t i) { return edges.begin() + static_cast<std::ptrdiff_t>(i); };
      std::sort(at(v == 0 ? 0 : end[v - 1]), at(end[v]), [&](HalfEdge a, HalfEdge b) {
        const std::uint32_t x = high(a), y = high(b);
        return x != y ? x < y : a < b;
      });
    }
    return edges;
  }

  void glue(HalfEdge a, HalfEdge b) {
    seams_.across[a] = b;
    seams_.across[b] = a;
  }

  /// A face around an edge, seen along it from its low to its high vertex: where it stands, counter-clockwise, and
  /// whether the solid that it bounds lies before it (it ends there) or behind.
  struct Spoke {
    HalfEdge half_edge;
    std::int64_t angle;  ///< in steps so coarse that faces which coincide are at one
    bool ends;
  };

  void glue_fan(const std::vector<HalfEdge>& fan) {
    constexpr double steps = 1e4;  // a radian
    const Vec3 start = mesh_.positions[low(fan[0])];
    const Vec3 axis = (mesh_.positions[high(fan[0])] - start).normalized();
    const Vec3 zero = radial(fan[0], start, axis), quarter = axis.cross(zero);
    std::vector<Spoke> spokes;
    for (const HalfEdge h : fan) {
      const Vec3 r = radial(h, start, axis);
      double angle = std::atan2(r.dot(quarter), r.dot(zero));
      if (angle < -0.5 / steps) angle += 2 * std::numbers::pi;
      spokes.push_back({h, std::llround(angle * steps), (from(h) == low(h)) != turned_});
    }
    std::sort(spokes.begin(), spokes.end(), [](const Spoke& a, const Spoke& b) {
      if (a.angle != b.angle) return a.angle < b.angle;
      return a.ends != b.ends ? a.ends : a.half_edge < b.half_edge;
    });
    std::vector<bool> used(spokes.size(), false);
    if (spokes.size() > most_spokes) return;
    for (std::size_t i = 0; i < spokes.size(); ++i) {
      if (spokes[i].ends || used[i]) continue;
      for (std::size_t k = 1; k < spokes.size(); ++k) {
        const std::size_t j = (i + k) % spokes.size();
        if (!spokes[j].ends || used[j]) continue;
        used[i] = used[j] = true;
        glue(spokes[i].half_edge, spokes[j].half_edge);
        break;
      }
    }
    // What is left is turned inside out: two and two.
    std::size_t waiting = spokes.size();
    for (std::size_t i = 0; i < spokes.size(); ++i) {
      if (used[i]) continue;
      if (waiting == spokes.size()) {
        waiting = i;
      } else {
        glue(spokes[waiting].half_edge, spokes[i].half_edge);
        waiting = spokes.size();
      }
    }
  }

  Vec3 radial(HalfEdge h, const Vec3& start, const Vec3& axis) const {
    const Vec3 apex = mesh_.positions[corner(h - h % 3 + (h + 2) % 3)] - start;
    return apex - axis.dot(apex) * axis;
  }

  const PartMesh& mesh_;
  bool turned_;
  Seams& seams_;
};

}  // namespace

Seams close_seams(const PartMesh& mesh, bool turned) {
  Seams seams;
  seams.place = weld(mesh.positions);
  Stitcher(mesh, turned, seams).run();
  return seams;
}

}  // namespace parsel::split
