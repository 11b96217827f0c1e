#include "core/infer/plain_parts.h"

#include <algorithm>

#include "core/shape/label.h"

namespace parsel {

namespace {

bool contains(const std::vector<std::string>& list, const std::string& word) {
  return std::find(list.begin(), list.end(), word) != list.end();
}

/// "legFrontLeft", "foot_ring" → leg, front, left; foot, ring.
std::vector<std::string> label_words(std::string_view label) {
  std::string spaced;
  for (std::size_t i = 0; i < label.size(); ++i) {
    const bool hump = i > 0 && label[i] >= 'A' && label[i] <= 'Z' && label[i - 1] >= 'a' && label[i - 1] <= 'z';
    if (hump) spaced += ' ';
    spaced += label[i];
  }
  std::vector<std::string> words;
  for (const Token& token : plain_tokens(spaced)) {
    if (!token.is_number && token.text != ",") words.push_back(token.text);
  }
  return words;
}

bool share(const std::vector<std::string>& a, const std::vector<std::string>& b) {
  return std::any_of(a.begin(), a.end(), [&](const std::string& word) { return contains(b, word); });
}

std::string glue(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += word;
  return text;
}

std::string spaced(std::span<const Token> phrase) {
  std::string text;
  for (const Token& token : phrase) text += (text.empty() ? "" : " ") + token.text;
  return text;
}

std::string without_blanks(std::string text) {
  std::erase(text, ' ');
  return text;
}

}  // namespace

PartNames::PartNames(const Shape& shape, const WordList& list)
    : shape_(shape), list_(list), shape_words_(label_words(shape.name)) {
  for (const PartIndex p : active_parts(shape)) {
    const Part& part = shape.parts[p];
    const std::string& label = part.is_virtual() ? shape.parts[part.members.front()].label : part.label;
    Named named{p, label_words(label), {}, {}, {}};
    named.glued = list.singulars(glue(named.words));
    if (!named.words.empty()) named.last = list.singulars(named.words.back());
    named.key = list.singulars(glue(label_words(grouping_key(label))));
    for (const std::string& word : named.words) known_.push_back(word);
    known_.push_back(named.glued.front());
    known_.push_back(named.key.front());
    named_.push_back(std::move(named));
  }
  const std::size_t labels = known_.size();
  for (const auto& names : list.synonyms) {
    const bool is_here = std::any_of(names.begin(), names.end(), [&](const std::string& name) {
      return std::find(known_.begin(), known_.begin() + static_cast<std::ptrdiff_t>(labels), without_blanks(name)) !=
             known_.begin() + static_cast<std::ptrdiff_t>(labels);
    });
    if (is_here) known_.insert(known_.end(), names.begin(), names.end());
  }
  for (const auto& [plural, one] : list.singular) {
    if (contains(known_, one)) known_.push_back(plural);
  }
  std::sort(known_.begin(), known_.end());
  known_.erase(std::unique(known_.begin(), known_.end()), known_.end());
}

std::vector<PartIndex> PartNames::bearing(const std::vector<std::string>& forms, bool by_key) const {
  std::vector<PartIndex> exact, ending, keyed;
  bool is_ending = false;
  for (const Named& named : named_) {
    const bool is_keyed = share(forms, named.key);
    if (share(forms, named.glued)) exact.push_back(named.part);
    // Of "right door" and "leftdoor", either is a door.
    if (share(forms, named.last) || is_keyed) ending.push_back(named.part);
    if (share(forms, named.last)) is_ending = true;
    if (by_key && is_keyed) keyed.push_back(named.part);
  }
  return !exact.empty() ? exact : is_ending ? ending : keyed;
}

NamedParts PartNames::called(std::span<const Token> phrase) const {
  NamedParts found = named(phrase);
  if (found.parts.empty() && phrase.size() > 1 && share(list_.singulars(phrase.back().text), list_.generic)) {
    found = named(phrase.first(phrase.size() - 1));
    found.plural = phrase.back().text != list_.singulars(phrase.back().text).back();
    found.distance = std::max(found.distance, 1);
  }
  // A frame is what it is of only where nothing else is.
  const auto is_frame = [&](PartIndex part) {
    const auto& words =
        std::find_if(named_.begin(), named_.end(), [&](const Named& n) { return n.part == part; })->words;
    return std::any_of(words.begin(), words.end(), [&](const std::string& word) {
      return contains(list_.frames, word) && std::none_of(phrase.begin(), phrase.end(), [&](const Token& said) {
               return share(list_.singulars(said.text), list_.singulars(word));
             });
    });
  };
  std::vector<PartIndex> rest = found.parts;
  std::erase_if(rest, is_frame);
  if (!rest.empty()) found.parts = std::move(rest);
  return found;
}

NamedParts PartNames::named(std::span<const Token> phrase) const {
  NamedParts found;
  std::string before;  // all but the last word
  for (std::size_t i = 0; i + 1 < phrase.size(); ++i) before += phrase[i].text;
  std::vector<std::string> forms;
  for (const std::string& last : list_.singulars(phrase.back().text)) forms.push_back(before + last);
  const std::string& said = phrase.back().text;
  const auto plural_of = [&](const auto& matches) {
    // The first form is the word itself: a plural is what only its other forms name, or a plural that labels have as well.
    const bool may_be = forms.size() > 1 && !said.ends_with("ss");
    return !matches({forms.front()}) || (may_be && found.parts.size() > 1);
  };

  for (const bool by_key : {false, true}) {
    found.parts = bearing(forms, by_key);
    found.distance = by_key ? 1 : 0;
    if (found.parts.empty()) continue;
    found.plural = plural_of([&](const std::vector<std::string>& some) { return !bearing(some, by_key).empty(); });
    return found;
  }
  const auto by_synonym = [&](const std::vector<std::string>& some) {
    for (const auto& names : list_.synonyms) {
      const bool is_one = std::any_of(names.begin(), names.end(),
                                      [&](const std::string& name) { return contains(some, without_blanks(name)); });
      if (!is_one) continue;
      for (const std::string& name : names) {
        std::vector<PartIndex> parts = bearing({without_blanks(name)});
        if (!parts.empty()) return parts;
      }
    }
    return std::vector<PartIndex>();
  };
  found.distance = 1;
  found.parts = by_synonym(forms);
  if (!found.parts.empty()) {
    found.plural = plural_of([&](const std::vector<std::string>& some) { return !by_synonym(some).empty(); });
    return found;
  }
  if (const auto also = list_.also.find(spaced(phrase)); also != list_.also.end()) {
    for (const Named& one : named_) {
      if (share(also->second, one.glued)) found.parts.push_back(one.part);
    }
    if (!found.parts.empty()) return found;
  }
  const auto within = [&](const std::vector<std::string>& some) {
    std::vector<PartIndex> parts;
    for (const Named& named : named_) {
      const bool has = std::any_of(some.begin(), some.end(), [&](const std::string& form) {
        constexpr std::size_t shortest = 3;
        const std::string& glued = named.glued.front();
        return contains(named.words, form) ||
               (form.size() >= shortest && (glued.ends_with(form) || glued.starts_with(form)));
      });
      if (has) parts.push_back(named.part);
    }
    return parts;
  };
  found.distance = 2;
  if (phrase.size() == 1) found.parts = within(forms);
  if (!found.parts.empty()) {
    found.plural = plural_of([&](const std::vector<std::string>& some) { return !within(some).empty(); });
    return found;
  }
  found.distance = 3;
  for (const auto& [name, pieces] : list_.made_of) {
    if (!contains(forms, without_blanks(name))) continue;
    for (const std::string& piece : pieces) {
      found.parts = bearing({piece}, false);
      std::erase_if(found.parts, [&](PartIndex p) { return !is_behind(p); });
      if (!found.parts.empty()) return found;
    }
  }
  return found;
}

bool PartNames::is_one(const std::string& word) const {
  return contains(list_.one, word);
}

bool PartNames::is_standing(const std::string& word) const {
  return share(list_.singulars(word), list_.standing);
}

bool PartNames::is_behind(PartIndex part) const {
  double middle = 0, own = 0;
  for (const Named& named : named_) {
    const double z = shape_.parts[named.part].hexahedron.corners.col(2).mean();
    middle += z / static_cast<double>(named_.size());
    if (named.part == part) own = z;
  }
  return own < middle;
}

bool PartNames::is_whole(std::span<const Token> phrase) const {
  std::vector<std::string> forms;
  std::string before;
  for (std::size_t i = 0; i + 1 < phrase.size(); ++i) before += phrase[i].text;
  for (const std::string& last : list_.singulars(phrase.back().text)) forms.push_back(before + last);
  const std::string name = glue(shape_words_);
  if (std::any_of(forms.begin(), forms.end(), [&](const std::string& form) { return form == name; })) return true;
  const auto in_name = [&](const std::string& object) {
    const std::string word = without_blanks(object);
    return contains(shape_words_, word) || name == word;
  };
  bool name_says = false, is_object = false;
  for (const auto& names : list_.objects) {
    const bool says = std::any_of(names.begin(), names.end(), in_name);
    name_says = name_says || says;
    const bool is_this = std::any_of(
        names.begin(), names.end(), [&](const std::string& object) { return contains(forms, without_blanks(object)); });
    if (is_this && says) return true;
    is_object = is_object || is_this;
  }
  return is_object && !name_says;
}

bool PartNames::has_word(PartIndex part, const std::string& word) const {
  const auto found = std::find_if(named_.begin(), named_.end(), [&](const Named& named) { return named.part == part; });
  return found != named_.end() && (contains(found->words, word) || found->glued.front().starts_with(word));
}

}  // namespace parsel
