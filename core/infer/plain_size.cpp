// Sizes of parts: plain_part.h.
#include <algorithm>
#include <cmath>

#include "core/infer/plain_part.h"

namespace parsel {

namespace {

constexpr double flat = 0.2;     ///< of its width, and less is a top, which gets larger but not thicker
constexpr double beside = 0.02;  ///< and more is on a side, in half-diagonals

}  // namespace

Meant no_edit(std::string fault) {
  return {{}, std::move(fault)};
}

bool is_size(Change change) {
  return change == Change::width || change == Change::height || change == Change::depth || change == Change::length ||
         change == Change::thick || change == Change::size;
}

std::string name_of(const Shape& shape, PartIndex part) {
  const Part& named = shape.parts[part];
  return named.name.empty() ? named.id : named.name;
}

Meant PartMeaning::of(PartIndex part, const std::vector<PartIndex>& set) {
  if (is_size(clause_.change)) return size_of(part, set);
  switch (clause_.change) {
    case Change::raise:
      return raise(part);
    case Change::count:
      return count(part);
    case Change::spacing:
      return spacing(part, set);
    case Change::move:
      return move(part, set);
    case Change::tilt:
      return tilt(part, set);
    case Change::open:
      return open(part);
    case Change::taper:
      if (!clause_.where) return no_edit("it does not say towards which end");
      return taper(part, facts_.long_axis(part), -1);
    default:
      return no_edit("it does not say what shall change");
  }
}

std::string PartMeaning::group_fault(PartIndex part, int axis, bool two_axes) const {
  const Part& parent = shape_.parts[part];
  if (!parent.is_virtual()) return "";
  const Relation& group = shape_.relations[*parent.group];
  const std::string why = name_of(shape_, part) + " is a row or ring, whose pieces cannot change that way together";
  if (const auto* row = std::get_if<Translation>(&group.detail)) {
    const int way = main_axis_of(row->end - row->start);
    return two_axes ? (axis == way ? "" : why) : (axis == way ? why : "");
  }
  const int about = main_axis_of(std::get<Rotation>(group.detail).axis);
  return !two_axes && axis == about ? "" : why;
}

std::optional<int> PartMeaning::axis_of(PartIndex part) const {
  switch (clause_.change) {
    case Change::width:
      return 0;
    case Change::height:
      return 1;
    case Change::depth:
      return 2;
    case Change::length:
      return clause_.where ? clause_.where->axis : facts_.long_axis(part);
    default:
      return facts_.thin_axis(part);
  }
}

Meant PartMeaning::size_of(PartIndex part, const std::vector<PartIndex>& set) {
  StatementMaker make(facts_, clause_.sign);
  // A seat that is 50 cm high is up there, not that thick.
  const Vec3 e = facts_.edges(part);
  if (clause_.change == Change::height && e[1] < flat * std::min(e[0], e[2]))
    return no_edit("it is not clear whether " + name_of(shape_, part) + " shall be thicker or higher up");
  const auto bar = facts_.bar_axis(part);
  const bool to_side = clause_.change == Change::width || clause_.change == Change::depth;
  const int side_axis = clause_.change == Change::width ? 0 : 2;
  // "wider legs" are thicker ones; deeper ones would be an odd thing to ask for.
  if (bar && to_side && *bar != side_axis && !clause_.where && clause_.out == 0 && clause_.change == Change::depth)
    return no_edit("it is not clear which way " + name_of(shape_, part) + " is deep");
  const bool across_bar = bar && (clause_.change == Change::thick || (clause_.change == Change::width && *bar == 1));
  const bool across_round = clause_.change == Change::width && !bar && facts_.is_round(part);
  if (clause_.change == Change::size) {
    if (clause_.where || clause_.out != 0) return no_edit("it is not clear what shall happen on that side");
    if (shape_.parts[part].is_virtual()) return no_edit(group_fault(part, -1, false));
    // A shade grows from where it is held.
    constexpr double held = 0.4;
    e[1] < flat* std::min(e[0], e[2]) ? make.widen_round(part, 1, {0, 0, 0})
                                      : make.grow(part, {0, facts_.held_end(part, 1, held), 0});
    return finished(make);
  }
  if (clause_.change == Change::thick && !bar && facts_.may_be_ring(part))
    return no_edit("it is not clear which way " + name_of(shape_, part) + " is thick");
  const auto axis = across_bar ? bar : across_round ? std::optional(1) : axis_of(part);
  if (!axis)
    return no_edit("it is not clear which way " + name_of(shape_, part) + " is " +
                   (clause_.change == Change::thick ? "thick" : "long"));
  if (clause_.where || clause_.out != 0) {
    Side side = clause_.where.value_or(Side{});
    if (!clause_.where) {
      if (across_round) return no_edit("it is not clear what shall happen on that side");
      const auto [away, sign] = facts_.outward(part);
      side = {across_bar ? away : *axis, sign * clause_.out};
      if (side.axis != away)
        side.sign =
            facts_.extent(part).centre()[side.axis] >= facts_.whole().centre()[side.axis] ? clause_.out : -clause_.out;
    }
    const bool same_axis = side.axis == *axis;
    if (across_bar || across_round || !same_axis)
      return taper(part, across_bar ? bar : across_round ? std::optional(1) : std::optional(side.axis), clause_.sign);
    make.move_face(part, side);
    if (clause_.where && joined_across(set, side.axis)) {
      for (const RelationIndex r : facts_.reflections_across(side.axis)) make.edit.loose.insert(r);
    }
    return finished(make);
  }
  if (std::string fault = group_fault(part, *axis, across_bar || across_round); !fault.empty()) return no_edit(fault);
  if (across_bar || across_round) {
    make.widen_round(part, *axis, {0, 0, 0});
  } else {
    LocalTriple at = {0, 0, 0};
    const bool lengthens =
        clause_.change != Change::thick && (clause_.change != Change::width || facts_.joined_end(part, *axis) != 0);
    if (*axis == 1 && clause_.change != Change::thick) {
      at[1] = facts_.stands(part) ? -1 : facts_.hangs(part) ? 1 : facts_.joined_end(part, 1);
    } else if (lengthens && set.size() == 1 && clause_.change == Change::length) {
      at[static_cast<std::size_t>(*axis)] = facts_.held_end(part, *axis);
    }
    make.stretch(part, *axis, at);
  }
  return finished(make);
}

bool PartMeaning::joined_across(const std::vector<PartIndex>& set, int axis) const {
  const PartBox own = facts_.extent(set.front());
  return set.size() == 1 || std::abs(own.centre()[axis] - facts_.whole().centre()[axis]) < beside;
}

Meant PartMeaning::taper(PartIndex part, std::optional<int> axis, int sign) {
  const Side end = clause_.where.value_or(Side{});
  if (!axis || end.axis != *axis || !clause_.where) return no_edit("it is not clear towards which end it shall taper");
  if (shape_.parts[part].is_virtual()) return no_edit(group_fault(part, -1, false));
  StatementMaker make(facts_, sign);
  LocalTriple face = {0, 0, 0};
  face[static_cast<std::size_t>(*axis)] = end.sign;
  const auto bar = facts_.bar_axis(part);
  const bool all_round = clause_.change == Change::taper || clause_.change == Change::thick
                             ? bar == axis || clause_.change == Change::taper
                             : facts_.is_round(part);
  if (all_round) {
    make.widen_round(part, *axis, face);
  } else {
    const auto across = axis_of(part);
    if (!across || *across == *axis) return no_edit("it is not clear what shall happen at that end");
    make.stretch(part, *across, face, face);
  }
  return finished(make);
}

}  // namespace parsel
