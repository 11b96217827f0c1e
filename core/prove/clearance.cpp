#include "core/prove/clearance.h"

#include <Eigen/Geometry>
#include <Eigen/QR>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <numeric>
#include <tuple>

#include "core/base/tolerance.h"
#include "core/prove/scope.h"
#include "core/shape/hexahedron.h"
#include "core/shape/hexahedron_extent.h"

namespace parsel {

namespace {

/// Cross products of edges shorter than this have no direction.
constexpr double parallel = 1e-6;

/// Where the layer's parameter is looked at to see which parts go with which.
constexpr double looked_at = 0.1;
/// Corners that are carried along are where the other part's motion takes them within this; half-diagonals.
constexpr double carried = 1e-6;

/// Whether the affine motion that takes the corners `leader` to `leader_now` takes `part` to `part_now`.
bool goes_along(const Corners& leader, const Corners& leader_now, const Corners& part, const Corners& part_now) {
  const Eigen::Matrix<double, 8, 4> from = leader.rowwise().homogeneous(), to = part.rowwise().homogeneous();
  const Eigen::Matrix<double, 4, 3> motion = from.colPivHouseholderQr().solve(leader_now);
  return (from * motion - leader_now).cwiseAbs().maxCoeff() <= carried &&
         (to * motion - part_now).cwiseAbs().maxCoeff() <= carried;
}

/// What two boxes have in common, or what lies between them.
struct Overlap {
  double depth = std::numeric_limits<double>::infinity();  ///< negative: by how much they are apart at least
  double volume = 0;  ///< about: the depth times the extents that both have across it
};

Overlap overlap_of(const Corners& a, const Corners& b) {
  const HexahedronAxes first = axes_of(a), second = axes_of(b);
  Overlap least;
  Vec3 along = Vec3::Zero();
  const auto look = [&](const Vec3& direction) {
    const Extent of_a = extent_along(a, direction), of_b = extent_along(b, direction);
    // How far one must move to be out of the other; negative when it is.
    const double depth = std::min(of_a.high - of_b.low, of_b.high - of_a.low);
    if (depth >= least.depth) return;
    least.depth = depth;
    along = direction;
  };
  for (const Vec3& normal : first.normals) look(normal);
  for (const Vec3& normal : second.normals) look(normal);
  for (const Vec3& edge : first.edges) {
    for (const Vec3& other : second.edges) {
      const Vec3 across = edge.cross(other);
      if (across.norm() > parallel) look(across.normalized());
    }
  }
  if (least.depth <= 0) return least;
  const auto lies_across = [&](const Vec3& p, const Vec3& q) {
    return std::abs(p.dot(along)) < std::abs(q.dot(along));
  };
  const Vec3 edge = *std::min_element(first.edges.begin(), first.edges.end(), lies_across);
  const Vec3 across = (edge - edge.dot(along) * along).normalized(), third = along.cross(across);
  least.volume = least.depth;
  for (const Vec3& side : {across, third})
    least.volume *= std::max(0.0, common(extent_along(a, side), extent_along(b, side)));
  return least;
}

/// By how much the surfaces that touched are apart, across them, where they are nearest: parts may slide.
double surfaces_apart(const ContactPatch& patch, const Corners& a, const Corners& b) {
  std::array<Vec3, 4> on_a;
  for (std::size_t k = 0; k < 4; ++k) on_a[k] = interpolate(trilinear_weights(patch.local_a[k]), a);
  const Vec3 across = (on_a[1] - on_a[0]).cross(on_a[2] - on_a[0]);
  if (across.norm() < parallel) return 0;  // a line or a point has no side
  const Vec3 rest_across = patch.half_sides[0].cross(patch.half_sides[1]);
  const Vec3 normal = across.normalized() * (rest_across.dot(patch.normal) < 0 ? -1 : 1);
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < 4; ++k) {
    const Vec3 on_b = interpolate(trilinear_weights(patch.local_b[k]), b);
    least = std::min(least, (on_b - on_a[k]).dot(normal));
  }
  return std::max(0.0, least);
}

}  // namespace

Clearance::Clearance(const Shape& shape, const Program& program, std::size_t layer,
                     const std::set<std::string>& disabled)
    : shape_(shape), layer_(layer), evaluator_(program, shape) {
  for (const Layer& l : program.layers) values_.push_back(l.parameter.value);
  const Scope scope = scope_of(shape, program, layer, {});
  edited_ = scope.edited;
  dissolved_ = scope.dissolved;
  at_rest_ = state_at(0);
  meant_to_part_ = meant_to_part(disabled);
}

std::set<RelationIndex> Clearance::meant_to_part(const std::set<std::string>& disabled) const {
  std::set<RelationIndex> parting;
  if (disabled.empty()) return parting;
  const State moved = state_at(looked_at);
  for (const RelationIndex r : shape_.relations.indices()) {
    const Relation& loose = shape_.relations[r];
    if (!loose.is_attachment() || !is_disabled(loose, disabled)) continue;
    const auto goes_with = [&](std::size_t end, PartIndex part) {
      const PartIndex leader = loose.parts[end];
      return part == leader ||
             goes_along(at_rest_.parts[leader], moved.parts[leader], at_rest_.parts[part], moved.parts[part]);
    };
    for (const RelationIndex other : shape_.relations.indices()) {
      const Relation& joint = shape_.relations[other];
      if (!joint.is_attachment()) continue;
      const PartIndex a = joint.parts[0], b = joint.parts[1];
      if ((goes_with(0, a) && goes_with(1, b)) || (goes_with(0, b) && goes_with(1, a))) parting.insert(other);
    }
  }
  return parting;
}

State Clearance::state_at(double x) const {
  std::vector<double> values = values_;
  values[layer_] = x;
  return evaluator_(values);
}

bool Clearance::is_instance(PartIndex part) const {
  const auto& group = shape_.parts[part].group;
  return group && std::find(dissolved_.begin(), dissolved_.end(), *group) == dissolved_.end();
}

bool Clearance::has_changed_count(PartIndex part, const State& state) const {
  if (!is_instance(part)) return false;
  const RelationIndex group = *shape_.parts[part].group;
  return state.groups[group].instances.size() != at_rest_.groups[group].instances.size();
}

std::vector<Clearance::Body> Clearance::bodies(const State& state) const {
  const RelationIndex none(shape_.relations.size());
  std::vector<Body> result;
  for (const PartIndex p : shape_.parts.indices()) {
    if (shape_.parts[p].is_virtual() || has_changed_count(p, state)) continue;
    const Corners& corners = state.parts[p];
    result.push_back({p, is_instance(p) ? *shape_.parts[p].group : none, corners,
                      corners.colwise().minCoeff().transpose(), corners.colwise().maxCoeff().transpose()});
  }
  return result;
}

void Clearance::find_overlaps(const std::vector<Body>& now, std::vector<Fault>& found) const {
  const RelationIndex none(shape_.relations.size());
  // Sweep along x: a body meets those before it that have not ended yet.
  std::vector<std::size_t> order(now.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(),
            [&](std::size_t a, std::size_t b) { return std::pair(now[a].low.x(), a) < std::pair(now[b].low.x(), b); });
  std::vector<std::size_t> open;
  for (const std::size_t i : order) {
    const Body& body = now[i];
    open.erase(std::remove_if(open.begin(), open.end(), [&](std::size_t o) { return now[o].high.x() < body.low.x(); }),
               open.end());
    for (const std::size_t o : open) {
      const Body& other = now[o];
      if (edited_.count(body.part) == 0 && edited_.count(other.part) == 0) continue;
      if (body.group == other.group && body.group != none) continue;
      if ((body.low.array() > other.high.array()).any() || (other.low.array() > body.high.array()).any()) continue;
      const Overlap overlap = overlap_of(body.corners, other.corners);
      if (overlap.depth <= 0 || (overlap.depth <= seen_depth && overlap.volume <= seen_volume)) continue;
      const Corners& rest = at_rest_.parts[body.part];
      const Corners& rest_of_other = at_rest_.parts[other.part];
      const double slight = std::min(delta_both_edited, std::min(thickness(rest), thickness(rest_of_other)) / 2);
      const Overlap before = overlap_of(rest, rest_of_other);
      if (before.depth > slight) continue;
      if (before.depth > -seen_gap && overlap.depth <= seen_depth + std::max(before.depth, 0.0)) continue;
      found.push_back({body.part, other.part, false});
    }
    open.push_back(i);
  }
}

void Clearance::find_gaps(const State& state, std::vector<Fault>& found) const {
  for (const RelationIndex r : shape_.relations.indices()) {
    const Relation& relation = shape_.relations[r];
    if (!relation.is_attachment() || meant_to_part_.count(r) > 0) continue;
    const PartIndex a = relation.parts[0], b = relation.parts[1];
    if (shape_.parts[a].is_virtual() || shape_.parts[b].is_virtual()) continue;
    if (edited_.count(a) == 0 && edited_.count(b) == 0) continue;
    if (has_changed_count(a, state) || has_changed_count(b, state)) continue;
    const auto& patch = std::get<Attachment>(relation.detail).patch;
    const auto apart = [&](const State& s) {
      const double boxes = std::max(0.0, -overlap_of(s.parts[a], s.parts[b]).depth);
      return patch ? std::max(boxes, surfaces_apart(*patch, s.parts[a], s.parts[b])) : boxes;
    };
    const double gap = apart(state);
    if (gap > seen_gap && gap > seen_gap + apart(at_rest_)) found.push_back({a, b, true});
  }
}

std::vector<Clearance::Fault> Clearance::faults(double x) const {
  const State state = state_at(x);
  std::vector<Fault> found;
  find_overlaps(bodies(state), found);
  find_gaps(state, found);
  found.erase(std::remove_if(found.begin(), found.end(),
                             [&](const Fault& fault) { return accepted_.count(std::minmax(fault.a, fault.b)) > 0; }),
              found.end());
  return found;
}

std::string Clearance::fault(double x) const {
  const std::vector<Fault> found = faults(x);
  if (found.empty()) return "";
  const auto& [first, second] = std::minmax(shape_.parts[found[0].a].id, shape_.parts[found[0].b].id);
  return first + " and " + second + (found[0].apart ? " would come apart" : " would run into each other");
}

void Clearance::accept(double x) {
  for (const Fault& fault : faults(x)) accepted_.insert(std::minmax(fault.a, fault.b));
}

bool Clearance::accept_gaps(double x) {
  bool overlap = false;
  for (const Fault& fault : faults(x)) {
    if (fault.apart) accepted_.insert(std::minmax(fault.a, fault.b));
    overlap = overlap || !fault.apart;
  }
  return overlap;
}

std::vector<SeenFault> seen_faults(const Shape& shape, const Program& program, std::size_t layer) {
  const Clearance clearance(shape, program, layer, disabled_in(program.layers[layer]));
  const Parameter& range = program.layers[layer].parameter;
  std::set<std::tuple<PartIndex, PartIndex, bool>> known;
  std::vector<SeenFault> seen;
  for (int step = 1; step <= seen_steps; ++step) {
    for (const double end : {range.min, range.max}) {
      if (end == 0) continue;
      const double x = end * step / seen_steps;
      for (const Clearance::Fault& fault : clearance.faults(x)) {
        const auto [a, b] = std::minmax(fault.a, fault.b);
        if (known.insert({a, b, fault.apart}).second)
          seen.push_back({shape.parts[a].id, shape.parts[b].id, fault.apart, x});
      }
    }
  }
  return seen;
}

nlohmann::json to_json(const std::vector<SeenFault>& faults) {
  nlohmann::json list = nlohmann::json::array();
  for (const SeenFault& fault : faults)
    list.push_back({{"parts", {fault.a, fault.b}}, {"apart", fault.apart}, {"x", fault.x}});
  return list;
}

}  // namespace parsel
