#include "core/infer/plain_seed.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/infer/plain_statement.h"

namespace parsel {

namespace {

constexpr std::size_t most_offers = 4;
constexpr std::size_t most_sets = 3;  ///< of mirror images that one noun may mean
constexpr double tall_enough = 0.5;   ///< of its longest edge, and more can grow upwards when it is raised
constexpr double flat = 0.2;          ///< of its width, and less is a top, which gets larger but not thicker
constexpr double beside = 0.02;       ///< and more is on a side, in half-diagonals

Meant no(std::string fault) {
  return {{}, std::move(fault)};
}

bool is_size(Change change) {
  return change == Change::width || change == Change::height || change == Change::depth || change == Change::length ||
         change == Change::thick || change == Change::size;
}

std::string named(const Shape& shape, PartIndex part) {
  const Part& named = shape.parts[part];
  return named.name.empty() ? named.id : named.name;
}

class Meaning {
 public:
  Meaning(const ShapeFacts& facts, const Clause& clause, const std::vector<PartIndex>& pointed)
      : facts_(facts), shape_(facts.shape()), clause_(clause), pointed_(pointed) {}

  Meant run() {
    if (!clause_.fault.empty()) return no(clause_.fault);
    if (clause_.change == Change::none) return no("it does not say what shall change");
    if (clause_.how_much && clause_.how_much->unit == HowMuch::Unit::none)
      return no("it gives a number without a unit, such as cm or %");
    if (clause_.nouns.empty() && pointed_.empty()) return of_whole();
    const Noun noun = clause_.nouns.empty() ? Noun{pointed_, {}, false, true, false, 0} : clause_.nouns.front();
    const std::vector<PartIndex> parts = clause_.nouns.empty() ? pointed_ : chosen(facts_, noun);
    if (parts.empty()) return no("no such part is on that side");
    const bool some_only = parts.size() < noun.parts.size() || !shares_all(parts, noun.parts);
    if (clause_.only && !some_only && !clause_.where && clause_.nouns.size() == 1)
      return no("it is not clear what “only” leaves out");
    // One of several is moved, turned or opened alone; which?
    const auto sets = facts_.mirrored(parts);
    const bool one_of_many = parts.size() > 1 || shape_.parts[parts.front()].is_virtual();
    const bool acts =
        clause_.change == Change::move || clause_.change == Change::open || clause_.change == Change::tilt;
    if (acts && one_of_many && !noun.plural && !clause_.nouns.empty() && noun.sides.empty() && !made_of(noun)) {
      return which(parts);
    }
    if (sets.size() > most_sets) return no("several parts are called that");
    Meant all{{PlainEdit{}}, ""};
    for (const auto& set : sets) {
      Meant one = of_part(set.front(), set);
      if (one.edits.empty()) return one;
      Meant both;
      both.fault = all.fault.empty() ? one.fault : all.fault;
      for (const PlainEdit& before : all.edits) {
        for (const PlainEdit& more : one.edits) {
          PlainEdit sum = before;
          sum.statements.insert(sum.statements.end(), more.statements.begin(), more.statements.end());
          sum.hints.insert(more.hints.begin(), more.hints.end());
          sum.loose.insert(more.loose.begin(), more.loose.end());
          if (!sum.target) sum.target = more.target;
          if (both.edits.size() < most_offers) both.edits.push_back(std::move(sum));
        }
      }
      all = std::move(both);
    }
    for (PlainEdit& edit : all.edits) {
      if (!some_only) continue;
      for (const RelationIndex r : facts_.reflections_leaving(parts)) edit.loose.insert(r);
    }
    return all;
  }

 private:
  bool shares_all(const std::vector<PartIndex>& some, const std::vector<PartIndex>& all) const {
    return std::all_of(all.begin(), all.end(),
                       [&](PartIndex p) { return std::find(some.begin(), some.end(), p) != some.end(); });
  }
  /// "back" for two posts: one thing, though of several parts.
  bool made_of(const Noun& noun) const { return noun.is_made_of; }

  Meant which(const std::vector<PartIndex>& parts) {
    Meant offers{{}, "several parts are called that; which one?"};
    std::vector<PartIndex> each = parts;
    if (parts.size() == 1) each = shape_.parts[parts.front()].members;
    for (const PartIndex p : each) {
      if (offers.edits.size() == most_offers) break;
      Meant one = of_part(p, {p});
      if (one.edits.empty()) continue;
      for (const RelationIndex r : facts_.reflections_leaving({p})) one.edits.front().loose.insert(r);
      offers.edits.push_back(std::move(one.edits.front()));
    }
    return offers;
  }

  Meant with(StatementMaker maker) { return maker.finish(clause_.how_much, clause_.compares); }

  // ---------------------------------------------------------------------------------------------------- the whole

  Meant of_whole() {
    if (clause_.needs_object && !clause_.whole) return no("it does not say of what");
    StatementMaker make(facts_, clause_.sign);
    switch (clause_.change) {
      case Change::width:
      case Change::depth:
      case Change::length:
        return whole_along(clause_.change == Change::width                       ? 0
                           : clause_.change == Change::depth                     ? 2
                           : facts_.whole().size()[2] > facts_.whole().size()[0] ? 2
                                                                                 : 0);
      case Change::height:
      case Change::raise: {
        if (clause_.where && !(clause_.where->axis == 1 && clause_.where->sign == clause_.sign))
          return no("it is not clear what shall happen on that side");
        const auto part = facts_.upright();
        if (!part) return no("it is not clear which part sets the height");
        make.stretch(*part, 1, {0, -1, 0});
        make.of_whole(1);
        return with(std::move(make));
      }
      case Change::size: {
        std::optional<PartIndex> close;
        const auto part = facts_.setting(0, &close);
        if (part && close && !clause_.where) {
          Meant offers{{}, "it is not clear which part sets the size"};
          for (const PartIndex p : {*part, *close}) {
            StatementMaker grow(facts_, clause_.sign);
            grow.grow(p);
            offers.edits.push_back(grow.edit);
          }
          return offers;
        }
        if (!part || clause_.where) return no("it is not clear which part sets the size");
        make.grow(*part);
        make.of_whole(0);
        return with(std::move(make));
      }
      case Change::thick:
        return no("it does not say which part shall be " + std::string(clause_.sign > 0 ? "thicker" : "thinner"));
      case Change::count:
        return no("it does not say of what there shall be " + std::string(clause_.sign > 0 ? "more" : "fewer"));
      default:
        return no("it does not name a part");
    }
  }

  Meant whole_along(int axis) {
    const Vec3 size = facts_.whole().size();
    const double other = size[axis == 0 ? 2 : 0];
    if (clause_.change == Change::length && size[axis] < 1.1 * other)
      return no("width and depth are about the same; which is the length?");
    const auto part = facts_.setting(axis);
    if (!part) return no("it is not clear which part sets the " + std::string(axis == 0 ? "width" : "depth"));
    StatementMaker make(facts_, clause_.sign);
    make.of_whole(axis);
    if (clause_.where) {
      if (clause_.where->axis != axis) return no("it is not clear what shall happen on that side");
      make.move_face(*part, *clause_.where);
      for (const RelationIndex r : facts_.reflections_across(axis)) make.edit.loose.insert(r);
    } else if (facts_.is_round(*part)) {
      make.widen_round(*part, 1, {0, 0, 0});
    } else {
      make.stretch(*part, axis, {0, 0, 0});
    }
    return with(std::move(make));
  }

  // ----------------------------------------------------------------------------------------------------- of a part

  Meant of_part(PartIndex part, const std::vector<PartIndex>& set) {
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
        if (!clause_.where) return no("it does not say towards which end");
        return taper(part, facts_.long_axis(part), -1);
      default:
        return no("it does not say what shall change");
    }
  }

  /// Why a group cannot be edited as one along this axis.
  std::string group_fault(PartIndex part, int axis, bool two_axes) const {
    const Part& parent = shape_.parts[part];
    if (!parent.is_virtual()) return "";
    const Relation& group = shape_.relations[*parent.group];
    const std::string why = named(shape_, part) + " is a row or ring, whose pieces cannot change that way together";
    if (const auto* row = std::get_if<Translation>(&group.detail)) {
      const int way = main_axis_of(row->end - row->start);
      return two_axes ? (axis == way ? "" : why) : (axis == way ? why : "");
    }
    const int about = main_axis_of(std::get<Rotation>(group.detail).axis);
    return !two_axes && axis == about ? "" : why;
  }

  std::optional<int> axis_of(PartIndex part) const {
    switch (clause_.change) {
      case Change::width:
        return 0;
      case Change::height:
        return 1;
      case Change::depth:
        return 2;
      case Change::length:
        return facts_.long_axis(part);
      default:
        return facts_.thin_axis(part);
    }
  }

  Meant size_of(PartIndex part, const std::vector<PartIndex>& set) {
    StatementMaker make(facts_, clause_.sign);
    const auto bar = facts_.bar_axis(part);
    const bool to_side = clause_.change == Change::width || clause_.change == Change::depth;
    const int side_axis = clause_.change == Change::width ? 0 : 2;
    // "wider legs" are thicker ones; deeper ones would be an odd thing to ask for.
    if (bar && to_side && *bar != side_axis && !clause_.where && clause_.out == 0 && clause_.change == Change::depth)
      return no("it is not clear which way " + named(shape_, part) + " is deep");
    const bool across_bar = bar && (clause_.change == Change::thick || (clause_.change == Change::width && *bar == 1));
    const bool across_round = clause_.change == Change::width && !bar && facts_.is_round(part);
    if (clause_.change == Change::size) {
      if (clause_.where || clause_.out != 0) return no("it is not clear what shall happen on that side");
      if (shape_.parts[part].is_virtual()) return no(group_fault(part, -1, false));
      const Vec3 e = facts_.edges(part);
      e[1] < flat* std::min(e[0], e[2]) ? make.widen_round(part, 1, {0, 0, 0}) : make.grow(part);
      return with(std::move(make));
    }
    const auto axis = across_bar ? bar : across_round ? std::optional(1) : axis_of(part);
    if (!axis)
      return no("it is not clear which way " + named(shape_, part) + " is " +
                (clause_.change == Change::thick ? "thick" : "long"));
    if (clause_.where || clause_.out != 0) {
      Side side = clause_.where.value_or(Side{});
      if (!clause_.where) {
        if (across_round) return no("it is not clear what shall happen on that side");
        const auto [away, sign] = facts_.outward(part);
        side = {across_bar ? away : *axis, sign * clause_.out};
        if (side.axis != away)
          side.sign = facts_.extent(part).centre()[side.axis] >= facts_.whole().centre()[side.axis] ? clause_.out
                                                                                                    : -clause_.out;
      }
      const bool same_axis = side.axis == *axis;
      if (across_bar || across_round || !same_axis)
        return taper(part, across_bar ? bar : across_round ? std::optional(1) : std::optional(side.axis), clause_.sign);
      make.move_face(part, side);
      if (clause_.where && joined_across(set, side.axis)) {
        for (const RelationIndex r : facts_.reflections_across(side.axis)) make.edit.loose.insert(r);
      }
      return with(std::move(make));
    }
    if (std::string fault = group_fault(part, *axis, across_bar || across_round); !fault.empty()) return no(fault);
    if (across_bar || across_round) {
      make.widen_round(part, *axis, {0, 0, 0});
    } else {
      LocalTriple at = {0, 0, 0};
      const bool lengthens =
          clause_.change != Change::thick && (clause_.change != Change::width || facts_.joined_end(part, *axis) != 0);
      if (*axis == 1 && clause_.change != Change::thick) {
        at[1] = facts_.stands(part) ? -1 : facts_.hangs(part) ? 1 : facts_.joined_end(part, 1);
      } else if (lengthens && set.size() == 1 && clause_.change == Change::length) {
        at[static_cast<std::size_t>(*axis)] = facts_.joined_end(part, *axis);
      }
      make.stretch(part, *axis, at);
    }
    return with(std::move(make));
  }

  /// Whether an edit to one side breaks the mirror images across it: the parts are not themselves a pair across it.
  bool joined_across(const std::vector<PartIndex>& set, int axis) const {
    const Extent own = facts_.extent(set.front());
    return set.size() == 1 || std::abs(own.centre()[axis] - facts_.whole().centre()[axis]) < beside;
  }

  Meant taper(PartIndex part, std::optional<int> axis, int sign) {
    const Side end = clause_.where.value_or(Side{});
    if (!axis || end.axis != *axis || !clause_.where) return no("it is not clear towards which end it shall taper");
    if (shape_.parts[part].is_virtual()) return no(group_fault(part, -1, false));
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
      if (!across || *across == *axis) return no("it is not clear what shall happen at that end");
      make.stretch(part, *across, face, face);
    }
    return with(std::move(make));
  }

  Meant raise(PartIndex part) {
    if (clause_.where && !(clause_.where->axis == 1 && clause_.where->sign == clause_.sign))
      return no("it is not clear what shall happen on that side");
    StatementMaker make(facts_, clause_.sign);
    // What stands and is no plate that lies there grows; what lies on supports goes up with them.
    const Vec3 e = facts_.edges(part);
    const bool is_upright = e[1] >= tall_enough * e.maxCoeff() && facts_.thin_axis(part) != std::optional(1);
    if (is_upright && facts_.stands(part)) {
      if (std::string fault = group_fault(part, 1, false); !fault.empty()) return no(fault);
      make.stretch(part, 1, {0, -1, 0});
    } else if (const auto below = facts_.support(part)) {
      make.stretch(*below, 1, {0, -1, 0});
    } else {
      make.move(part, {1, clause_.sign});
    }
    return with(std::move(make));
  }

  Meant count(PartIndex part) {
    const Part& group = shape_.parts[part];
    if (!group.is_virtual()) return no(named(shape_, part) + " is in no row or ring, so there cannot be more or fewer");
    if (clause_.where || clause_.out != 0) return no("pieces are added all along, not on one side");
    StatementMaker make(facts_, clause_.sign);
    HowMuch pieces;
    const bool one = !clause_.nouns.empty() && !clause_.nouns.front().plural && clause_.counts_one;
    if (clause_.how_much) {
      pieces = *clause_.how_much;
    } else if (one) {
      pieces = {HowMuch::Kind::by, HowMuch::Unit::piece, 1};
    } else if (clause_.removes) {
      return no("it does not say how many to take away");
    }
    make.more(part);
    return make.finish(clause_.how_much || one ? std::optional(pieces) : std::nullopt, clause_.compares);
  }

  Meant spacing(PartIndex part, const std::vector<PartIndex>& set) {
    if (clause_.where) return no("it is not clear what shall happen on that side");
    StatementMaker make(facts_, clause_.sign);
    if (shape_.parts[part].is_virtual()) {
      make.space(part);
      return with(std::move(make));
    }
    if (set.size() != 2) return no("it is not clear which way they shall go apart");
    const Vec3 between = facts_.extent(set[0]).centre() - facts_.extent(set[1]).centre();
    const int axis = main_axis_of(between);
    make.move(set[0], {axis, (between[axis] > 0 ? 1 : -1) * clause_.sign});
    std::optional<HowMuch> each = clause_.how_much;
    if (each && each->kind != HowMuch::Kind::by) return no("it is not clear how far apart that is");
    if (each) each->value /= 2;
    return make.finish(each, clause_.compares);
  }

  Meant move(PartIndex part, const std::vector<PartIndex>& set) {
    std::optional<Side> to = clause_.where;
    const int out = clause_.out != 0 ? clause_.out : clause_.knows_way ? 1 : 0;
    if (!to && out != 0) {
      const Part& group = shape_.parts[part];
      if (group.is_virtual() && shape_.relations[*group.group].kind == RelationKind::rotation) {
        StatementMaker make(facts_, out);
        make.space(part);
        return with(std::move(make));
      }
      const auto [axis, sign] = facts_.outward(part);
      if (set.size() > 2) return no("it is not clear which way is out");
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
      if (splits && clause_.where) return no("mirror images would go to opposite sides");
    }
    return with(std::move(make));
  }

  bool has_word(PartIndex part, std::initializer_list<const char*> words) const {
    const std::string id = shape_.parts[part].id;
    return std::any_of(words.begin(), words.end(), [&](const char* word) { return id.find(word) != id.npos; });
  }

  Meant tilt(PartIndex part, const std::vector<PartIndex>& set) {
    if (shape_.parts[part].is_virtual()) return no("the pieces of a row or ring are not tilted together");
    std::optional<Side> to = clause_.where;
    // A back is tilted backwards unless one says otherwise.
    const bool is_back = has_word(part, {"back"}) || (!clause_.nouns.empty() && made_of(clause_.nouns.front()));
    if (!to && (clause_.knows_way || is_back)) to = Side{2, -1};
    const LocalTriple end = {0, facts_.stands(part) ? -1 : facts_.hangs(part) ? 1 : facts_.joined_end(part, 1), 0};
    const auto lean = [&](const Side& way) {
      StatementMaker make(facts_, 1);
      make.tilt(part, way, end);
      for (const PartIndex p : facts_.carried_by(set)) make.edit.hints[shape_.parts[p].id] = Hint::rotate;
      return make;
    };
    if (to && to->axis != 1) return with(lean(*to));
    if (to) return no("it tilts to a side, not up or down");
    Meant offers{{}, "it does not say which way"};
    for (const Side way : {Side{2, 1}, Side{2, -1}, Side{0, 1}, Side{0, -1}}) offers.edits.push_back(lean(way).edit);
    return offers;
  }

  Meant open(PartIndex part) {
    if (clause_.where) return no("it is not clear which way it opens");
    const Vec3 e = facts_.edges(part);
    StatementMaker make(facts_, 1);
    if (has_word(part, {"drawer", "schublade"})) {
      const auto [axis, sign] = facts_.outward(part);
      make.move(part, {axis, sign});
      return with(std::move(make));
    }
    const bool upright = e[1] > e[2] && e[0] > e[2];
    if (!has_word(part, {"door", "tuer", "gate"}) || !upright || shape_.parts[part].is_virtual())
      return no("it is not clear how " + named(shape_, part) + " opens");
    make.swing(part, facts_.hinge(part));
    return with(std::move(make));
  }

  const ShapeFacts& facts_;
  const Shape& shape_;
  const Clause& clause_;
  const std::vector<PartIndex>& pointed_;
};

}  // namespace

Meant mean(const ShapeFacts& facts, const Clause& clause, const std::vector<PartIndex>& pointed) {
  return Meaning(facts, clause, pointed).run();
}

}  // namespace parsel
