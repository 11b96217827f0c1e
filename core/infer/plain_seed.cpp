#include "core/infer/plain_seed.h"

#include <algorithm>

#include "core/infer/plain_part.h"

namespace parsel {

namespace {

constexpr std::size_t most_offers = 4;
constexpr std::size_t most_sets = 3;  ///< of mirror images that one noun may mean

class Meaning {
 public:
  Meaning(const ShapeFacts& facts, const Clause& clause, const std::vector<PartIndex>& pointed)
      : facts_(facts), shape_(facts.shape()), clause_(clause), pointed_(pointed) {}

  Meant run() {
    if (!clause_.fault.empty()) return no_edit(clause_.fault);
    if (clause_.change == Change::none) return any_change();
    if (clause_.how_much && clause_.how_much->unit == HowMuch::Unit::none) return any_unit();
    if (clause_.nouns.empty() && pointed_.empty()) return of_whole();
    Noun noun = clause_.nouns.empty() ? Noun{pointed_, {}, false, true, false, 0, false} : clause_.nouns.front();
    if (noun.stands) leave_what_stands(noun.parts);
    const std::vector<PartIndex> parts = clause_.nouns.empty() ? pointed_ : chosen(facts_, noun);
    if (parts.empty()) return no_edit("no such part is on that side");
    const bool some_only = parts.size() < noun.parts.size() || !shares_all(parts, noun.parts);
    if (clause_.only && !some_only && !clause_.where && clause_.nouns.size() == 1)
      return no_edit("it is not clear what “only” leaves out");
    // One of several is moved, turned or opened alone; which?
    const auto sets = facts_.mirrored(parts);
    const bool one_of_many = parts.size() > 1 || shape_.parts[parts.front()].is_virtual();
    const bool acts =
        clause_.change == Change::move || clause_.change == Change::open || clause_.change == Change::tilt;
    if (acts && one_of_many && !noun.plural && !clause_.nouns.empty() && noun.sides.empty() && !made_of(noun)) {
      return which(parts);
    }
    if (!noun.plural && !noun.sides.empty() && parts.size() > 1) return which(parts);
    if (noun.is_made_of && !goes_for_pieces()) return no_edit("no part is called that, only pieces of it are");
    if (sets.size() > most_sets) return no_edit("several parts are called that");
    Meant all{{PlainEdit{}}, ""};
    for (const auto& set : sets) {
      Meant one = PartMeaning(facts_, clause_).of(set.front(), set);
      if (one.edits.empty()) return one;
      if (!noun.is_made_of) {
        for (PlainEdit& edit : one.edits) loosen(facts_, clause_, set, edit);
      }
      if (!all.edits.front().statements.empty() && !alike(all.edits.front(), one.edits.front()))
        one.fault = "the parts that are called that would change in different ways";
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
  void leave_what_stands(std::vector<PartIndex>& parts) const {
    constexpr double on_floor = 0.02;  // half-diagonals
    std::vector<PartIndex> standing = parts;
    std::erase_if(standing, [&](PartIndex p) { return facts_.extent(p).low[1] - facts_.whole().low[1] > on_floor; });
    if (standing.size() > 1) parts = std::move(standing);
  }
  /// What is true of the posts of a back is true of the back: that they grow upwards, or lean.
  bool goes_for_pieces() const {
    return clause_.change == Change::tilt || clause_.change == Change::raise || clause_.change == Change::height;
  }
  /// "back" for two posts: one thing, though of several parts.
  bool made_of(const Noun& noun) const { return noun.is_made_of; }

  /// The same operator along the same axis.
  bool alike(const PlainEdit& a, const PlainEdit& b) const {
    const Statement &first = a.statements.front(), &second = b.statements.front();
    const auto axis = [&](const Statement& s) {
      const auto& way = s.direction ? s.direction : s.normal;
      if (!way) return -1;
      if (const auto* own = std::get_if<PartAxis>(&*way)) return own->axis;
      return main_axis_of(std::get<Vec3>(*way));
    };
    return first.op == second.op && axis(first) == axis(second);
  }

  Meant which(const std::vector<PartIndex>& parts) {
    Meant offers{{}, "several parts are called that; which one?"};
    std::vector<PartIndex> each = parts;
    if (parts.size() == 1) each = shape_.parts[parts.front()].members;
    for (const PartIndex p : each) {
      if (offers.edits.size() == most_offers) break;
      Meant one = PartMeaning(facts_, clause_).of(p, {p});
      if (one.edits.empty()) continue;
      loosen(facts_, clause_, {p}, one.edits.front());
      for (const RelationIndex r : facts_.reflections_leaving({p})) one.edits.front().loose.insert(r);
      offers.edits.push_back(std::move(one.edits.front()));
    }
    return offers;
  }

  /// The same clause in other words, each as an offer.
  Meant offer(const std::vector<Clause>& clauses, std::string fault) const {
    Meant offers{{}, std::move(fault)};
    for (const Clause& clause : clauses) {
      const Meant one = Meaning(facts_, clause, pointed_).run();
      if (one.edits.size() == 1 && one.fault.empty() && offers.edits.size() < most_offers)
        offers.edits.push_back(one.edits.front());
    }
    return offers;
  }

  Meant any_change() const {
    std::vector<Clause> clauses;
    for (const Change change : {Change::length, Change::thick, Change::width, Change::raise, Change::count}) {
      clauses.push_back(clause_);
      clauses.back().change = change;
      if (clause_.how_much && clause_.how_much->unit == HowMuch::Unit::none) clauses.pop_back();
    }
    if (clause_.nouns.empty()) clauses.clear();
    return offer(clauses, "it does not say what shall change");
  }

  Meant any_unit() const {
    std::vector<Clause> clauses(2, clause_);
    clauses[0].how_much->unit = HowMuch::Unit::metre;
    clauses[0].how_much->value /= 100;
    clauses[1].how_much->unit = HowMuch::Unit::ratio;
    clauses[1].how_much->value /= 100;
    return offer(clauses, "it gives a number without a unit, such as cm or %");
  }

  Meant with(const StatementMaker& maker) const { return maker.finish(clause_.how_much, clause_.compares); }

  // ---------------------------------------------------------------------------------------------------- the whole

  Meant of_whole() {
    if (clause_.change == Change::count) return any_row();
    if (clause_.needs_object && !clause_.whole) return no_edit("it does not say of what");
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
          return no_edit("it is not clear what shall happen on that side");
        const auto part = facts_.upright();
        if (!part) return no_edit("it is not clear which part sets the height");
        make.stretch(*part, 1, {0, -1, 0});
        make.of_whole(1);
        return with(make);
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
        if (!part || clause_.where) return no_edit("it is not clear which part sets the size");
        make.grow(*part);
        make.of_whole(0);
        return with(make);
      }
      case Change::thick:
        return no_edit("it does not say which part shall be " + std::string(clause_.sign > 0 ? "thicker" : "thinner"));
      default:
        return no_edit("it does not name a part");
    }
  }

  /// "Two more shelves", where no part is called a shelf: each row or ring may be meant. Not "more comfortable".
  Meant any_row() const {
    Meant offers{{}, "it does not say of what there shall be " + std::string(clause_.sign > 0 ? "more" : "fewer")};
    Clause counted = clause_;
    if (!counted.how_much && counted.counts_one) counted.how_much = HowMuch{HowMuch::Kind::by, HowMuch::Unit::piece, 1};
    if (!counted.how_much) return offers;
    for (const PartIndex p : facts_.active()) {
      if (!shape_.parts[p].is_virtual() || offers.edits.size() == most_offers) continue;
      Meant one = PartMeaning(facts_, counted).of(p, {p});
      if (one.edits.size() != 1 || !one.fault.empty()) continue;
      loosen(facts_, counted, {p}, one.edits.front());
      offers.edits.push_back(std::move(one.edits.front()));
    }
    return offers;
  }

  Meant whole_along(int axis) {
    const Vec3 size = facts_.whole().size();
    const double other = size[axis == 0 ? 2 : 0];
    if (clause_.change == Change::length && size[axis] < 1.1 * other)
      return no_edit("width and depth are about the same; which is the length?");
    const auto part = facts_.setting(axis);
    if (!part) return no_edit("it is not clear which part sets the " + std::string(axis == 0 ? "width" : "depth"));
    StatementMaker make(facts_, clause_.sign);
    make.of_whole(axis);
    if (clause_.where) {
      if (clause_.where->axis != axis) return no_edit("it is not clear what shall happen on that side");
      make.move_face(*part, *clause_.where);
      for (const RelationIndex r : facts_.reflections_across(axis)) make.edit.loose.insert(r);
    } else if (facts_.is_round(*part)) {
      make.widen_round(*part, 1, {0, 0, 0});
    } else {
      make.stretch(*part, axis, {0, 0, 0});
    }
    return with(make);
  }

  const ShapeFacts& facts_;
  const Shape& shape_;
  const Clause& clause_;
  const std::vector<PartIndex>& pointed_;
};

}  // namespace

std::optional<EditRequest> request_of(const Shape& shape, const PlainEdit& edit) {
  if (edit.statements.empty()) return std::nullopt;
  EditRequest request{edit.statements, {}, edit.hints};
  for (const RelationIndex r : edit.loose) request.disabled.push_back(shape.relations[r].id);
  if (!resolve(request, shape).ok()) return std::nullopt;
  return request;
}

Meant mean(const ShapeFacts& facts, const Clause& clause, const std::vector<PartIndex>& pointed) {
  return Meaning(facts, clause, pointed).run();
}

}  // namespace parsel
