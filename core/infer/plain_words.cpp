#include "core/infer/plain_words.h"

#include <algorithm>
#include <cstdlib>
#include <nlohmann/json.hpp>

#include "core/base/result.h"
#include "core/base/text.h"
#include "core/infer/prompt_texts.h"

namespace parsel {

namespace {

using nlohmann::json;

const std::map<std::string_view, Change> sizes = {
    {"width", Change::width},   {"height", Change::height}, {"depth", Change::depth},
    {"length", Change::length}, {"thick", Change::thick},   {"size", Change::size},
    {"raise", Change::raise},   {"count", Change::count},   {"spacing", Change::spacing}};

const std::map<std::string_view, WordKind> plain_kinds = {
    {"filler", WordKind::filler},   {"degree", WordKind::filler},
    {"whole", WordKind::whole},     {"more", WordKind::more},
    {"less", WordKind::less},       {"many", WordKind::many},
    {"middle", WordKind::middle},   {"only", WordKind::only},
    {"keep", WordKind::keep},       {"fixed", WordKind::fixed},
    {"not", WordKind::negation},    {"and", WordKind::conjunction},
    {"but", WordKind::but},         {"with", WordKind::with},
    {"so", WordKind::so},           {"by", WordKind::by},
    {"of", WordKind::of},           {"at", WordKind::at},
    {"to", WordKind::to},           {"as", WordKind::as},
    {"exact", WordKind::exactly},   {"percent", WordKind::percent},
    {"degrees", WordKind::degrees}, {"same_size", WordKind::same_size},
    {"without", WordKind::keep},    {"follow", WordKind::follow},
    {"too", WordKind::too},         {"it", WordKind::whole},
    {"outside", WordKind::unknown}, {"keep_size", WordKind::keep_size},
    {"rest", WordKind::rest},       {"nothing_else", WordKind::nothing_else}};

/// The keys of a list: "width+" for wider, "width-", "width=" for wide, "width~" for its opposite, "side -x", "keep".
Word meaning(std::string_view key) {
  Word word;
  if (const auto plain = plain_kinds.find(key); plain != plain_kinds.end()) {
    word.kind = plain->second;
    word.points = key == "it";
    return word;
  }
  if (key == "out" || key == "in") {
    word.kind = WordKind::out;
    word.sign = key == "out" ? 1 : -1;
    return word;
  }
  if (key.starts_with("side ") || key.starts_with("way ")) {
    word.kind = key.starts_with("side ") ? WordKind::side : WordKind::way;
    word.sign = key[key.size() - 2] == '+' ? 1 : -1;
    word.axis = key.back() - 'x';
    return word;
  }
  const bool is_adjective = key.ends_with('=') || key.ends_with('~');
  word.kind = is_adjective ? WordKind::adjective : WordKind::change;
  if (is_adjective || key.ends_with('+') || key.ends_with('-')) {
    word.sign = key.ends_with('-') || key.ends_with('~') ? -1 : 1;
    key.remove_suffix(1);
    word.needs_object = key == "lift";
    word.change = key == "lift" ? Change::raise : sizes.at(key);
    return word;
  }
  const std::map<std::string_view, Change> verbs = {
      {"move", Change::move},   {"pull", Change::move},    {"open", Change::open},   {"tilt", Change::tilt},
      {"taper", Change::taper}, {"recline", Change::tilt}, {"remove", Change::count}};
  word.change = verbs.at(key);
  word.knows_way = key == "pull" || key == "recline";
  word.removes = key == "remove";
  if (word.removes) word.sign = -1;
  return word;
}

std::string joined(std::string_view phrase, std::size_t* count = nullptr) {
  std::string text;
  const std::vector<Token> tokens = plain_tokens(phrase);
  for (const Token& token : tokens) text += (text.empty() ? "" : " ") + token.text;
  if (count != nullptr) *count = std::max<std::size_t>(tokens.size(), 1);
  return tokens.empty() ? std::string(phrase) : text;  // an inch mark is a token after a number alone
}

std::vector<std::string> words_in(const json& list) {
  std::vector<std::string> out;
  for (const json& word : list) out.push_back(joined(word.get_ref<const std::string&>()));
  return out;
}

/// {"top": ["table"]}
std::map<std::string, std::vector<std::string>> words_by_word(const json& lists) {
  std::map<std::string, std::vector<std::string>> out;
  for (const auto& [word, list] : lists.items()) out[joined(word)] = words_in(list);
  return out;
}

std::vector<std::vector<std::string>> name_lists(const json& lists) {
  std::vector<std::vector<std::string>> out;
  for (const json& list : lists) out.push_back(words_in(list));
  return out;
}

WordList read_list(const json& list) {
  WordList out;
  out.language = list.at("language").get<std::string>();
  const auto add = [&](const json& phrase, const Word& word) {
    std::size_t count = 0;
    std::vector<Word>& known = out.phrases[joined(phrase.get_ref<const std::string&>(), &count)];
    if (std::find(known.begin(), known.end(), word) == known.end()) known.push_back(word);
    out.longest = std::max(out.longest, count);
  };
  for (const auto& [key, phrases] : list.at("words").items()) {
    for (const json& phrase : phrases) add(phrase, meaning(key));
  }
  const auto add_values = [&](const char* key, WordKind kind) {
    for (const auto& [value, phrases] : list.at(key).items()) {
      Word word;
      word.kind = kind;
      word.value = std::strtod(value.c_str(), nullptr);
      for (const json& phrase : phrases) add(phrase, word);
    }
  };
  add_values("lengths", WordKind::length);
  add_values("numbers", WordKind::number);
  add_values("factors", WordKind::factor);
  out.one = words_in(list.at("one"));
  out.objects = name_lists(list.at("objects"));
  out.synonyms = name_lists(list.at("synonyms"));
  out.made_of = words_by_word(list.at("made_of"));
  out.also = words_by_word(list.at("also"));
  out.generic = words_in(list.at("generic"));
  out.frames = words_in(list.at("frames"));
  out.standing = words_in(list.at("standing"));
  for (const auto& [plural, one] : list.at("singular").items())
    out.singular[joined(plural)] = joined(one.get_ref<const std::string&>());
  for (const json& ending : list.at("plural_endings"))
    out.plural_endings.emplace_back(ending[0].get<std::string>(), ending[1].get<std::string>());
  return out;
}

bool is_digit(char c) {
  return c >= '0' && c <= '9';
}

}  // namespace

std::vector<std::string> WordList::singulars(const std::string& word) const {
  std::vector<std::string> out = {word};
  if (const auto known = singular.find(word); known != singular.end()) out.push_back(known->second);
  for (const auto& [ending, stands_for] : plural_endings) {
    constexpr std::size_t shortest = 3;
    if (word.size() + stands_for.size() < ending.size() + shortest || !word.ends_with(ending)) continue;
    out.push_back(word.substr(0, word.size() - ending.size()) + stands_for);
  }
  return out;
}

std::span<const WordList> word_lists() {
  static const std::vector<WordList> lists = [] {
    std::vector<WordList> out;
    for (const std::string_view text : word_list_texts()) {
      const json list = json::parse(text, nullptr, false);
      PARSEL_ASSERT(!list.is_discarded(), "a list of words is JSON");
      out.push_back(read_list(list));
    }
    // English first: it wins where two languages read a request equally well.
    std::stable_sort(out.begin(), out.end(),
                     [](const WordList& a, const WordList& b) { return a.language == "en" && b.language != "en"; });
    return out;
  }();
  return lists;
}

std::vector<Token> plain_tokens(std::string_view text, std::size_t most) {
  std::vector<Token> tokens;
  Token word;
  const auto finish = [&] {
    if (!word.text.empty()) tokens.push_back(word);
    word = {};
  };
  for (std::size_t at = 0; at < text.size() && tokens.size() < most;) {
    const Character character = character_at(text, at);
    const std::string said(text.substr(at, character.size));
    const char c = text[at];
    if (is_digit(c)) {
      finish();
      std::size_t end = at;
      bool point = false;
      while (end < text.size()) {
        const bool mark =
            (text[end] == '.' || text[end] == ',') && !point && end + 1 < text.size() && is_digit(text[end + 1]);
        if (!is_digit(text[end]) && !mark) break;
        point = point || mark;
        ++end;
      }
      Token number;
      number.said = number.text = std::string(text.substr(at, std::min<std::size_t>(end - at, 20)));
      std::replace(number.text.begin(), number.text.end(), ',', '.');
      number.is_number = true;
      number.value = std::strtod(number.text.c_str(), nullptr);
      tokens.push_back(number);
      at = end;
      continue;
    }
    at += character.size;
    const std::string_view latin = plain_latin(character.code);
    const bool capital = c >= 'A' && c <= 'Z';
    if ((c >= 'a' && c <= 'z') || capital) {
      word.text += capital ? static_cast<char>(c - 'A' + 'a') : c;
    } else if (!latin.empty()) {
      word.text += latin;
    } else if (c == '\'' || character.code == U'\u2019') {
      word.said += said;
      continue;  // "it's" is "its"
    } else if (character.code >= 0x80 && character.whole && character.code != U'\u00b0' &&
               character.code != U'\u201c' && character.code != U'\u201d' && character.code != U'\u2013' &&
               character.code != U'\u2026' && character.code != U'\u00a0') {
      word.text += said;
    } else {
      finish();
      if (c == '%' || c == ',' || c == ';' || c == '+' || c == '"' || character.code == U'\u00b0') {
        const bool is_unit = c != '"' || (!tokens.empty() && tokens.back().is_number);
        if (is_unit) tokens.push_back({c == ';' ? "," : said, said, false, 0});
      } else if (c == '-' && at < text.size() && is_digit(text[at])) {
        tokens.push_back({"-", "-", false, 0});
      } else if (c == '.' && at < text.size()) {
        tokens.push_back({",", ".", false, 0});
      } else if (c == '&') {
        tokens.push_back({",", "&", false, 0});
      }
      continue;
    }
    word.said += said;
  }
  finish();
  while (!tokens.empty() && tokens.back().text == ",") tokens.pop_back();
  return tokens;
}

int misspelling(const std::string& word, const std::string& known) {
  if (word == known) return 0;
  constexpr int other = 4;
  const std::size_t n = word.size(), m = known.size();
  if (n < 3 || m < 3 || n > m + 1 || m > n + 1) return other;
  std::size_t same = 0;
  while (same < n && same < m && word[same] == known[same]) ++same;
  const auto rest = [&](std::size_t i, std::size_t j) { return word.compare(i, n, known, j, m) == 0; };
  const bool starts_alike = same > 0;
  if (n == m && same + 1 < n && word[same] == known[same + 1] && word[same + 1] == known[same] &&
      rest(same + 2, same + 2))
    return 1;
  if (n == m) return rest(same + 1, same + 1) && n >= 4 ? (n >= 6 && starts_alike ? 2 : 3) : other;
  const bool one_off = n > m ? rest(same + 1, same) : rest(same, same + 1);
  // A last letter more or less makes another word as often as a slip: "thin", "thing".
  const bool within = same + 1 < std::max(n, m);
  if (!one_off || std::min(n, m) < 4) return other;
  return starts_alike && within ? 1 : 3;
}

}  // namespace parsel
