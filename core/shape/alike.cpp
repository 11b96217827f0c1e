#include "core/shape/alike.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <tuple>

#include "core/base/tolerance.h"

namespace parsel {
namespace {

/// A part whose centre is this near a plane lies on it; what is taken for a pair is further away (symmetry.cpp).
constexpr double on_plane = 0.005;
/// Regions that agree this well are left as they are: what is more is rounding.
constexpr double exactly_alike = 1e-9;

PartPair ordered(PartIndex a, PartIndex b) {
  return {std::min(a, b), std::max(a, b)};
}

/// x → linear · x + offset.
struct Move {
  Mat3 linear = Mat3::Identity();
  Vec3 offset = Vec3::Zero();
  Move inverse() const { return {linear.transpose(), -(linear.transpose() * offset)}; }
};

ContactRegion moved(const ContactRegion& region, const Move& move) {
  ContactRegion out = region;
  for (Vec3& v : out.vertices) v = move.linear * v + move.offset;
  out.vertex_sum = move.linear * region.vertex_sum + static_cast<double>(region.vertex_count) * move.offset;
  out.moment = move.linear * region.moment + region.area * move.offset;
  return out;
}

/// By how much the ends of two regions along the global axes differ.
double difference(const ContactRegion& a, const ContactRegion& b) {
  if (a.empty() || b.empty()) return a.empty() == b.empty() ? 0 : std::numeric_limits<double>::infinity();
  const auto ends = [](const ContactRegion& region) {
    Vec3 low = Vec3::Constant(std::numeric_limits<double>::infinity()), high = -low;
    for (const Vec3& v : region.vertices) {
      low = low.cwiseMin(v);
      high = high.cwiseMax(v);
    }
    return std::pair(low, high);
  };
  const auto [low_a, high_a] = ends(a);
  const auto [low_b, high_b] = ends(b);
  return std::max((low_a - low_b).cwiseAbs().maxCoeff(), (high_a - high_b).cwiseAbs().maxCoeff());
}

/// A contact as seen from where its first twin is.
struct Twin {
  PartPair pair;
  Move to_first;
};

class Alike {
 public:
  Alike(Contacts& contacts, const PartData<PartMesh>& meshes, const PartData<Hexahedron>& boxes,
        const MeasuredAxes& axes)
      : contacts_(contacts), meshes_(meshes), boxes_(boxes), axes_(axes) {}

  void mirror(const std::vector<MirrorPair>& mirrors) {
    std::map<std::tuple<int, double, PartIndex>, PartIndex> image;
    for (const MirrorPair& m : mirrors) {
      image[{m.axis, m.offset, m.a}] = m.b;
      image[{m.axis, m.offset, m.b}] = m.a;
    }
    const PartData<std::vector<PartIndex>> touched = neighbours();
    for (const MirrorPair& m : mirrors) {
      Move reflect;
      reflect.linear(m.axis, m.axis) = -1;
      reflect.offset[m.axis] = 2 * m.offset;
      for (const auto& [part, other] : {std::pair(m.a, m.b), std::pair(m.b, m.a)}) {
        for (const PartIndex neighbour : touched[part]) {
          const auto found = image.find({m.axis, m.offset, neighbour});
          const bool is_pair = found != image.end();
          if (!is_pair && !is_own_image(boxes_[neighbour], m.axis, m.offset)) continue;
          const PartPair own = ordered(part, neighbour);
          const PartPair twin = ordered(other, is_pair ? found->second : neighbour);
          if (twin == own) continue;  // the two halves of a pair touch each other
          if (contacts_.count(twin) == 0) {
            if (nearly_meet(twin)) contacts_[twin] = moved(contacts_.at(own), reflect);
          } else if (own < twin) {
            unite({{own, {}}, {twin, reflect}});
          }
        }
      }
    }
  }

  /// What touches several instances of a group touches them alike.
  void spread(const SymmetryGroup& group) {
    const PartData<std::vector<PartIndex>> touched = neighbours();
    std::map<PartIndex, std::vector<Twin>> by_neighbour;
    for (std::size_t k = 0; k < group.parts.size(); ++k) {
      Move move;  // from instance k to instance 0
      if (group.kind == SymmetryGroup::Kind::translation) {
        move.offset = -static_cast<double>(k) * group.delta;
      } else {
        const double angle = -2 * pi * static_cast<double>(k) / static_cast<double>(group.parts.size());
        move.linear = Eigen::AngleAxisd(angle, group.axis).toRotationMatrix();
        move.offset = group.centre - move.linear * group.centre;
      }
      for (const PartIndex neighbour : touched[group.parts[k]]) {
        by_neighbour[neighbour].push_back({ordered(group.parts[k], neighbour), move});
      }
    }
    for (const auto& [neighbour, twins] : by_neighbour) {
      const bool is_instance = std::find(group.parts.begin(), group.parts.end(), neighbour) != group.parts.end();
      if (!is_instance) unite(twins);
    }
  }

 private:
  /// Gives all twins the union of the regions that match the first one's.
  void unite(const std::vector<Twin>& twins) {
    std::vector<Twin> matching;
    ContactRegion first, whole;
    double off = 0;
    for (const Twin& twin : twins) {
      const ContactRegion region = moved(contacts_.at(twin.pair), twin.to_first);
      if (matching.empty()) first = region;
      const double by = difference(region, first);
      if (by > twin_contact_distance) continue;
      off = std::max(off, by);
      whole.add(region);
      matching.push_back(twin);
    }
    if (off < exactly_alike) return;
    for (const Twin& twin : matching) {
      ContactRegion& region = contacts_[twin.pair];
      region = moved(whole, twin.to_first.inverse());
      reduce(region, twin.pair, axes_);
    }
  }

  PartData<std::vector<PartIndex>> neighbours() const {
    PartData<std::vector<PartIndex>> touched(boxes_.size());
    for (const auto& [pair, region] : contacts_) {
      touched[pair.first].push_back(pair.second);
      touched[pair.second].push_back(pair.first);
    }
    return touched;
  }

  bool nearly_meet(const PartPair& pair) const {
    const auto [a, b] = pair;
    const double smaller = std::min(boxes_[a].half_extents().maxCoeff(), boxes_[b].half_extents().maxCoeff());
    const double distance = std::min(twin_contact_distance, smaller / 4);
    return !contact_region(meshes_[a], boxes_[a], meshes_[b], boxes_[b], distance).empty();
  }

  Contacts& contacts_;
  const PartData<PartMesh>& meshes_;
  const PartData<Hexahedron>& boxes_;
  const MeasuredAxes& axes_;
};

}  // namespace

bool is_own_image(const Hexahedron& box, int axis, double offset) {
  const bool is_across = std::abs(box.axes(axis, axis)) > 1 - 1e-6;
  return is_across && std::abs(box.point(Vec3::Zero())[axis] - offset) <= on_plane;
}

void make_alike(Contacts& contacts, const PartData<PartMesh>& meshes, const PartData<Hexahedron>& boxes,
                const MeasuredAxes& axes, const Symmetries& symmetries) {
  Alike alike(contacts, meshes, boxes, axes);
  alike.mirror(symmetries.mirrors);
  for (const SymmetryGroup& group : symmetries.groups) alike.spread(group);
}

void drop_covered(Contacts& contacts, const PartData<Hexahedron>& boxes) {
  PartData<std::vector<PartIndex>> touched(boxes.size());
  for (const auto& [pair, region] : contacts) {
    touched[pair.first].push_back(pair.second);
    touched[pair.second].push_back(pair.first);
  }
  for (auto& list : touched) std::sort(list.begin(), list.end());
  const auto is_covered = [&](const PartPair& pair, const ContactRegion& region) {
    const auto [a, c] = pair;
    if (region.empty()) return false;
    const std::optional<ContactPatch> patch = attach(boxes[a], boxes[c], region, false, false).attachment.patch;
    const double end = (boxes[a].corners * patch->normal).maxCoeff(),
                 start = (boxes[c].corners * patch->normal).minCoeff();
    if (start - end < distinct_points) return false;
    const Vec3 between = patch->centre + ((start + end) / 2 - patch->normal.dot(patch->centre)) * patch->normal;
    std::vector<PartIndex> both;
    std::set_intersection(touched[a].begin(), touched[a].end(), touched[c].begin(), touched[c].end(),
                          std::back_inserter(both));
    return std::any_of(both.begin(), both.end(),
                       [&](PartIndex b) { return boxes[b].local(between).cwiseAbs().maxCoeff() < 1; });
  };
  std::vector<PartPair> covered;
  for (const auto& [pair, region] : contacts) {
    if (is_covered(pair, region)) covered.push_back(pair);
  }
  for (const PartPair& pair : covered) contacts.erase(pair);
}

}  // namespace parsel
