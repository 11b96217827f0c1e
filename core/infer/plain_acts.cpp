// Raising, counting, spacing, moving, tilting and opening parts: plain_part.h.
#include <algorithm>
#include <cmath>

#include "core/infer/plain_part.h"

namespace parsel {

namespace {

constexpr double tall_enough = 0.5;  ///< of its longest edge, and more can grow upwards when it is raised

}  // namespace

bool is_drawer(const Shape& shape, PartIndex part) {
  const std::string& id = shape.parts[part].id;
  return id.find("drawer") != id.npos || id.find("schublade") != id.npos;
}

Meant PartMeaning::raise(PartIndex part) {
  if (clause_.where && !(clause_.where->axis == 1 && clause_.where->sign == clause_.sign))
    return no_edit("it is not clear what shall happen on that side");
  StatementMaker make(facts_, clause_.sign);
  // What stands and is no plate that lies there grows; what lies on supports goes up with them.
  const Vec3 e = facts_.edges(part);
  const auto thin = facts_.thin_axis(part);
  // A board on its edge, as an armrest is, grows as well.
  const bool is_upright = thin != std::optional(1) && (e[1] >= tall_enough * e.maxCoeff() || thin);
  const bool is_row = shape_.parts[part].is_virtual() && !group_fault(part, 1, false).empty();
  if (is_row) return no_edit("it is not clear how high a row of " + name_of(shape_, part) + " shall be");
  if (is_upright && facts_.stands(part)) {
    if (std::string fault = group_fault(part, 1, false); !fault.empty()) return no_edit(fault);
    make.stretch(part, 1, {0, -1, 0});
  } else if (const auto below = facts_.support(part)) {
    if (clause_.how_much && clause_.how_much->kind != HowMuch::Kind::by)
      return no_edit("it is not clear from where that height is measured");
    make.stretch(*below, 1, {0, -1, 0});
  } else {
    make.move(part, {1, 1});
  }
  return finished(make);
}

Meant PartMeaning::count(PartIndex part) {
  const Part& group = shape_.parts[part];
  if (!group.is_virtual())
    return no_edit(name_of(shape_, part) + " is in no row or ring, so there cannot be more or fewer");
  if (clause_.where || clause_.out != 0) return no_edit("pieces are added all along, not on one side");
  StatementMaker make(facts_, clause_.sign);
  HowMuch pieces;
  const bool one = !clause_.nouns.empty() && !clause_.nouns.front().plural && clause_.counts_one;
  if (clause_.how_much) {
    pieces = *clause_.how_much;
  } else if (one) {
    pieces = {HowMuch::Kind::by, HowMuch::Unit::piece, 1};
  } else if (clause_.removes) {
    return no_edit("it does not say how many to take away");
  }
  make.more(part);
  return make.finish(clause_.how_much || one ? std::optional(pieces) : std::nullopt, clause_.compares);
}

Meant PartMeaning::spacing(PartIndex part, const std::vector<PartIndex>& set) {
  if (clause_.where) return no_edit("it is not clear what shall happen on that side");
  StatementMaker make(facts_, clause_.sign);
  if (shape_.parts[part].is_virtual()) {
    make.space(part);
    return finished(make);
  }
  if (set.size() != 2) return no_edit("it is not clear which way they shall go apart");
  const Vec3 between = facts_.extent(set[0]).centre() - facts_.extent(set[1]).centre();
  const int axis = main_axis_of(between);
  make.move(set[0], {axis, between[axis] > 0 ? 1 : -1});
  std::optional<HowMuch> each = clause_.how_much;
  if (each && each->kind != HowMuch::Kind::by) return no_edit("it is not clear how far apart that is");
  if (each) each->value /= 2;
  return make.finish(each, clause_.compares);
}

Meant PartMeaning::move(PartIndex part, const std::vector<PartIndex>& set) {
  std::optional<Side> to = clause_.where;
  const int out = clause_.out != 0 ? clause_.out : clause_.knows_way ? 1 : 0;
  if (!to && out != 0) {
    const Part& group = shape_.parts[part];
    if (group.is_virtual() && shape_.relations[*group.group].kind == RelationKind::rotation) {
      StatementMaker make(facts_, out);
      make.space(part);
      return finished(make);
    }
    const bool is_pulled = clause_.knows_way || is_drawer(shape_, part);
    const auto [axis, sign] = is_pulled ? facts_.opening(part) : facts_.outward(part);
    if (set.size() > 2) return no_edit("it is not clear which way is out");
    to = Side{axis, sign * out};
  }
  if (!to) {
    Meant offers{{}, "it does not say where to"};
    for (const Side way : {Side{1, 1}, Side{1, -1}, Side{2, 1}, Side{2, -1}}) {
      StatementMaker make(facts_, 1);
      make.move(part, way);
      offers.edits.push_back(make.edit);
    }
    return offers;
  }
  StatementMaker make(facts_, 1);
  make.move(part, *to);
  if (set.size() > 1 && to->axis != 1) {
    // Mirror images cannot all go the same way across their plane.
    const auto across = facts_.reflections_across(to->axis);
    const bool splits = std::any_of(across.begin(), across.end(), [&](RelationIndex r) {
      const auto& pair = shape_.relations[r].parts;
      return std::count(set.begin(), set.end(), pair[0]) > 0 && std::count(set.begin(), set.end(), pair[1]) > 0;
    });
    if (splits && clause_.where) return no_edit("mirror images would go to opposite sides");
  }
  return finished(make);
}

bool PartMeaning::has_word(PartIndex part, std::initializer_list<const char*> words) const {
  const std::string id = shape_.parts[part].id;
  return std::any_of(words.begin(), words.end(), [&](const char* word) { return id.find(word) != id.npos; });
}

Meant PartMeaning::tilt(PartIndex part, const std::vector<PartIndex>& set) {
  if (shape_.parts[part].is_virtual()) return no_edit("the pieces of a row or ring are not tilted together");
  std::optional<Side> to = clause_.where;
  // A back is tilted backwards unless one says otherwise.
  const bool is_back = has_word(part, {"back"}) || (!clause_.nouns.empty() && clause_.nouns.front().is_made_of);
  if (!to && (clause_.knows_way || is_back)) to = Side{2, -1};
  const LocalTriple end = {0, facts_.stands(part) ? -1 : facts_.hangs(part) ? 1 : facts_.joined_end(part, 1), 0};
  const auto lean = [&](const Side& way) {
    StatementMaker make(facts_, 1);
    make.tilt(part, way, end);
    for (const PartIndex p : facts_.carried_by(set)) make.edit.hints[shape_.parts[p].id] = Hint::rotate;
    return make;
  };
  if (to && to->axis != 1) return finished(lean(*to));
  if (to) return no_edit("it tilts to a side, not up or down");
  Meant offers{{}, "it does not say which way"};
  for (const Side way : {Side{2, 1}, Side{2, -1}, Side{0, 1}, Side{0, -1}}) offers.edits.push_back(lean(way).edit);
  return offers;
}

Meant PartMeaning::open(PartIndex part) {
  if (clause_.where) return no_edit("it is not clear which way it opens");
  const Vec3 e = facts_.edges(part);
  StatementMaker make(facts_, 1);
  if (is_drawer(shape_, part)) {
    const auto [axis, sign] = facts_.opening(part);
    make.move(part, {axis, sign});
    return finished(make);
  }
  const bool upright = e[1] > e[2] && e[0] > e[2];
  if (!has_word(part, {"door", "tuer", "gate"}) || !upright || shape_.parts[part].is_virtual())
    return no_edit("it is not clear how " + name_of(shape_, part) + " opens");
  make.swing(part, facts_.hinge(part));
  return finished(make);
}

}  // namespace parsel
