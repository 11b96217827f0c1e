// What a plain request says shall stay: which nouns that holds for (plain_clause.h), and the hints it comes to (plain_seed.h).
#include <algorithm>

#include "core/infer/plain_part.h"
#include "core/infer/plain_seed.h"

namespace parsel {

namespace {

using Link = Clause::Link;

/// Names something, and says nothing of it.
bool is_bare(const Clause& c) {
  return !c.keeps && c.change == Change::none && !c.how_much && !c.where && c.out == 0 && !c.only && !c.follows &&
         c.fault.empty() && (!c.nouns.empty() || c.whole || c.everything_else);
}

bool says_only_as_it_is(const Clause& c) {
  return !c.fixed.empty() && !c.keeps && c.change == Change::none && !c.how_much && !c.where && c.out == 0 && !c.only &&
         c.fault.empty() && c.nouns.empty() && !c.whole && !c.everything_else;
}

bool links_list(Link link) {
  return link == Link::comma || link == Link::conjunction || link == Link::comma_and_conjunction;
}

void stays_like(Clause& clause, const Clause& other) {
  clause.keeps = true;
  clause.named_before = other.named_before;
  clause.same_size = clause.same_size || other.same_size;
}

constexpr const char* unclear = "it is not clear what changes and what stays";

/// "the legs and the seat stay": back from the verb through its list.
void spread_back(std::vector<Clause>& clauses, std::size_t verb) {
  if (verb == 0 || !is_bare(clauses[verb - 1]) || !links_list(clauses[verb].link)) return;
  if (clauses[verb].link == Link::comma) {
    // "widen the seat and the back, the legs stay" is of the legs alone; "widen the seat, the back, the legs stay"?
    Clause& before = clauses[verb - 1];
    if (before.link == Link::sentence)
      stays_like(before, clauses[verb]);
    else if (before.link != Link::conjunction)
      before.fault = unclear;
    return;
  }
  std::size_t first = verb;
  while (first > 0 && links_list(clauses[first].link) && is_bare(clauses[first - 1])) {
    --first;
    stays_like(clauses[first], clauses[verb]);
  }
  // "widen the seat and the back and the legs stay": of the back, both can be meant.
  if (first > 0 && clauses[first].link == Link::conjunction && !clauses[first - 1].keeps)
    clauses[first].fault = unclear;
}

bool goes_up(const Statement& s) {
  const auto* way = s.direction ? std::get_if<Vec3>(&*s.direction) : nullptr;
  return way != nullptr && main_axis_of(*way) == 1;
}

/// With their mirror images.
std::set<PartIndex> changed_by(const ShapeFacts& facts, const PlainEdit& edit) {
  std::set<PartIndex> changed;
  for (const Statement& s : edit.statements) changed.insert(*part_of(facts.shape(), s));
  for (const auto& twins : facts.mirrored(facts.active())) {
    const bool any = std::any_of(twins.begin(), twins.end(), [&](PartIndex p) { return changed.count(p) > 0; });
    if (any) changed.insert(twins.begin(), twins.end());
  }
  return changed;
}

/// Everything but what changes stays where it is, and goes along where it is carried. Answers a fault, or nothing.
std::string keep_the_rest(const ShapeFacts& facts, PlainEdit& edit) {
  const Shape& shape = facts.shape();
  const std::set<PartIndex> changed = changed_by(facts, edit);
  const std::vector<PartIndex> carriers(changed.begin(), changed.end());
  std::map<PartIndex, Hint> along;
  for (const Statement& s : edit.statements) {
    const PartIndex part = *part_of(shape, s);
    const bool whole = s.feature == LocalTriple{0, 0, 0};
    if ((s.op == Op::translate && whole) || s.op == Op::rotate) {
      for (const PartIndex p : facts.carried_by(carriers))
        along[p] = s.op == Op::rotate ? Hint::rotate : Hint::translate;
    }
    if (s.op != Op::scale_1d || !goes_up(s)) continue;
    const PartBox own = facts.extent(part);
    const double slack = 0.1 * own.size()[1];
    for (const PartIndex p : facts.active()) {
      if (changed.count(p) > 0) continue;
      const PartBox other = facts.extent(p);
      if (other.low[1] >= own.high[1] - slack) along[p] = Hint::translate;
      // Beside it, and reaching above its middle: up with it, longer with it, or where it is?
      else if (other.high[1] > own.centre()[1])
        return "it is not clear whether " + name_of(shape, p) + " goes along";
    }
  }
  for (const PartIndex p : facts.active()) {
    if (changed.count(p) > 0) continue;
    const auto carried = along.find(p);
    edit.hints.emplace(shape.parts[p].id, carried != along.end() ? carried->second : Hint::keep_fixed);
  }
  return "";
}

}  // namespace

void spread_keeps(Sentence& sentence) {
  std::vector<Clause>& clauses = sentence.clauses;
  for (Clause& c : clauses) {
    // "with the legs unchanged"
    if (!c.fixed.empty() && is_bare(c)) c.keeps = c.named_before = true;
  }
  for (std::size_t i = 1; i < clauses.size(); ++i) {
    // "stay, as they are", which German parts by a comma.
    if (clauses[i - 1].keeps && says_only_as_it_is(clauses[i])) clauses[i].fixed.clear();
  }
  for (std::size_t i = 0; i < clauses.size(); ++i) {
    if (!clauses[i].keeps) continue;
    if (clauses[i].named_before) {
      spread_back(clauses, i);
    } else {
      for (std::size_t j = i + 1; j < clauses.size() && links_list(clauses[j].link) && is_bare(clauses[j]); ++j)
        stays_like(clauses[j], clauses[i]);
    }
  }
  for (Clause& c : clauses) {
    if (c.everything_else && !c.keeps && c.fault.empty()) c.fault = "it is not clear what everything else is";
    if (!c.keeps) sentence.unused.insert(sentence.unused.end(), c.fixed.begin(), c.fixed.end());
  }
}

std::string keep(const ShapeFacts& facts, const Clause& clause, PlainEdit& edit) {
  if (!clause.fault.empty()) return clause.fault;
  if (clause.change != Change::none || clause.how_much || clause.where) return "it is not clear what shall stay";
  if (clause.everything_else) return keep_the_rest(facts, edit);
  const Shape& shape = facts.shape();
  const std::set<PartIndex> changed = changed_by(facts, edit);
  double lifted_above = 2;  // of what goes up, the middle; nothing does
  for (const Statement& s : edit.statements) {
    if (goes_up(s) && (s.op == Op::scale_1d || s.op == Op::translate))
      lifted_above = std::min(lifted_above, facts.extent(*part_of(shape, s)).centre()[1]);
  }
  std::vector<PartIndex> parts;
  for (const Noun& noun : clause.nouns) {
    const auto some = chosen(facts, noun);
    parts.insert(parts.end(), some.begin(), some.end());
  }
  if (parts.empty() && clause.whole) {
    if (!clause.names_whole) return "it is not clear what shall stay";
    if (lifted_above > 1.5) return "the whole cannot both change and stay";
    for (const PartIndex p : facts.active()) {
      if (changed.count(p) == 0 && facts.extent(p).centre()[1] > lifted_above) parts.push_back(p);
    }
  }
  if (parts.empty()) return "it does not say what shall stay";
  for (const PartIndex p : parts) {
    if (changed.count(p) > 0) return name_of(shape, p) + " cannot both change and stay";
    const bool carried = facts.extent(p).centre()[1] > lifted_above;
    edit.hints[shape.parts[p].id] = clause.same_size || carried ? Hint::translate : Hint::keep_fixed;
  }
  return "";
}

}  // namespace parsel
