#include "core/propagate/candidates.h"

#include <array>
#include <cmath>
#include <cstdint>
#include <set>

#include "core/base/tolerance.h"

namespace parsel {

namespace {

constexpr std::array<std::string_view, 7> hint_names = {"translate",    "rotate",       "scale",     "shear",
                                                        "change_count", "change_delta", "keep_fixed"};

/// Two displacement fields that are equal up to scale have equal keys (up to rounding, which costs a double, no more).
std::uint64_t key_of(const ResolvedOperator& what, const Corners& field) {
  Corners normal = field;
  if (what.op == Op::rotate) {
    // Where along its axis the origin of a turn lies does not matter.
    for (int k = 0; k < 8; ++k) {
      normal.row(k) -= (normal.row(k).dot(what.direction.transpose())) * what.direction.transpose();
    }
  } else {
    double scale = field.cwiseAbs().maxCoeff();
    for (int i = 0; i < 24; ++i) {
      if (std::abs(field.data()[i]) < 0.3 * scale) continue;
      if (field.data()[i] < 0) scale = -scale;
      break;
    }
    normal /= scale;
  }
  std::uint64_t hash = 0xcbf29ce484222325ULL;  // FNV-1a over the rounded numbers
  const auto add = [&hash](double value) {
    hash = (hash ^ static_cast<std::uint64_t>(std::llround(value * 1e6))) * 0x100000001b3ULL;
    hash ^= hash >> 29;
  };
  if (what.op == Op::rotate) {
    for (int i = 0; i < 3; ++i) add(2 + what.direction[i]);
  }
  for (int i = 0; i < 24; ++i) add(normal.data()[i]);
  return hash;
}

/// An axis to build operators on, and which local axis of the hexahedron it is, or -1.
struct Axis {
  Vec3 direction;
  int local = -1;
};

/// The local axes of a hexahedron, then the global ones that are none of them.
std::vector<Axis> axes_of(const Hexahedron& hexahedron) {
  std::vector<Axis> axes;
  for (int i = 0; i < 3; ++i) {
    Vec3 direction = hexahedron.axes.row(i).transpose();
    for (int g = 0; g < 3; ++g) {
      if (std::abs(std::abs(direction[g]) - 1) < 1e-9) direction = Vec3::Unit(g);
    }
    axes.push_back({direction, i});
  }
  for (int g = 0; g < 3; ++g) {
    bool known = false;
    for (int i = 0; i < 3; ++i) known = known || (axes[static_cast<std::size_t>(i)].direction == Vec3::Unit(g));
    if (!known) axes.push_back({Vec3::Unit(g), -1});
  }
  return axes;
}

int order_of(const LocalTriple& triple) {
  return (triple[0] != 0) + (triple[1] != 0) + (triple[2] != 0);
}

std::vector<LocalTriple> all_triples() {
  std::vector<LocalTriple> triples;
  for (int order = 0; order <= 3; ++order) {  // centre first: of equal fields the simplest origin stays
    for (int i = -1; i <= 1; ++i) {
      for (int j = -1; j <= 1; ++j) {
        for (int k = -1; k <= 1; ++k) {
          if (order_of({i, j, k}) == order) triples.push_back({i, j, k});
        }
      }
    }
  }
  return triples;
}

class Collector {
 public:
  Collector(const Shape& shape, PartIndex part, const std::optional<Hint>& hint)
      : shape_(shape), part_(part), rest_(shape.parts[part].hexahedron.corners), hint_(hint) {}

  void add(const ResolvedOperator& what, int symmetry_cost) {
    if (!allows(hint_, what, symmetry_cost)) return;
    const Corners field = unit_field(what, rest_);
    if (field.cwiseAbs().maxCoeff() < 1e-6) return;
    if (seen_.insert(key_of(what, field)).second)
      candidates_.push_back({what, Anchor::middle, field, symmetry_cost, false});
  }

  void add_group(Anchor anchor) {
    ResolvedOperator what;
    what.op = Op::change_delta;
    if (!allows(hint_, what, 0)) return;
    const Corners field = group_field(shape_, part_, Op::change_delta, anchor);
    if (field.cwiseAbs().maxCoeff() > 1e-6) candidates_.push_back({what, anchor, field, 0, false});
  }

  /// Operators on the whole part with the points and axes of `source`.
  void add_whole(const Hexahedron& source) {
    static const std::vector<LocalTriple> triples = all_triples();
    const std::vector<Axis> axes = axes_of(source);
    ResolvedOperator what;
    what.op = Op::translate;
    for (const Axis& axis : axes) {
      what.direction = axis.direction;
      add(what, 0);
    }
    for (const LocalTriple& at : triples) {
      what.origin = source.point(Vec3(at[0], at[1], at[2]));
      for (const Axis& axis : axes) {
        // Along a local axis only the origin's coordinate on it counts (scale_1d) or does not count (rotate, scale_2d).
        const bool is_local = axis.local >= 0;
        const bool along = is_local && order_of(at) == (at[static_cast<std::size_t>(axis.local)] != 0 ? 1 : 0);
        const bool across = is_local && at[static_cast<std::size_t>(axis.local)] == 0;
        what.direction = axis.direction;
        what.normal = axis.direction;
        if (along || !is_local) with_op(what, Op::scale_1d, 0);
        if (across || !is_local) with_op(what, Op::rotate, 0);
        if (across || !is_local) with_op(what, Op::scale_2d, 0);
        if (!along) continue;
        for (const Axis& other : axes) {
          if (other.local < 0 || other.local == axis.local) continue;
          what.direction = other.direction;
          with_op(what, Op::shear, 2);
        }
      }
      with_op(what, Op::scale_3d, 0);
    }
  }

  /// Operators on faces, edges and corners, with the part's own points and axes.
  void add_features(const Hexahedron& own) {
    static const std::vector<LocalTriple> triples = all_triples();
    const std::vector<Axis> axes = axes_of(own);
    for (const LocalTriple& feature : triples) {
      const int order = order_of(feature);
      if (order == 0) continue;
      ResolvedOperator what;
      what.feature = feature;
      what.op = Op::translate;
      for (std::size_t i = 0; i < axes.size(); ++i) {
        what.direction = axes[i].direction;
        add(what, order == 1 && i < 3 && feature[i] != 0 ? 0 : 2);
      }
      if (order == 3) continue;
      for (const LocalTriple& at : triples) {
        // Points of the feature itself.
        bool inside = true;
        for (std::size_t i = 0; i < 3; ++i) inside = inside && (feature[i] == 0 || at[i] == feature[i]);
        if (!inside) continue;
        what.origin = own.point(Vec3(at[0], at[1], at[2]));
        for (std::size_t i = 0; i < 3; ++i) {
          what.direction = axes[i].direction;
          what.normal = axes[i].direction;
          bool along = feature[i] == 0;
          for (std::size_t j = 0; j < 3; ++j) along = along && (j == i || feature[j] != 0 || at[j] == 0);
          if (along) with_op(what, Op::scale_1d, order);
          if (order == 1 && feature[i] != 0) {
            with_op(what, Op::scale_2d, 1);
            with_op(what, Op::rotate, 2);
          }
        }
      }
    }
  }

  void add_moved_faces(const Hexahedron& own, const Vec3& direction) {
    ResolvedOperator what;
    what.op = Op::translate;
    what.direction = direction;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double along = own.axes.row(static_cast<int>(axis)).dot(direction.transpose());
      for (const int side : {-1, 1}) {
        what.feature = {0, 0, 0};
        what.feature[axis] = side;
        add(what, std::abs(along) > 1 - 1e-9 ? 0 : 2);
      }
    }
  }

  std::vector<Candidate> take(bool from_neighbour) {
    for (Candidate& candidate : candidates_) candidate.from_neighbour = from_neighbour;
    return std::move(candidates_);
  }

 private:
  void with_op(ResolvedOperator what, Op op, int symmetry_cost) {
    what.op = op;
    if (!needs_direction(op)) what.direction = Vec3::Zero();
    if (!needs_normal(op)) what.normal = Vec3::Zero();
    add(what, symmetry_cost);
  }

  const Shape& shape_;
  PartIndex part_;
  Corners rest_;
  std::optional<Hint> hint_;
  std::vector<Candidate> candidates_;
  std::set<std::uint64_t> seen_;
};

}  // namespace

std::optional<Hint> hint_from_string(std::string_view text) {
  for (std::size_t i = 0; i < hint_names.size(); ++i) {
    if (hint_names[i] == text) return static_cast<Hint>(i);
  }
  return std::nullopt;
}

std::string_view to_string(Hint hint) {
  return hint_names[static_cast<std::size_t>(hint)];
}

bool allows(const std::optional<Hint>& hint, const ResolvedOperator& what, int symmetry_cost) {
  if (!hint) return true;
  const Op op = what.op;
  const bool whole = what.feature == LocalTriple{0, 0, 0};
  const bool scales = op == Op::scale_1d || op == Op::scale_2d || op == Op::scale_3d;
  switch (*hint) {
    case Hint::translate:
      return op == Op::translate && whole;
    case Hint::rotate:
    case Hint::shear:
      return (op == Op::rotate && whole) || op == Op::shear || (op == Op::translate && !whole && symmetry_cost >= 2);
    case Hint::scale:
      return scales || (op == Op::translate && !whole && symmetry_cost == 0);
    case Hint::change_count:
    case Hint::change_delta:
      return op == Op::change_delta;
    case Hint::keep_fixed:
      return false;
  }
  return false;
}

std::vector<Candidate> own_candidates(const Shape& shape, PartIndex part, const std::optional<Hint>& hint) {
  Collector collector(shape, part, hint);
  const Part& own = shape.parts[part];
  if (own.is_virtual()) {
    for (const Anchor anchor : {Anchor::middle, Anchor::start, Anchor::end}) {
      collector.add_group(anchor);
      if (shape.relations[*own.group].kind == RelationKind::rotation) break;  // anchors are ignored
    }
  }
  collector.add_whole(own.hexahedron);
  collector.add_features(own.hexahedron);
  return collector.take(false);
}

bool fills_its_extent(const Shape& shape, PartIndex parent) {
  const Relation& relation = shape.relations[*shape.parts[parent].group];
  const Corners& instance = shape.parts[relation.parts[0]].hexahedron.corners;
  const Vec3 centre = instance.colwise().mean().transpose();
  const auto extent_along = [&](const Vec3& direction) {
    const Eigen::Matrix<double, 8, 1> along = instance * direction;
    return along.maxCoeff() - along.minCoeff();
  };
  if (const auto* row = std::get_if<Translation>(&relation.detail)) {
    const Vec3 delta = (row->end - row->start) / (static_cast<double>(relation.parts.size()) - 1);
    return extent_along(delta.normalized()) > 0.75 * delta.norm();
  }
  const auto& ring = std::get<Rotation>(relation.detail);
  const Vec3 offset = centre - ring.centre;
  const Vec3 outwards = offset - ring.axis.dot(offset) * ring.axis;
  return outwards.norm() < noise || extent_along(outwards.normalized()) > ring.radius;
}

std::vector<Candidate> transplants(const Shape& shape, PartIndex part, const std::optional<Hint>& hint,
                                   const std::vector<PointConstraint>& constraints, const Edits& edits) {
  Collector collector(shape, part, hint);
  for (const PointConstraint& constraint : constraints) {
    for (const Step& step : edits[constraint.other]->steps) {
      if (!is_geometric(step.what.op)) continue;
      ResolvedOperator whole = step.what;
      whole.feature = {0, 0, 0};
      collector.add(whole, whole.op == Op::shear ? 2 : 0);
    }
  }
  return collector.take(true);
}

std::vector<Candidate> neighbour_candidates(const Shape& shape, PartIndex part, const std::optional<Hint>& hint,
                                            const std::vector<PointConstraint>& constraints, const Edits& edits) {
  Collector collector(shape, part, hint);
  const Hexahedron& own = shape.parts[part].hexahedron;
  std::set<PartIndex> seen;
  for (const PointConstraint& constraint : constraints) {
    if (edits[constraint.other]->steps.empty() || !seen.insert(constraint.other).second) continue;
    const Hexahedron& other = shape.parts[constraint.other].hexahedron;
    collector.add_whole(other);
    ResolvedOperator motion;
    motion.op = Op::translate;
    for (const Vec3& direction :
         {Vec3(own.point(Vec3::Zero()) - other.point(Vec3::Zero())), constraint.goal.back(), constraint.goal.front()}) {
      if (direction.norm() < exact) continue;
      motion.direction = direction.normalized();
      collector.add(motion, 0);
    }
    // An end that goes where it is pulled to, while the other stays: how a leg tilts.
    for (const Vec3& direction : {constraint.goal.back(), constraint.goal.front()}) {
      if (direction.norm() < exact) continue;
      collector.add_moved_faces(own, direction.normalized());
    }
  }
  return collector.take(true);
}

}  // namespace parsel
