#include "core/export/close_gaps.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>

#include "core/base/tolerance.h"
#include "core/propagate/contact.h"

namespace parsel {

namespace {

/// Below it a face does not look at the other part: cos 30°.
constexpr double facing = 0.866;
/// Of a part's length along the axis.
constexpr double most_growth = 1;
/// A part that grows may come up against another one, which then comes to be looked at again.
constexpr int most_rounds = 4;

struct Joint {
  RelationIndex relation;
  PartIndex first, second;
  Contact contact;
};

/// The group that a part is an instance of, and which one.
struct Membership {
  RelationIndex group;
  std::size_t number;
};

struct Pose {
  double distance = 0;  ///< along the contact's normal; negative where the parts overlap
  double apart = 0;     ///< more than at rest
  double gap = 0;       ///< how much of that is open
  double lost = 0;
};

Pose pose_of(const Contact& contact, const Corners& first, const Corners& second) {
  const ContactChange change = change_of(contact, first, second);
  const double distance = contact.distance + change.apart;
  return {distance, change.apart, distance - std::max(contact.distance, 0.0), change.lost};
}

/// The mean edge along a local axis.
Vec3 edge_of(const Corners& corners, int axis) {
  Vec3 edge = Vec3::Zero();
  for (int k = 0; k < 8; ++k) edge += corner_sign(k, axis) * corners.row(k).transpose() / 4;
  return edge;
}

/// Out of the first part into the second, unit; zero where the face that it belongs to is flat.
Vec3 direction_of(const Contact& contact, const Corners& first, const Corners& second) {
  const Corners& owner = contact.of_first ? first : second;
  const Vec3 normal = edge_of(owner, (contact.axis + 1) % 3).cross(edge_of(owner, (contact.axis + 2) % 3));
  const double length = normal.norm();
  if (length < noise) return Vec3::Zero();
  return normal / length * (normal.dot(edge_of(owner, contact.axis)) < 0 ? -1 : 1) * contact.side;
}

class Closer {
 public:
  Closer(const Shape& shape, State& state) : shape_(shape), state_(state) {
    std::vector<std::optional<Membership>> group(shape.parts.size());
    for (const RelationIndex r : shape.relations.indices()) {
      const Relation& relation = shape.relations[r];
      if (!relation.is_group()) continue;
      for (std::size_t k = 0; k < relation.parts.size(); ++k) group[relation.parts[k].value()] = Membership{r, k};
    }
    memberships_ = std::move(group);
    for (const RelationIndex r : shape.relations.indices()) {
      const Relation& relation = shape.relations[r];
      if (!relation.is_attachment()) continue;
      const PartIndex a = relation.parts[0], b = relation.parts[1];
      if (!is_there(a) || !is_there(b)) continue;
      const auto contact = contact_of(shape.parts[a].hexahedron.corners, shape.parts[b].hexahedron.corners);
      if (contact) joints_.push_back({r, a, b, *contact});
    }
  }

  std::vector<Gap> gaps() const {
    std::vector<Gap> found;
    for (const Joint& joint : joints_) {
      const double width = pose(joint).gap;
      if (width > narrowest_gap) found.push_back({joint.relation, width});
    }
    return found;
  }

  ClosedGaps close() {
    ClosedGaps done;
    done.before = gaps();
    bool any = true;
    for (int round = 0; any && round < most_rounds; ++round) {
      any = false;
      // The widest first: what closes it may close narrower ones that the same face has opened.
      std::vector<std::pair<double, const Joint*>> open;
      for (const Joint& joint : joints_) {
        if (const double width = pose(joint).gap; width > narrowest_gap) open.emplace_back(-width, &joint);
      }
      std::stable_sort(open.begin(), open.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
      for (const auto& [width, joint] : open) {
        if (pose(*joint).gap <= narrowest_gap) continue;
        if (const auto extension = close(*joint)) {
          done.extensions.push_back(*extension);
          any = true;
        }
      }
    }
    done.left = gaps();
    return done;
  }

 private:
  struct Candidate {
    PartIndex part;
    Corners corners;
    double length = 0, growth = 0;
  };

  bool is_there(PartIndex part) const {
    if (shape_.parts[part].is_virtual()) return false;
    const auto& membership = memberships_[part.value()];
    return !membership || !state_.groups[membership->group].count_changed;
  }

  Pose pose(const Joint& joint) const {
    return pose_of(joint.contact, state_.parts[joint.first], state_.parts[joint.second]);
  }

  std::optional<Extension> close(const Joint& joint) {
    const Pose now = pose(joint);
    if (now.lost > 1 - 1e-6) return std::nullopt;
    const Vec3 direction = direction_of(joint.contact, state_.parts[joint.first], state_.parts[joint.second]);
    std::vector<Candidate> candidates;
    if (auto first = grown(joint.first, direction, now.apart)) candidates.push_back(std::move(*first));
    if (auto second = grown(joint.second, -direction, now.apart)) candidates.push_back(std::move(*second));
    // A leg grows rather than the seat above it.
    std::stable_sort(candidates.begin(), candidates.end(),
                     [](const Candidate& a, const Candidate& b) { return a.growth < b.growth; });
    for (const Candidate& candidate : candidates) {
      if (!is_harmless(candidate, joint)) continue;
      put(candidate.part, candidate.corners);
      return Extension{joint.relation, candidate.part, candidate.length};
    }
    return std::nullopt;
  }

  /// The part with the face that looks most in a direction moved along its own edges until it is farther by `by` there.
  std::optional<Candidate> grown(PartIndex part, const Vec3& direction, double by) const {
    const Corners& corners = state_.parts[part];
    int best = -1;
    double most = facing;
    for (int axis = 0; axis < 3; ++axis) {
      const Vec3 edge = edge_of(corners, axis);
      if (edge.norm() < noise) continue;
      if (const double along = std::abs(edge.dot(direction)) / edge.norm(); along > most) {
        most = along;
        best = axis;
      }
    }
    if (best < 0) return std::nullopt;
    const Vec3 edge = edge_of(corners, best);
    const int side = edge.dot(direction) > 0 ? 1 : -1;
    const double length = by / most;
    if (length > most_growth * edge.norm()) return std::nullopt;
    Candidate made{part, corners, length, length / edge.norm()};
    for (int k = 0; k < 8; ++k) {
      if (corner_sign(k, best) == side) made.corners.row(k) += side * length * edge.normalized().transpose();
    }
    return made;
  }

  /// No other joint of the part opens, and it enters no part deeper than before, save the one that it now reaches.
  bool is_harmless(const Candidate& candidate, const Joint& closed) const {
    const Corners& before = state_.parts[candidate.part];
    for (const Joint& joint : joints_) {
      if (joint.relation == closed.relation) continue;
      if (joint.first != candidate.part && joint.second != candidate.part) continue;
      const bool is_first = joint.first == candidate.part;
      const Corners& other = state_.parts[is_first ? joint.second : joint.first];
      const Pose was = pose(joint);
      const Pose is = is_first ? pose_of(joint.contact, candidate.corners, other)
                               : pose_of(joint.contact, other, candidate.corners);
      if (is.gap > std::max(was.gap, narrowest_gap)) return false;
    }
    for (const PartIndex other : shape_.parts.indices()) {
      if (other == candidate.part || other == closed.first || other == closed.second || !is_there(other)) continue;
      const auto was = contact_of(before, state_.parts[other]);
      const auto is = contact_of(candidate.corners, state_.parts[other]);
      if (was && !is) return false;
      if (was && is && is->distance < std::min(was->distance, 0.0) - narrowest_gap) return false;
    }
    return true;
  }

  void put(PartIndex part, const Corners& corners) {
    state_.parts[part] = corners;
    if (const auto& membership = memberships_[part.value()])
      state_.groups[membership->group].instances[membership->number] = corners;
  }

  const Shape& shape_;
  State& state_;
  std::vector<std::optional<Membership>> memberships_;  ///< by part
  std::vector<Joint> joints_;
};

}  // namespace

std::vector<Gap> find_gaps(const Shape& shape, const State& state) {
  State copy = state;
  return Closer(shape, copy).gaps();
}

ClosedGaps close_gaps(const Shape& shape, State& state) {
  return Closer(shape, state).close();
}

nlohmann::json to_json(const Shape& shape, const ClosedGaps& gaps) {
  const double scale = shape.frame.scale;
  nlohmann::json json{
      {"gaps", gaps.before.size()}, {"closed", nlohmann::json::array()}, {"left", nlohmann::json::array()}};
  for (const Extension& made : gaps.extensions) {
    json["closed"].push_back({{"relation", shape.relations[made.relation].id},
                              {"part", shape.parts[made.part].id},
                              {"longer", made.length * scale}});
  }
  for (const Gap& gap : gaps.left) {
    const Relation& relation = shape.relations[gap.relation];
    json["left"].push_back({{"relation", relation.id},
                            {"parts", {shape.parts[relation.parts[0]].id, shape.parts[relation.parts[1]].id}},
                            {"width", gap.width * scale}});
  }
  return json;
}

}  // namespace parsel
