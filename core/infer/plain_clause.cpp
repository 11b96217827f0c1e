#include "core/infer/plain_clause.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace parsel {

namespace {

class Parser {
 public:
  Parser(const std::vector<Item>& items, const std::vector<Token>& tokens, const PartNames& names)
      : tokens_(tokens), names_(names) {
    for (const Item& item : items) {
      if (item.word.kind != WordKind::filler) items_.push_back(item);
    }
  }

  Sentence run() {
    sentence_.clauses.emplace_back();
    while (at_ < items_.size()) take();
    end_clause();
    std::erase_if(sentence_.clauses, is_empty);
    spread_keeps(sentence_);
    return std::move(sentence_);
  }

 private:
  Clause& now() { return sentence_.clauses.back(); }
  bool next_is(WordKind kind, std::size_t ahead = 1) const {
    return at_ + ahead < items_.size() && items_[at_ + ahead].word.kind == kind;
  }
  static bool is_empty(const Clause& c) {
    return c.change == Change::none && c.nouns.empty() && !c.whole && !c.where && c.out == 0 && !c.how_much &&
           !c.only && !c.keeps && !c.everything_else && c.fixed.empty() && c.fault.empty();
  }
  void unused(const Item& item) {
    for (std::size_t i = 0; i < item.count; ++i) sentence_.unused.push_back(item.first + i);
  }
  void fault(const std::string& why) {
    if (now().fault.empty()) now().fault = why;
  }

  void change(Change what, int sign, const Item& item) {
    Clause& c = now();
    // "move … apart", "put … further out", "lift … up" say one thing in two words.
    const auto moves = [](Change one) { return one == Change::move; };
    if (c.change == Change::none || (moves(c.change) && (what == Change::spacing || what == Change::move)) ||
        (c.change == Change::spacing && c.sign == 1 && what == Change::spacing)) {
      c.change = what;
      c.sign = sign;
    } else if (moves(what) && c.change == Change::spacing) {
      return;
    } else if (moves(c.change) && what == Change::raise) {
      c.where = Side{1, sign};
      return;
    } else if (c.change != what || c.sign != sign) {
      fault("it asks for two things at once");
      unused(item);
    }
    c.needs_object = c.needs_object || item.word.needs_object;
    c.knows_way = c.knows_way || item.word.knows_way;
    c.removes = c.removes || item.word.removes;
    c.compares = true;
    c.counts_one = c.counts_one || (what == Change::count && item.word.kind == WordKind::change);
  }

  static Clause::Link link_of(const std::string& said) {
    if (said == "." || said == ";") return Clause::Link::sentence;
    return said == "," ? Clause::Link::comma : Clause::Link::conjunction;
  }

  void where(const Side& side, const Item& item) {
    Clause& c = now();
    if (c.where && !(*c.where == side)) {
      fault("it names two directions");
      unused(item);
    }
    c.where = side;
  }

  void begin(Clause::Begins how, Clause::Link link = Clause::Link::other) {
    using Link = Clause::Link;
    end_clause();
    Clause next;
    next.begins = how;
    next.link = link;
    if (is_empty(now())) {  // of several links, as in ", and", the one that parts more
      const Link before = now().link;
      const bool comma = before == Link::comma || link == Link::comma;
      const bool conjunction = before == Link::conjunction || link == Link::conjunction;
      if (before == Link::sentence || before == Link::other) next.link = before;
      if (before == Link::comma_and_conjunction && link != Link::other) next.link = before;
      if (comma && conjunction) next.link = Link::comma_and_conjunction;
    }
    sentence_.clauses.push_back(next);
    says_one_ = false;
  }

  void end_clause() {
    Clause& c = now();
    // Sides that no part took are the way to go. A place is told with "at", "on" or "to": "the back thicker" is of a back.
    const bool goes = c.change == Change::move || c.change == Change::tilt;
    for (const Item& side : sides_) {
      if (!goes) unused(side);
      where({side.word.axis, side.word.sign}, side);
    }
    sides_.clear();
    // Not "stand it up", where the noun is a verb.
    const bool only_goes = goes_ && c.change == Change::none && !adjective_ && !c.keeps;
    if (only_goes && !c.nouns.empty() && !c.whole) c.change = Change::move;
    goes_ = false;
    if (middle_) unused(*middle_);
    middle_.reset();
    if (adjective_ && adjective_->word.sign < 0) {
      unused(*adjective_);
      fault("it does not say how " + tokens_[adjective_->first].said);
      adjective_.reset();
    }
    if (adjective_) {
      const bool sized = c.change == Change::size && c.compares;
      if (!sized && !c.how_much && !factor_) {
        unused(*adjective_);
        fault("it does not say how " + tokens_[adjective_->first].said);
      }
      if (c.change == Change::none || c.change == Change::size) {
        const bool is_bare = c.change == Change::none;
        c.change = adjective_->word.change;
        if (is_bare && c.how_much && c.how_much->kind == HowMuch::Kind::by) c.how_much->kind = HowMuch::Kind::to;
      } else if (c.change != adjective_->word.change) {
        fault("it asks for two things at once");
      }
      adjective_.reset();
    }
    if (factor_) {
      if (c.how_much) fault("it names two sizes");
      c.how_much = HowMuch{HowMuch::Kind::times, HowMuch::Unit::ratio, factor_->word.value};
      if (c.change == Change::none && many_) c.change = Change::count;
      if (c.change == Change::none) {
        unused(*factor_);
        fault("it does not say what shall be as large");
      }
      factor_.reset();
    } else if (many_) {
      c.change = Change::count;
      fault("it does not say how many");
    }
    many_ = false;
    if (number_) {
      HowMuch pieces{to_ || exact_ ? HowMuch::Kind::to : HowMuch::Kind::by, HowMuch::Unit::piece, number_->word.value};
      if (c.change == Change::none && !c.nouns.empty() && !c.keeps) {
        pieces.kind = HowMuch::Kind::to;
        c.change = Change::count;
      }
      const bool whole = number_->word.value == std::floor(number_->word.value);
      if (c.change != Change::count) {
        pieces.unit = HowMuch::Unit::none;
      } else if (!whole) {
        fault("a number of parts is a whole one");
      }
      if (c.how_much) fault("it names two sizes");
      c.how_much = pieces;
      number_.reset();
    }
    if (c.how_much && c.how_much->kind == HowMuch::Kind::by && (to_ || exact_)) c.how_much->kind = HowMuch::Kind::to;
    to_ = exact_ = false;
    if (c.how_much && c.change == Change::none && c.fault.empty() && !c.keeps && !c.nouns.empty())
      fault("it says how much, but not what shall change");
  }

  void number(const Item& item) {
    Clause& c = now();
    if (!next_is(WordKind::length) && !next_is(WordKind::percent) && !next_is(WordKind::degrees)) {
      if (number_) fault("it names two numbers"), unused(item);
      number_ = item;
      return;
    }
    const Item& unit = items_[++at_];
    HowMuch amount;
    amount.value = item.word.value;
    if (unit.word.kind == WordKind::length) {
      amount.unit = HowMuch::Unit::metre;
      amount.value *= unit.word.value;
    } else if (unit.word.kind == WordKind::degrees) {
      amount.unit = HowMuch::Unit::radian;
      amount.value *= std::numbers::pi / 180;
    } else {
      amount.unit = HowMuch::Unit::ratio;
      amount.value /= 100;
    }
    if (c.how_much) fault("it names two sizes"), unused(item);
    c.how_much = amount;
  }

  void part(const Item& item) {
    Clause& c = now();
    Noun noun{item.parts, {}, middle_.has_value(), item.plural, item.distance == 3, item.first, false};
    noun.stands = names_.is_standing(tokens_[item.first + item.count - 1].text);
    says_one_ = says_one_ || (!item.plural && item.first > 0 && names_.is_one(tokens_[item.first - 1].text));
    for (const Item& side : sides_) noun.sides.push_back({side.word.axis, side.word.sign});
    const bool belongs =
        at_ > 0 && (items_[at_ - 1].word.kind == WordKind::of || items_[at_ - 1].word.kind == WordKind::at);
    if (belongs && !c.nouns.empty() && noun.sides.empty()) {
      // "the cushion on the seat": of several, the one whose name has that word as well.
      Noun& first = c.nouns.back();
      std::vector<PartIndex> narrowed;
      for (const PartIndex p : first.parts) {
        if (names_.has_word(p, tokens_[item.first].text)) narrowed.push_back(p);
      }
      if (narrowed.empty()) return unused(item);
      first.parts = narrowed;
      return;
    }
    const bool of_part = belongs && !sides_.empty() && items_[at_ - 1].word.kind == WordKind::of;
    if (of_part) {  // "the top of the back"
      for (const Side& side : noun.sides) where(side, item);
      noun.sides.clear();
    }
    sides_.clear();
    middle_.reset();
    if (!c.nouns.empty()) {
      fault("it names several parts");
      unused(item);
    }
    c.nouns.push_back(std::move(noun));
  }

  void take() {
    const Item& item = items_[at_];
    const Word& word = item.word;
    switch (word.kind) {
      case WordKind::part:
        part(item);
        break;
      case WordKind::whole:
        now().whole = true;
        now().names_whole = now().names_whole || !word.points;
        break;
      case WordKind::follow:
        now().follows = true;
        break;
      case WordKind::change:
        change(word.change, word.sign, item);
        break;
      case WordKind::adjective:
        if (adjective_) fault("it names two measures"), unused(item);
        adjective_ = item;
        break;
      case WordKind::more:
      case WordKind::less:
        more(item);
        break;
      case WordKind::many:
        many_ = true;
        break;
      case WordKind::side:
        side(item);
        break;
      case WordKind::middle:
        middle_ = item;
        break;
      case WordKind::way:
        goes_ = true;
        where({word.axis, word.sign}, item);
        break;
      case WordKind::out:
        if (now().out == -word.sign) fault("it names two directions");
        now().out = word.sign;
        goes_ = true;
        break;
      case WordKind::number:
        number(item);
        break;
      case WordKind::factor:
        if (factor_) fault("it names two sizes"), unused(item);
        factor_ = item;
        break;
      case WordKind::only:
        now().only = true;
        break;
      case WordKind::keep:
        keep();
        break;
      case WordKind::keep_size:
        keep();
        now().same_size = true;
        break;
      case WordKind::fixed:
      case WordKind::same_size:
        now().same_size = now().same_size || word.kind == WordKind::same_size;
        now().fixed.push_back(item.first);
        break;
      case WordKind::rest:
        now().everything_else = true;
        break;
      case WordKind::nothing_else:
        if (!is_empty(now())) begin(Clause::Begins::conjunction);
        now().everything_else = now().keeps = true;
        break;
      case WordKind::too:
        if (next_is(WordKind::adjective) || next_is(WordKind::change)) {
          ++at_;
          change(items_[at_].word.change, -items_[at_].word.sign, items_[at_]);
        }
        break;
      case WordKind::conjunction:
        begin(Clause::Begins::conjunction, link_of(tokens_[item.first].said));
        break;
      case WordKind::but:
      case WordKind::with:
        begin(Clause::Begins::conjunction);
        break;
      case WordKind::so:
        begin(Clause::Begins::so);
        break;
      case WordKind::by:
        if (!next_is(WordKind::number) && !next_is(WordKind::factor)) begin(Clause::Begins::by);
        break;
      case WordKind::at:
        if (next_is(WordKind::change)) begin(Clause::Begins::on);
        break;
      case WordKind::to:
        to_ = to_ || next_is(WordKind::number);
        break;
      case WordKind::exactly:
        exact_ = true;
        break;
      case WordKind::of:
      case WordKind::as:
        break;
      case WordKind::negation:
        fault("it says what shall not be");
        unused(item);
        break;
      default:
        unused(item);
    }
    ++at_;
  }

  void more(const Item& item) {
    const int sign = item.word.kind == WordKind::more ? 1 : -1;
    if (next_is(WordKind::adjective)) {
      ++at_;
      change(items_[at_].word.change, sign * items_[at_].word.sign, items_[at_]);
    } else {
      change(Change::count, sign, item);
      now().counts_one = now().counts_one || says_one_;  // "ein Boden mehr"
    }
  }

  void side(const Item& item) {
    const bool told =
        at_ > 0 && (items_[at_ - 1].word.kind == WordKind::at || items_[at_ - 1].word.kind == WordKind::to);
    std::size_t ahead = 1;
    while (next_is(WordKind::side, ahead) || next_is(WordKind::middle, ahead)) ++ahead;
    const bool has_part = next_is(WordKind::part, ahead);
    const bool of_part = next_is(WordKind::of, ahead) && next_is(WordKind::part, ahead + 1);
    if (!has_part && !of_part && told) {
      where({item.word.axis, item.word.sign}, item);
    } else {
      sides_.push_back(item);
    }
  }

  void keep() {
    Clause& c = now();
    if (c.keeps) return;
    const bool starts = c.change == Change::none && !c.how_much && !c.where;
    if (!starts) {
      begin(Clause::Begins::conjunction);
    }
    now().keeps = true;
    now().named_before = !now().nouns.empty() || now().whole || now().everything_else;
  }

  std::vector<Item> items_;  ///< without fillers
  const std::vector<Token>& tokens_;
  const PartNames& names_;
  Sentence sentence_;
  std::size_t at_ = 0;
  std::vector<Item> sides_;  ///< waiting for their part
  std::optional<Item> middle_, adjective_, factor_, number_;
  bool many_ = false, to_ = false, exact_ = false;
  bool says_one_ = false;  ///< "a shelf"
  bool goes_ = false;      ///< "out", "upwards": a move, if nothing else is said
};

}  // namespace

Sentence parse(const std::vector<Item>& items, const std::vector<Token>& tokens, const PartNames& names) {
  return Parser(items, tokens, names).run();
}

}  // namespace parsel
