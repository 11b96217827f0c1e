#include "core/infer/plain_reading.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <set>

#include "core/base/text.h"
#include "core/infer/inference_json.h"
#include "core/infer/reading.h"

namespace parsel {

namespace {

using nlohmann::json;

constexpr std::size_t most_readings = 4;
constexpr int unused_word = 20;  ///< doubt
constexpr int sure_slip = 2;     ///< see misspelling()

/// One way to take the words, with what it comes to.
struct Way {
  std::vector<PlainEdit> edits;
  std::string fault;
  std::vector<std::size_t> unused;
  int doubt = 0;
  bool clean() const { return fault.empty() && unused.empty() && edits.size() == 1; }
};

bool changes(const Clause& clause) {
  return !clause.keeps && !(clause.follows && clause.change == Change::none) &&
         (clause.change != Change::none || !clause.nouns.empty() || clause.whole || clause.how_much || clause.where ||
          clause.out != 0 || clause.only || !clause.fault.empty());
}

/// Clauses say what others left out: "wider and deeper", "the seat and the back wider".
void share(std::vector<Clause*>& clauses) {
  for (std::size_t i = 0; i < clauses.size(); ++i) {
    Clause& c = *clauses[i];
    if (c.change != Change::none || !c.fault.empty() || (c.nouns.empty() && !c.whole)) continue;
    const Clause* from = i > 0 ? clauses[i - 1] : nullptr;
    if (from == nullptr && i + 1 < clauses.size()) from = clauses[i + 1];
    if (from == nullptr || from->change == Change::none || c.how_much) continue;
    // "wider, the chair": the noun belongs to the clause before it.
    if (i > 0 && from->nouns.empty() && !from->whole && !c.where) {
      clauses[i - 1]->nouns = c.nouns;
      clauses[i - 1]->whole = c.whole;
      clauses[i - 1]->names_whole = c.names_whole;
      clauses.erase(clauses.begin() + static_cast<std::ptrdiff_t>(i--));
      continue;
    }
    c.change = from->change;
    c.sign = from->sign;
    c.compares = from->compares;
    c.counts_one = from->counts_one;
    c.knows_way = from->knows_way;
    if (!c.where) c.where = from->where;
    if (c.out == 0) c.out = from->out;
    if (!c.how_much) c.how_much = from->how_much;
  }
  for (std::size_t i = 1; i < clauses.size(); ++i) {
    Clause& c = *clauses[i];
    const bool it = c.whole && !c.names_whole && !clauses[i - 1]->nouns.empty();
    if (c.change != Change::none && c.nouns.empty() && (!c.whole || it) && c.change != Change::count) {
      c.nouns = clauses[i - 1]->nouns;
      c.whole = clauses[i - 1]->whole;
      c.names_whole = clauses[i - 1]->names_whole;
    }
    // "wider, by 10 cm"
    if (c.change == Change::none && c.nouns.empty() && !c.whole && c.how_much && !clauses[i - 1]->how_much &&
        c.fault.empty()) {
      clauses[i - 1]->how_much = c.how_much;
      clauses.erase(clauses.begin() + static_cast<std::ptrdiff_t>(i--));
    }
  }
}

/// Whether two changes go the same way, so that one can be the other's consequence or means.
bool agree(const Clause& a, const Clause& b) {
  const auto upright = [](Change c) { return c == Change::raise || c == Change::height || c == Change::length; };
  const auto level = [](Change c) {
    return c == Change::width || c == Change::depth || c == Change::length || c == Change::spacing ||
           c == Change::size || c == Change::move;
  };
  return a.sign == b.sign && ((upright(a.change) && upright(b.change)) || (level(a.change) && level(b.change)));
}

/// "taller, the shelves further apart": a row that goes along with a stretch in its own direction needs no seed, only to
/// be told how.
void let_rows_follow(const Shape& shape, PlainEdit& edit) {
  for (std::size_t i = 0; i < edit.statements.size(); ++i) {
    const Statement& spread = edit.statements[i];
    if (spread.op != Op::change_delta) continue;
    const Relation& group = shape.relations[*shape.find_relation(spread.relation)];
    const auto* row = std::get_if<Translation>(&group.detail);
    const bool goes_along =
        row != nullptr && std::any_of(edit.statements.begin(), edit.statements.end(), [&](const Statement& s) {
          const auto* way = s.direction ? std::get_if<Vec3>(&*s.direction) : nullptr;
          const bool minus = s.amount.text().starts_with("-");
          return s.op == Op::scale_1d && way != nullptr && main_axis_of(*way) == main_axis_of(row->end - row->start) &&
                 minus == spread.amount.text().starts_with("-");
        });
    if (!goes_along) continue;
    edit.hints[shape.parts[parent_of(group)].id] = Hint::change_delta;
    edit.statements.erase(edit.statements.begin() + static_cast<std::ptrdiff_t>(i--));
  }
}

/// What a statement acts on and along, without its amount: two that share it contradict or repeat each other.
std::string acts_on(const Shape& shape, const Statement& statement) {
  std::string text = reading_signature(shape, {statement});
  return text.substr(0, text.find_last_of("+-"));
}

/// Of two edits that contradict each other, the later one, with what the earlier one says of others.
PlainEdit instead(const Shape& shape, PlainEdit before, const PlainEdit& later) {
  std::erase_if(before.statements, [&](const Statement& statement) {
    return std::any_of(later.statements.begin(), later.statements.end(),
                       [&](const Statement& other) { return acts_on(shape, other) == acts_on(shape, statement); });
  });
  before.statements.insert(before.statements.end(), later.statements.begin(), later.statements.end());
  before.hints.insert(later.hints.begin(), later.hints.end());
  before.loose.insert(later.loose.begin(), later.loose.end());
  before.target = later.target;
  return before;
}

Way take(const ShapeFacts& facts, const std::vector<Token>& tokens, const std::vector<Item>& items,
         const PartNames& names, const std::vector<PartIndex>& pointed) {
  Way way;
  for (const Item& item : items) {
    way.doubt += 3 * item.slip + item.distance;
  }
  Sentence sentence = parse(items, tokens, names);
  way.unused = sentence.unused;
  for (const Item& item : items) {
    if (item.slip > sure_slip) way.unused.push_back(item.first);
  }
  const auto fail = [&](const std::string& fault) {
    if (way.fault.empty()) way.fault = fault;
  };
  std::vector<Clause*> main, kept;
  for (Clause& clause : sentence.clauses) {
    if (clause.keeps) {
      kept.push_back(&clause);
    } else if (changes(clause)) {
      main.push_back(&clause);
    }
  }
  share(main);
  // Consequences add nothing; means take the place of what they bring about.
  for (std::size_t i = 1; i < main.size(); ++i) {
    if (main[i]->begins == Clause::Begins::conjunction || main[i]->begins == Clause::Begins::first) continue;
    const bool is_means = main[i]->begins != Clause::Begins::so;
    if (main[i - 1]->change != Change::none && !agree(*main[i - 1], *main[i])) fail("its parts do not go together");
    if (is_means) main[i]->serves = true;
    main.erase(main.begin() + static_cast<std::ptrdiff_t>(is_means ? i - 1 : i));
    --i;
  }
  // "Shorter" is lower for what is longer as well, but nobody means that.
  for (const Clause* a : main) {
    for (const Clause* b : main) {
      if (a->change == Change::length && b->change == Change::height && a->sign != b->sign)
        fail("it asks for longer and for shorter");
    }
  }
  // "Bigger and smaller pillows": the whole, and the pillows? Or are both said of them?
  for (std::size_t i = 1; i < main.size(); ++i) {
    const Clause &a = *main[i - 1], &b = *main[i];
    if (a.nouns.empty() && !a.whole && a.change == b.change && a.sign != b.sign) fail("it asks for more and for less");
  }
  if (main.empty()) {
    fail("it does not say what shall change");
    way.doubt += unused_word * static_cast<int>(way.unused.size());
    return way;
  }
  way.edits = {PlainEdit{}};
  for (const Clause* clause : main) {
    Meant meant = mean(facts, *clause, clause->names_whole ? std::vector<PartIndex>() : pointed);
    if (!meant.fault.empty()) {
      fail(meant.fault);
      way.doubt += 5;
    }
    std::vector<PlainEdit> sums;
    for (const PlainEdit& before : way.edits) {
      for (const PlainEdit& more : meant.edits) {
        PlainEdit sum = before;
        bool contradicts = false;
        for (const Statement& statement : more.statements) {
          const bool again = std::any_of(sum.statements.begin(), sum.statements.end(), [&](const Statement& other) {
            return acts_on(facts.shape(), other) == acts_on(facts.shape(), statement);
          });
          const bool same = std::any_of(sum.statements.begin(), sum.statements.end(), [&](const Statement& other) {
            return reading_signature(facts.shape(), {other}) == reading_signature(facts.shape(), {statement});
          });
          if (again && !(same && !more.target)) {
            fail("it asks for two different changes of the same");
            contradicts = true;
          }
          if (!again) sum.statements.push_back(statement);
        }
        sum.hints.insert(more.hints.begin(), more.hints.end());
        sum.loose.insert(more.loose.begin(), more.loose.end());
        // A slider has one value: with two amounts, neither is set.
        if (sum.target && more.target) fail("it names two sizes for one slider");
        if (!sum.target) sum.target = more.target;
        if (sums.size() < most_readings) sums.push_back(std::move(sum));
        if (contradicts && sums.size() < most_readings) sums.push_back(instead(facts.shape(), before, more));
      }
    }
    way.edits = std::move(sums);
  }
  for (PlainEdit& edit : way.edits) let_rows_follow(facts.shape(), edit);
  for (const Clause* clause : kept) {
    for (PlainEdit& edit : way.edits) {
      if (const std::string fault = keep(facts, *clause, edit); !fault.empty()) fail(fault);
    }
  }
  way.doubt += unused_word * static_cast<int>(way.unused.size());
  return way;
}

std::string key(const Shape& shape, const PlainEdit& edit) {
  const auto request = request_of(shape, edit);
  json rest = to_json(*request);
  rest.erase("seed");
  std::string text = reading_signature(shape, edit.statements) + rest.dump();
  // Of the whole or of the part that sets it, the same value is the same.
  if (edit.target) text += std::to_string(edit.target->x);
  return text;
}

std::string number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.4g", value);
  return text;
}

std::string size_words(const PlainTarget& target) {
  const double value = target.how_much.value;
  const auto in_unit = [&](double amount) -> std::string {
    if (target.how_much.unit == HowMuch::Unit::radian) return number(amount * 180 / 3.14159265358979323846) + "°";
    if (target.how_much.unit == HowMuch::Unit::piece) return number(amount);
    return std::abs(amount) < 1 ? number(100 * amount) + " cm" : number(amount) + " m";
  };
  switch (target.how_much.kind) {
    case HowMuch::Kind::by:
      return "by " + in_unit(std::abs(value));
    case HowMuch::Kind::to:
      return "to " + in_unit(value);
    default:
      return "to " + number(100 * value) + " %";
  }
}

std::string words_of(const Shape& shape, const PlainEdit& edit) {
  std::string text = reading_words(shape, edit.statements);
  return edit.target ? text + ", " + size_words(*edit.target) : text;
}

PlainReading read_in(const ShapeFacts& facts, const std::vector<Token>& tokens, const WordList& list,
                     const std::vector<PartIndex>& pointed) {
  const Shape& shape = facts.shape();
  const PartNames names(shape, list);
  PlainReading reading;
  reading.language = list.language;
  std::vector<Way> ways;
  for (const auto& items : ways_to_take(tokens, list, names)) {
    Way way = take(facts, tokens, items, names, pointed);
    std::erase_if(way.edits, [&](const PlainEdit& edit) { return !request_of(shape, edit); });
    if (way.edits.empty() && way.fault.empty()) way.fault = "the edit that it comes to is not possible";
    ways.push_back(std::move(way));
  }
  if (ways.empty()) return reading;
  std::stable_sort(ways.begin(), ways.end(),
                   [](const Way& a, const Way& b) { return a.clean() != b.clean() ? a.clean() : a.doubt < b.doubt; });
  std::set<std::string> seen;
  const auto add = [&](const PlainEdit& edit) {
    if (reading.edits.size() < most_readings && seen.insert(key(shape, edit)).second) reading.edits.push_back(edit);
  };
  const Way& best = ways.front();
  for (const Way& way : ways) {
    if (best.clean() && !(way.clean() && way.doubt <= best.doubt)) continue;
    for (const PlainEdit& edit : way.edits) add(edit);
  }
  reading.sure = best.clean() && reading.edits.size() == 1;
  if (best.clean() && !reading.sure) reading.reason = "it can be taken in more than one way";
  if (!best.clean()) reading.reason = best.fault;
  std::set<std::size_t> unused(best.unused.begin(), best.unused.end());
  for (const std::size_t at : unused) reading.unused.push_back(printable(tokens[at].said, 40));
  if (!best.clean() && reading.reason.empty() && !unused.empty()) reading.reason = "it was not wholly understood";
  for (const PlainEdit& edit : reading.edits) reading.words.push_back(words_of(shape, edit));
  return reading;
}

}  // namespace

Result<PlainReading> read_plainly(const Shape& shape, const EditWish& wish) {
  const Result<std::vector<PartIndex>> pointed = check_wish(shape, wish);
  if (!pointed.ok()) return pointed.error();
  const ShapeFacts facts(shape);
  const std::vector<Token> tokens = plain_tokens(wish.request);
  PlainReading best;
  best.reason = "it says nothing";
  if (tokens.empty()) return best;
  bool first = true;
  for (const WordList& list : word_lists()) {
    PlainReading reading = read_in(facts, tokens, list, *pointed);
    const bool better = first || (reading.sure && !best.sure) ||
                        (reading.sure == best.sure && reading.unused.size() < best.unused.size());
    if (better) best = std::move(reading);
    first = false;
  }
  return best;
}

Inference as_inference(const Shape& shape, const PlainReading& reading) {
  Inference out;
  out.seed.of = 1;
  for (std::size_t i = 0; i < reading.edits.size(); ++i)
    out.seed.readings.push_back({reading.edits[i].statements, reading.words[i], reading.sure ? 1 : 0});
  out.seed.outcome = reading.sure            ? SeedVote::Outcome::decided
                     : reading.edits.empty() ? SeedVote::Outcome::unclear
                                             : SeedVote::Outcome::split;
  if (reading.edits.empty()) {
    out.seed.reason = reading.reason;
    return out;
  }
  const PlainEdit& first = reading.edits.front();
  for (const auto& [part, hint] : first.hints) out.hints.push_back({part, hint, 1, 1});
  std::set<RelationIndex> listed;
  for (const RelationIndex r : active_relations(shape)) {
    if (shape.relations[r].is_symmetry()) listed.insert(r);
  }
  // Of joints those that give way in one of the readings.
  for (const PlainEdit& edit : reading.edits) listed.insert(edit.loose.begin(), edit.loose.end());
  for (const RelationIndex r : listed) out.relations.push_back({r, first.loose.count(r) == 0, 1, 1});
  out.edit = request_of(shape, first);
  return out;
}

json to_json(const Shape& shape, const PlainReading& reading) {
  json readings = json::array();
  for (std::size_t i = 0; i < reading.edits.size(); ++i) {
    const PlainEdit& edit = reading.edits[i];
    json target;
    if (edit.target) {
      constexpr const char* kinds[] = {"by", "to", "times"};
      target = {{"part", edit.target->part.empty() ? json() : json(edit.target->part)},
                {"what", edit.target->what},
                {kinds[static_cast<int>(edit.target->how_much.kind)], edit.target->how_much.value},
                {"x", edit.target->x}};
    }
    readings.push_back({{"edit", to_json(*request_of(shape, edit))}, {"words", reading.words[i]}, {"target", target}});
  }
  json out = to_json(shape, as_inference(shape, reading));
  out["plain"] = {{"sure", reading.sure},
                  {"language", reading.language},
                  {"unused", reading.unused},
                  {"reason", reading.reason.empty() ? json() : json(reading.reason)},
                  {"readings", std::move(readings)}};
  return out;
}

}  // namespace parsel
