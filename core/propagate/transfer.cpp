#include "core/propagate/transfer.h"

#include <cmath>

namespace parsel {

namespace {

constexpr double coincident = 1e-6;

Vec3 mirrored(const Vec3& v, const Vec3& normal) {
  return v - 2 * normal.dot(v) * normal;
}

/// The feature of the image part that consists of the images of the feature's corners. `image[k]` is where corner k
/// goes.
std::optional<LocalTriple> mapped_feature(const LocalTriple& feature, const std::array<int, 8>& image) {
  std::array<bool, 8> wanted{};
  for (int k = 0; k < 8; ++k) {
    if (selects(feature, k)) wanted[static_cast<std::size_t>(image[static_cast<std::size_t>(k)])] = true;
  }
  for (int i = -1; i <= 1; ++i) {
    for (int j = -1; j <= 1; ++j) {
      for (int l = -1; l <= 1; ++l) {
        bool equal = true;
        for (int k = 0; k < 8; ++k) equal = equal && selects({i, j, l}, k) == wanted[static_cast<std::size_t>(k)];
        if (equal) return LocalTriple{i, j, l};
      }
    }
  }
  return std::nullopt;
}

/// Start and end change places when the image of the first group's start is the second's end.
std::optional<Anchor> mapped_anchor(const Shape& shape, const Reflection& plane, PartIndex from, PartIndex to,
                                    Anchor anchor) {
  const Part& a = shape.parts[from];
  const Part& b = shape.parts[to];
  if (!a.is_virtual() || !b.is_virtual()) return std::nullopt;
  const Relation& group_a = shape.relations[*a.group];
  const Relation& group_b = shape.relations[*b.group];
  if (group_a.kind != group_b.kind || group_a.parts.size() != group_b.parts.size()) return std::nullopt;
  if (group_a.kind == RelationKind::rotation || anchor == Anchor::middle || anchor == Anchor::fit) return anchor;
  const auto& translation_a = std::get<Translation>(group_a.detail);
  const auto& translation_b = std::get<Translation>(group_b.detail);
  const Vec3 start = plane.origin + mirrored(translation_a.start - plane.origin, plane.normal);
  const bool swaps = (start - translation_b.start).norm() > (start - translation_b.end).norm();
  if (!swaps) return anchor;
  return anchor == Anchor::start ? Anchor::end : Anchor::start;
}

PointReference point_reference(const Shape& shape, const std::vector<PartIndex>& sources, const Vec3& point) {
  for (const PartIndex source : sources) {
    const Part& candidate = shape.parts[source];
    const Vec3 local = candidate.hexahedron.local(point);
    const Vec3 rounded = local.array().round().matrix();
    if (rounded.cwiseAbs().maxCoeff() > 1) continue;
    if ((candidate.hexahedron.point(rounded) - point).norm() > coincident) continue;
    return PartPoint{candidate.id,
                     {static_cast<int>(rounded.x()), static_cast<int>(rounded.y()), static_cast<int>(rounded.z())}};
  }
  return point;
}

/// The reference and the sign with which `direction` is along it.
std::pair<DirectionReference, double> direction_reference(const Shape& shape, const std::vector<PartIndex>& sources,
                                                          const Vec3& direction) {
  for (int g = 0; g < 3; ++g) {
    if (std::abs(std::abs(direction[g]) - 1) < 1e-9) return {Vec3(Vec3::Unit(g)), direction[g] > 0 ? 1 : -1};
  }
  for (const PartIndex source : sources) {
    const Part& candidate = shape.parts[source];
    for (int axis = 0; axis < 3; ++axis) {
      const double along = candidate.hexahedron.axes.row(axis).dot(direction.transpose());
      if (std::abs(std::abs(along) - 1) < 1e-9) return {PartAxis{candidate.id, axis}, along > 0 ? 1 : -1};
    }
  }
  return {direction, 1};
}

}  // namespace

std::optional<std::vector<Step>> reflected(const Shape& shape, const Relation& relation, PartIndex from,
                                           const std::vector<Step>& steps) {
  const auto& plane = std::get<Reflection>(relation.detail);
  const bool is_first = relation.parts[0] == from;
  const PartIndex to = relation.parts[is_first ? 1 : 0];
  std::array<int, 8> image{};  // corner k of `from` → corner image[k] of `to`
  for (std::size_t k = 0; k < 8; ++k) {
    const auto a = static_cast<std::size_t>(plane.corner_map[k]);
    if (is_first) {
      image[a] = static_cast<int>(k);
    } else {
      image[k] = static_cast<int>(a);
    }
  }
  std::vector<Step> result;
  for (Step step : steps) {
    ResolvedOperator& what = step.what;
    if (!is_geometric(what.op)) {
      const auto anchor = mapped_anchor(shape, plane, from, to, step.anchor);
      if (!anchor) return std::nullopt;
      step.anchor = *anchor;
      result.push_back(std::move(step));
      continue;
    }
    const auto feature = mapped_feature(what.feature, image);
    if (!feature) return std::nullopt;
    what.feature = *feature;
    what.origin = plane.origin + mirrored(what.origin - plane.origin, plane.normal);
    what.direction = mirrored(what.direction, plane.normal);
    // The mirror image of a turn about n is the turn back about n's image.
    if (what.op == Op::rotate) what.direction = -what.direction;
    what.normal = mirrored(what.normal, plane.normal);
    result.push_back(std::move(step));
  }
  return result;
}

Statement to_statement(const Shape& shape, PartIndex part, const Step& step, const std::vector<PartIndex>& sources) {
  const ResolvedOperator& what = step.what;
  Statement statement;
  statement.op = what.op;
  statement.anchor = step.anchor;
  GiNaC::ex amount = step.amount;
  if (!is_geometric(what.op)) {
    statement.relation = shape.relations[*shape.parts[part].group].id;
    statement.amount = Amount(amount);
    return statement;
  }
  statement.part = shape.parts[part].id;
  statement.feature = what.feature;
  if (needs_origin(what.op)) statement.origin = point_reference(shape, sources, what.origin);
  double sign = 1;
  if (needs_direction(what.op)) {
    const auto [reference, s] = direction_reference(shape, sources, what.direction);
    statement.direction = reference;
    if (what.op != Op::scale_1d) sign *= s;
  }
  if (needs_normal(what.op)) {
    const auto [reference, s] = direction_reference(shape, sources, what.normal);
    statement.normal = reference;
    if (what.op == Op::shear) sign *= s;
  }
  if (sign < 0) amount = (-amount).expand();
  statement.amount = Amount(amount);
  return statement;
}

Step to_step(const Shape& shape, const Statement& statement) {
  Step step;
  step.what.op = statement.op;
  step.what.feature = statement.feature;
  step.anchor = statement.anchor;
  step.amount = statement.amount.expression();
  const auto find = [&shape](const std::string& id) {
    const auto part = shape.find_part(id);
    PARSEL_ASSERT(part.has_value(), "the parts of a statement are checked before it is used");
    return shape.parts[*part].hexahedron;
  };
  const auto direction = [&](const DirectionReference& reference) -> Vec3 {
    if (const auto* axis = std::get_if<PartAxis>(&reference)) return find(axis->part).axes.row(axis->axis).transpose();
    return std::get<Vec3>(reference).normalized();
  };
  if (statement.origin) {
    if (const auto* point = std::get_if<PartPoint>(&*statement.origin)) {
      step.what.origin = find(point->part).point(Vec3(point->at[0], point->at[1], point->at[2]));
    } else {
      step.what.origin = std::get<Vec3>(*statement.origin);
    }
  }
  if (statement.direction) step.what.direction = direction(*statement.direction);
  if (statement.normal) step.what.normal = direction(*statement.normal);
  return step;
}

}  // namespace parsel
