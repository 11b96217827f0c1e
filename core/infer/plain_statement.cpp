#include "core/infer/plain_statement.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>

namespace parsel {

namespace {

constexpr std::array<const char*, 3> size_names = {"width", "height", "depth"};
constexpr double far_end = 0.3;       ///< of a slider: counts are scaled so that what is asked for lies within
constexpr double most_ratio = 4;      ///< and less is added to a length
constexpr double least_ratio = 0.95;  ///< and less is taken off
constexpr double farthest = 4;        ///< half-diagonals, and radians
constexpr int piece_slope = 8;        ///< pieces a unit of the slider, as in the prompts
constexpr double most_pieces = 60;

Error cannot(std::string why) {
  return {"infer/plain", "", std::move(why), "name another size"};
}

Amount amount(const std::string& text) {
  const Result<Amount> parsed = parse_amount(text);
  PARSEL_ASSERT(parsed.ok(), "amounts of plain requests are well-formed");
  return *parsed;
}

std::string times_x(int factor, bool negative) {
  return (negative ? "-" : "") + (factor == 1 ? std::string() : std::to_string(factor) + "*") + edit_parameter;
}

}  // namespace

DirectionReference StatementMaker::direction(PartIndex part, int axis) const {
  if (facts_.is_turned(part)) return PartAxis{facts_.shape().parts[part].id, axis};
  return Vec3(Vec3::Unit(axis));
}

Statement& StatementMaker::add(Op op, PartIndex part, const LocalTriple& feature) {
  Statement statement;
  statement.op = op;
  statement.part = facts_.shape().parts[part].id;
  statement.feature = feature;
  statement.amount = amount(times_x(1, sign_ < 0));
  edit.statements.push_back(std::move(statement));
  return edit.statements.back();
}

void StatementMaker::measured(Quantity quantity, PartIndex part, const char* what, double length) {
  quantity_ = quantity;
  part_ = part;
  what_ = what;
  length_ = length;
}

void StatementMaker::stretch(PartIndex part, int axis, const LocalTriple& at, const LocalTriple& feature) {
  Statement& s = add(Op::scale_1d, part, feature);
  s.origin = PartPoint{s.part, at};
  s.direction = direction(part, axis);
  measured(Quantity::ratio, part, size_names[static_cast<std::size_t>(axis)],
           2 * facts_.shape().parts[part].hexahedron.half_extents()[axis]);
}

void StatementMaker::widen_round(PartIndex part, int axis, const LocalTriple& feature) {
  Statement& s = add(Op::scale_2d, part, feature);
  s.origin = PartPoint{s.part, feature};
  s.normal = direction(part, axis);
  const int across = axis == 0 ? 1 : 0;
  measured(Quantity::ratio, part, size_names[static_cast<std::size_t>(across)],
           2 * facts_.shape().parts[part].hexahedron.half_extents()[across]);
}

void StatementMaker::grow(PartIndex part, const LocalTriple& at) {
  Statement& s = add(Op::scale_3d, part);
  s.origin = PartPoint{s.part, at};
  measured(Quantity::ratio, part, "size", 0);
}

void StatementMaker::move(PartIndex part, const Side& to) {
  Statement& s = add(Op::translate, part);
  s.direction = Vec3(Vec3::Unit(to.axis) * to.sign * sign_);
  s.amount = amount(times_x(1, false));
  measured(Quantity::distance, part, "distance", 1);
}

void StatementMaker::move_face(PartIndex part, const Side& side) {
  LocalTriple face = {0, 0, 0};
  face[static_cast<std::size_t>(side.axis)] = side.sign;
  Statement& s = add(Op::translate, part, face);
  s.direction = Vec3(Vec3::Unit(side.axis) * side.sign);
  measured(Quantity::distance, part, size_names[static_cast<std::size_t>(side.axis)], 1);
}

void StatementMaker::tilt(PartIndex part, const Side& way, const LocalTriple& end) {
  Statement& s = add(Op::rotate, part);
  s.origin = PartPoint{s.part, end};
  // The top goes towards `way` about up × way.
  s.direction = Vec3(Vec3::UnitY().cross(Vec3(Vec3::Unit(way.axis) * way.sign)));
  measured(Quantity::angle, part, "angle", 1);
}

void StatementMaker::swing(PartIndex part, int hinge) {
  Statement& s = add(Op::rotate, part);
  s.origin = PartPoint{s.part, {hinge, 0, -1}};
  s.direction = Vec3(Vec3::UnitY() * hinge);
  measured(Quantity::angle, part, "angle", 1);
}

void StatementMaker::more(PartIndex group) {
  const Part& parent = facts_.shape().parts[group];
  Statement& s = add(Op::change_count, group);
  s.part.clear();
  s.relation = facts_.shape().relations[*parent.group].id;
  s.anchor = Anchor::fit;
  s.amount = amount(times_x(piece_slope, sign_ < 0));
  measured(Quantity::pieces, group, "count", static_cast<double>(parent.members.size()));
}

void StatementMaker::space(PartIndex group) {
  const Part& parent = facts_.shape().parts[group];
  const Relation& relation = facts_.shape().relations[*parent.group];
  Statement& s = add(Op::change_delta, group);
  s.part.clear();
  s.relation = relation.id;
  s.anchor = Anchor::middle;
  const auto* row = std::get_if<Translation>(&relation.detail);
  const double spacing = row != nullptr
                             ? (row->end - row->start).norm() / static_cast<double>(parent.members.size() - 1)
                             : 0;  // a ring's radius is no size that one measures
  measured(Quantity::ratio, group, "spacing", spacing);
}

Result<double> StatementMaker::reach(const HowMuch& how, bool compares) const {
  const double scale = facts_.shape().frame.scale;
  const bool is_ratio = how.unit == HowMuch::Unit::ratio;
  if (!(how.value > 0)) return cannot("a size is more than 0");
  if (quantity_ == Quantity::angle) {
    if (how.unit != HowMuch::Unit::radian || how.kind != HowMuch::Kind::by) return cannot("a tilt is said in degrees");
    if (how.value > farthest) return cannot("that is more than half a turn");
    return sign_ * how.value;
  }
  if (how.unit == HowMuch::Unit::radian) return cannot("degrees are no size");
  if (quantity_ == Quantity::distance) {
    if (how.unit != HowMuch::Unit::metre || how.kind != HowMuch::Kind::by)
      return cannot("how far something goes is said in cm or the like");
    const double distance = how.value / scale;
    if (distance > farthest) return cannot("that is farther than twice the whole's size");
    return sign_ * distance;
  }
  double base = length_, delta = 0;
  if (quantity_ == Quantity::pieces) {
    if (how.unit != HowMuch::Unit::piece && !(is_ratio && how.kind == HowMuch::Kind::times))
      return cannot("how many is said as a number");
    delta = how.kind == HowMuch::Kind::by ? sign_ * how.value : (is_ratio ? how.value * base : how.value) - base;
    const double pieces = base + delta;
    if (std::abs(pieces - std::round(pieces)) > 1e-9) return cannot("that is no whole number of pieces");
    if (pieces < 2) return cannot("a row or ring has at least two pieces");
    if (pieces > most_pieces || pieces > 4 * base) return cannot("that is more than four times as many");
  } else {
    if (how.unit == HowMuch::Unit::piece) return cannot("it gives a number without a unit, such as cm or %");
    if (!is_ratio && length_ <= 0) return cannot("it does not say which of its sizes that is");
    if (whole_axis_) base = facts_.whole().size()[*whole_axis_];
    if (length_ <= 0) base = 1;
    const double value = is_ratio ? how.value * base : how.value / scale;
    delta = how.kind == HowMuch::Kind::by ? sign_ * value : value - base;
    const double ratio = delta / (length_ > 0 ? length_ : 1);
    if (ratio > most_ratio) return cannot("that is more than five times its size");
    if (ratio < -least_ratio) return cannot("nothing would be left of it");
    if (compares && delta * sign_ < 0) return cannot("it asks for more and for less");
    if (std::abs(ratio) < 1e-6) return cannot("it has that size already");
    return ratio;
  }
  if (compares && delta * sign_ < 0) return cannot("it asks for more and for less");
  if (std::abs(delta) < 1e-9) return cannot("there are as many already");
  return delta;
}

Meant StatementMaker::finish(const std::optional<HowMuch>& how_much, bool compares) const {
  Meant meant{{edit}, ""};
  if (!how_much) return meant;
  const Result<double> reached = reach(*how_much, compares);
  if (!reached.ok()) return {{edit}, reached.error().cause};
  PlainEdit& out = meant.edits.front();
  Statement& statement = out.statements.front();
  PlainTarget target{facts_.shape().parts[part_].id, what_, *how_much, 0};
  if (whole_axis_ && length_ > 0) {
    target.part.clear();
    target.what = size_names[static_cast<std::size_t>(*whole_axis_)];
  }
  const bool less = *reached < 0;
  const bool is_move = statement.op == Op::translate && statement.feature == LocalTriple{0, 0, 0};
  if (quantity_ == Quantity::pieces) {
    constexpr double within = 0.25;  // of a step, so that rounding down neither loses nor adds a piece
    const int slope = std::max(piece_slope, static_cast<int>(std::ceil((std::abs(*reached) + 1) / far_end)));
    target.x = (std::abs(*reached) + (less ? -within : within)) / slope;
    statement.amount = amount(times_x(slope, less));
  } else {
    // A steeper slider would be searched where nothing is left of narrow parts; this one goes on as far as all holds.
    target.x = std::abs(*reached);
    statement.amount = amount(times_x(1, less && !is_move));  // the direction of a move has its sign
  }
  if (how_much->kind == HowMuch::Kind::to && how_much->unit == HowMuch::Unit::ratio) {
    target.how_much.kind = HowMuch::Kind::times;  // "to 120 %"
  } else if (how_much->kind == HowMuch::Kind::by && how_much->unit == HowMuch::Unit::ratio) {
    target.how_much = {HowMuch::Kind::times, HowMuch::Unit::ratio, 1 + sign_ * how_much->value};
  } else if (how_much->kind == HowMuch::Kind::by && !is_move && quantity_ != Quantity::angle) {
    target.how_much.value *= sign_;
  }
  out.target = target;
  return meant;
}

}  // namespace parsel
