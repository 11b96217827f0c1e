// The ways to take the words of a request: plain_clause.h.
#include <algorithm>

#include "core/infer/plain_clause.h"

namespace parsel {

namespace {

constexpr std::size_t most_ways = 300;
constexpr std::size_t longest_noun = 3;

class Lattice {
 public:
  Lattice(const std::vector<Token>& tokens, const WordList& list, const PartNames& names)
      : tokens_(tokens), list_(list), names_(names) {}

  std::vector<std::vector<Item>> ways() {
    std::vector<Item> taken;
    go_on(0, taken);
    const auto doubts = [](const std::vector<Item>& items) {
      int sum = 0;
      for (const Item& item : items)
        sum += 3 * item.slip + item.distance + (item.word.kind == WordKind::unknown ? 20 : 0);
      return sum;
    };
    std::stable_sort(ways_.begin(), ways_.end(), [&](const auto& a, const auto& b) { return doubts(a) < doubts(b); });
    return std::move(ways_);
  }

 private:
  bool follows_number(std::size_t at) const {
    if (at == 0) return false;
    if (tokens_[at - 1].is_number || is_one(at - 1)) return true;
    const auto before = list_.phrases.find(tokens_[at - 1].text);
    return before != list_.phrases.end() && std::any_of(before->second.begin(), before->second.end(),
                                                        [](const Word& word) { return word.kind == WordKind::number; });
  }
  bool is_one(std::size_t at) const {
    return std::find(list_.one.begin(), list_.one.end(), tokens_[at].text) != list_.one.end();
  }
  static bool is_unit(const Word& word) {
    return word.kind == WordKind::length || word.kind == WordKind::percent || word.kind == WordKind::degrees;
  }
  /// The longest phrase that starts here, and its meanings.
  std::vector<Item> listed(std::size_t at, const std::string& text) const {
    std::vector<Item> items;
    for (std::size_t count = std::min(list_.longest, tokens_.size() - at); count > 0 && items.empty(); --count) {
      std::string phrase = text;
      for (std::size_t i = 1; i < count; ++i) phrase += " " + tokens_[at + i].text;
      const auto found = list_.phrases.find(phrase);
      if (found == list_.phrases.end()) continue;
      for (const Word& word : found->second) {
        if (is_unit(word) && !follows_number(at)) continue;
        Item item;
        item.word = word;
        item.first = at;
        item.count = count;
        items.push_back(std::move(item));
      }
    }
    // After a number, "in" is a unit and nothing else.
    if (std::any_of(items.begin(), items.end(), [](const Item& item) { return is_unit(item.word); }))
      std::erase_if(items, [](const Item& item) { return !is_unit(item.word); });
    return items;
  }
  std::vector<Item> nouns(std::size_t at, const std::string& text) const {
    std::vector<Item> items;
    for (std::size_t count = std::min(longest_noun, tokens_.size() - at); count > 0 && items.empty(); --count) {
      std::vector<Token> phrase(tokens_.begin() + static_cast<std::ptrdiff_t>(at),
                                tokens_.begin() + static_cast<std::ptrdiff_t>(at + count));
      if (std::any_of(phrase.begin(), phrase.end(), [](const Token& t) { return t.is_number || t.text == ","; }))
        continue;
      phrase.front().text = text;
      NamedParts named = names_.called(phrase);
      if (!named.parts.empty()) {
        Item item;
        item.word.kind = WordKind::part;
        item.parts = std::move(named.parts);
        item.plural = named.plural;
        item.distance = named.distance;
        item.first = at;
        item.count = count;
        items.push_back(std::move(item));
      }
      if (names_.is_whole(phrase)) {
        Item item;
        item.word.kind = WordKind::whole;
        item.first = at;
        item.count = count;
        items.push_back(std::move(item));
      }
    }
    return items;
  }
  std::vector<Item> exact(std::size_t at, const std::string& text) const {
    std::vector<Item> items = listed(at, text);
    const bool unit = !items.empty() && is_unit(items.front().word);
    if (!unit) {
      // "the rest" is no "crest".
      const bool is_rest = !items.empty() && items.front().word.kind == WordKind::rest;
      for (Item& item : nouns(at, text)) {
        if (!is_rest || item.distance < 2) items.push_back(std::move(item));
      }
    }
    return items;
  }

  std::vector<Item> options(std::size_t at) const {
    const Token& token = tokens_[at];
    Item plain;
    plain.first = at;
    if (token.is_number) {
      plain.word.kind = WordKind::number;
      plain.word.value = token.value;
      return {plain};
    }
    if (token.text == ",") {
      plain.word.kind = WordKind::conjunction;
      return {plain};
    }
    const bool has_next = at + 1 < tokens_.size();
    if (is_one(at) && has_next) {
      const auto next = list_.phrases.find(tokens_[at + 1].text);
      const bool before_unit =
          next != list_.phrases.end() && std::any_of(next->second.begin(), next->second.end(),
                                                     [](const Word& word) { return word.kind == WordKind::length; });
      const bool after_by = at > 0 && (tokens_[at - 1].text == "by" || tokens_[at - 1].text == "um");
      if (before_unit && after_by) {
        plain.word.kind = WordKind::number;
        plain.word.value = 1;
        return {plain};
      }
    }
    std::vector<Item> items = exact(at, token.text);
    if (!items.empty()) return items;
    constexpr int most = 3;
    int best = most + 1;
    std::vector<std::string> meant;
    const std::vector<std::string> forms = list_.singulars(token.text);
    const auto look_at = [&](const std::string& known) {
      int slip = most + 1;
      for (const std::string& form : forms) slip = std::min(slip, std::max(1, misspelling(form, known)));
      if (slip < best) meant.clear();
      if (slip <= most && slip <= best) meant.push_back(known), best = slip;
    };
    for (const auto& [phrase, words] : list_.phrases) {
      if (phrase.find(' ') == phrase.npos &&
          !std::all_of(words.begin(), words.end(), [](const Word& word) { return word.kind == WordKind::unknown; }))
        look_at(phrase);
    }
    for (const std::string& known : names_.known_words()) look_at(known);
    for (const auto& names : list_.objects) {
      for (const std::string& name : names) look_at(name);
    }
    std::sort(meant.begin(), meant.end());
    meant.erase(std::unique(meant.begin(), meant.end()), meant.end());
    for (const std::string& known : meant) {
      for (Item& item : exact(at, known)) {
        item.slip = best;
        item.plural = item.plural || misspelling(token.text, known) > best;
        items.push_back(std::move(item));
      }
    }
    if (items.empty()) items.push_back(plain);
    return items;
  }

  void go_on(std::size_t at, std::vector<Item>& taken) {
    if (ways_.size() >= most_ways) return;
    if (at >= tokens_.size()) {
      ways_.push_back(taken);
      return;
    }
    if (options_.size() < tokens_.size()) {
      for (std::size_t i = options_.size(); i < tokens_.size(); ++i) options_.push_back(options(i));
    }
    for (const Item& item : options_[at]) {
      taken.push_back(item);
      go_on(at + item.count, taken);
      taken.pop_back();
    }
  }

  const std::vector<Token>& tokens_;
  const WordList& list_;
  const PartNames& names_;
  std::vector<std::vector<Item>> options_;
  std::vector<std::vector<Item>> ways_;
};

}  // namespace

std::vector<std::vector<Item>> ways_to_take(const std::vector<Token>& tokens, const WordList& list,
                                            const PartNames& names) {
  return Lattice(tokens, list, names).ways();
}

}  // namespace parsel
