#include "core/family/volume.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace parsel::family {

namespace {

struct Interval1 {
  double low = 0, high = 0;
};

/// A part at one y: what a line along x at some z meets.
class Slice {
 public:
  Slice(const cad::Part& part, double y) : part_(part), y_(y) {}

  /// The z at which the line enters and leaves; false when it meets the part nowhere at this y.
  bool z_range(Interval1& z) const {
    const double half = half_z();
    if (!(half > 0)) return false;
    z = {part_.centre.z() - half, part_.centre.z() + half};
    return true;
  }

  /// Where a cone's outline bends along z.
  void bends_into(std::vector<double>& zs) const {
    if (part_.kind != cad::Kind::cone || part_.axis == 1) return;
    const double t = part_.top / part_.size[(part_.axis + 1) % 3], half = part_.size.z() / 2, c = part_.centre.z();
    const double v = (y_ - part_.centre.y()) / (part_.size.y() / 2);
    for (const double radius : {1.0, t}) {
      if (part_.axis != 0 || radius <= std::abs(v)) continue;
      const double reach = half * std::sqrt(radius * radius - v * v);
      zs.insert(zs.end(), {c - reach, c + reach});
    }
    if (part_.axis == 2 && t != 1) {
      const double u = (std::abs(v) - (1 + t) / 2) / ((t - 1) / 2 * part_.towards);
      if (std::abs(u) < 1) zs.push_back(c + u * half);
    }
  }

  bool x_range(double z, Interval1& x) const {
    const double v = (y_ - part_.centre.y()) / (part_.size.y() / 2), w = (z - part_.centre.z()) / (part_.size.z() / 2);
    const double half = part_.size.x() / 2, c = part_.centre.x();
    x = {c - half, c + half};
    if (part_.kind == cad::Kind::box || part_.kind == cad::Kind::opaque) return std::abs(w) < 1 && std::abs(v) < 1;
    if (part_.kind == cad::Kind::sphere) return shrink(1 - v * v - w * w, x);
    // Of a cone: radius 1 at the base, `t` at the top, linear between; u runs from -1 at the base to 1 at the top.
    const double t = part_.kind == cad::Kind::cone ? part_.top / part_.size[(part_.axis + 1) % 3] : 1;
    const auto radius = [&](double u) { return (1 + t) / 2 + (t - 1) / 2 * u * part_.towards; };
    if (part_.axis == 0) {
      const double r = std::hypot(v, w);
      if (t == 1) return r < 1;
      // radius(u) ≥ r on one side of one u.
      const double slope = (t - 1) / 2 * part_.towards, at = (r - (1 + t) / 2) / slope;
      (slope > 0 ? x.low : x.high) = slope > 0 ? std::max(x.low, c + at * half) : std::min(x.high, c + at * half);
      return x.low < x.high;
    }
    const double along = part_.axis == 1 ? v : w, across = part_.axis == 1 ? w : v;
    if (!(std::abs(along) < 1)) return false;
    const double r = radius(along);
    return shrink(r * r - across * across, x);
  }

 private:
  double half_z() const {
    const double v = (y_ - part_.centre.y()) / (part_.size.y() / 2), half = part_.size.z() / 2;
    const double t = part_.kind == cad::Kind::cone ? part_.top / part_.size[(part_.axis + 1) % 3] : 1;
    const double widest = std::max(1.0, t);
    switch (part_.kind) {
      case cad::Kind::box:
      case cad::Kind::opaque:
        return std::abs(v) < 1 ? half : 0;
      case cad::Kind::sphere:
        return half * std::sqrt(std::max(0.0, 1 - v * v));
      case cad::Kind::cylinder:
      case cad::Kind::cone:
        if (part_.axis == 0) return half * std::sqrt(std::max(0.0, widest * widest - v * v));
        if (part_.axis == 1) return std::abs(v) < 1 ? half * ((1 + t) / 2 + (t - 1) / 2 * v * part_.towards) : 0;
        return std::abs(v) < widest ? half : 0;
    }
    return 0;
  }

  static bool shrink(double square, Interval1& x) {
    if (!(square > 0)) return false;
    const double middle = (x.low + x.high) / 2, half = (x.high - x.low) / 2 * std::sqrt(square);
    x = {middle - half, middle + half};
    return true;
  }

  const cad::Part& part_;
  double y_;
};

struct Rule {
  std::vector<double> at, weight;  ///< on [0, 1]
};

/// Gauss-Legendre points s, mapped by s²(3 - 2s): what ends like a circle, in a square root, then ends smoothly.
Rule gauss(int points) {
  Rule rule;
  switch (points) {
    case 1:
      return {{0.5}, {1}};
    case 2: {
      const double d = 0.5 / std::sqrt(3.0);
      rule = {{0.5 - d, 0.5 + d}, {0.5, 0.5}};
      break;
    }
    case 3: {
      const double d = 0.5 * std::sqrt(0.6);
      rule = {{0.5 - d, 0.5, 0.5 + d}, {5.0 / 18, 8.0 / 18, 5.0 / 18}};
      break;
    }
    default: {
      const double inner = std::sqrt(3.0 / 7 - 2.0 / 7 * std::sqrt(1.2)) / 2,
                   outer = std::sqrt(3.0 / 7 + 2.0 / 7 * std::sqrt(1.2)) / 2;
      const double heavy = (18 + std::sqrt(30.0)) / 72, light = (18 - std::sqrt(30.0)) / 72;
      rule = {{0.5 - outer, 0.5 - inner, 0.5 + inner, 0.5 + outer}, {light, heavy, heavy, light}};
    }
  }
  for (std::size_t i = 0; i < rule.at.size(); ++i) {
    const double s = rule.at[i];
    rule.at[i] = s * s * (3 - 2 * s);
    rule.weight[i] *= 6 * s * (1 - s);
  }
  return rule;
}

/// Sorts in place and gives the length of the union.
double measure(std::vector<Interval1>& intervals) {
  std::sort(intervals.begin(), intervals.end(), [](const Interval1& a, const Interval1& b) { return a.low < b.low; });
  double length = 0, end = -1e300;
  for (const Interval1& i : intervals) {
    if (i.high <= end) continue;
    length += i.high - std::max(i.low, end);
    end = i.high;
  }
  return length;
}

void sort_unique(std::vector<double>& values) {
  std::sort(values.begin(), values.end());
  values.erase(std::unique(values.begin(), values.end(), [](double a, double b) { return b - a < 1e-12; }),
               values.end());
}

}  // namespace

Overlap overlap(const std::vector<cad::Part>& a, const std::vector<cad::Part>& b, const std::vector<bool>& present,
                int gauss_points) {
  const std::array<const std::vector<cad::Part>*, 2> models = {&a, &b};
  bool is_flat = true;  // boxes alone need one point a cell
  std::vector<double> ys;
  for (const auto* model : models) {
    for (std::size_t p = 0; p < model->size(); ++p) {
      if (!present[p]) continue;
      const cad::Part& part = (*model)[p];
      const cad::Extent box = cad::extent(part);
      ys.push_back(part.centre.y() + box.low.y());
      ys.push_back(part.centre.y() + box.high.y());
      const bool is_box = part.kind == cad::Kind::box || part.kind == cad::Kind::opaque;
      if (!is_box) ys.push_back(part.centre.y() + (box.low.y() + box.high.y()) / 2);
      is_flat &= is_box;
      if (part.kind == cad::Kind::cone && part.axis != 1) {
        for (const double radius : {1.0, part.top / part.size[(part.axis + 1) % 3]}) {
          const double reach = radius * part.size.y() / 2;
          ys.insert(ys.end(), {part.centre.y() - reach, part.centre.y() + reach});
        }
      }
    }
  }
  sort_unique(ys);
  const Rule rule = gauss(is_flat ? 1 : gauss_points);
  Overlap sum;
  std::vector<double> zs;
  std::array<std::vector<Slice>, 2> slices;
  std::array<std::vector<Interval1>, 2> met;
  std::vector<Interval1> all;
  for (std::size_t i = 0; i + 1 < ys.size(); ++i) {
    for (std::size_t g = 0; g < rule.at.size(); ++g) {
      const double y = ys[i] + (ys[i + 1] - ys[i]) * rule.at[g], dy = (ys[i + 1] - ys[i]) * rule.weight[g];
      zs.clear();
      for (std::size_t m = 0; m < 2; ++m) {
        slices[m].clear();
        for (std::size_t p = 0; p < models[m]->size(); ++p) {
          Interval1 z;
          const Slice slice((*models[m])[p], y);
          if (!present[p] || !slice.z_range(z)) continue;
          slices[m].push_back(slice);
          zs.push_back(z.low);
          zs.push_back(z.high);
          const cad::Kind kind = (*models[m])[p].kind;
          if (kind != cad::Kind::box && kind != cad::Kind::opaque) zs.push_back((z.low + z.high) / 2);
          slice.bends_into(zs);
        }
      }
      sort_unique(zs);
      for (std::size_t j = 0; j + 1 < zs.size(); ++j) {
        for (std::size_t h = 0; h < rule.at.size(); ++h) {
          const double z = zs[j] + (zs[j + 1] - zs[j]) * rule.at[h], area = dy * (zs[j + 1] - zs[j]) * rule.weight[h];
          std::array<double, 2> length{0, 0};
          all.clear();
          for (std::size_t m = 0; m < 2; ++m) {
            met[m].clear();
            Interval1 x;
            for (const Slice& slice : slices[m]) {
              if (slice.x_range(z, x)) met[m].push_back(x);
            }
            all.insert(all.end(), met[m].begin(), met[m].end());
            length[m] = measure(met[m]);
          }
          const double both = length[0] + length[1] - measure(all);
          sum.a += length[0] * area;
          sum.b += length[1] * area;
          sum.both += both * area;
        }
      }
    }
  }
  return sum;
}

}  // namespace parsel::family
