#include "core/base/text.h"

#include <doctest/doctest.h>

#include <set>

#include "core/shape/label.h"
#include "core/shape/words.h"
#include "tests/core/hostile_names.h"
#include "tests/core/scripts.h"

using namespace parsel;

namespace {

/// Whether the text may be cut before byte `at`.
bool is_between(const std::string& text, std::size_t at) {
  if (at == 0 || at == text.size()) return true;
  if ((static_cast<unsigned char>(text[at]) & 0xc0) == 0x80) return false;
  return !joins_previous(character_at(text, at).code);
}

std::vector<std::string> all_texts() {
  std::vector<std::string> texts;
  for (const Script& script : scripts) {
    texts.push_back(script.request);
    texts.insert(texts.end(), script.parts.begin(), script.parts.end());
  }
  return texts;
}

}  // namespace

TEST_CASE("text is cut between characters at every length") {
  for (const std::string& text : all_texts()) {
    CAPTURE(text);
    const std::size_t first = cut(text, 0).size();
    CHECK(first == 0);
    std::size_t longest = 0;
    for (std::size_t limit = 0; limit <= text.size() + 1; ++limit) {
      const std::string_view part = cut(text, limit);
      CHECK(part.size() <= limit);
      CHECK(is_utf8(part));
      CHECK(text.starts_with(part));
      CHECK(part.size() >= longest);  // more room never shows less
      if (limit >= 64) CHECK(is_between(text, part.size()));
      longest = part.size();
    }
    CHECK(cut(text, text.size()) == text);
    for (std::size_t at = 1; at < text.size(); ++at) {
      // Behind a whole character there is always a place to cut.
      const std::string twice = "a" + text;
      CHECK(is_between(twice, cut(twice, at).size()));
    }
  }
}

TEST_CASE("what people see as one character is not cut") {
  CHECK(cut("e\u0301x", 2) == "e");                                // longer than the limit: at least whole UTF-8
  CHECK(cut("ae\u0301", 3) == "a");                                // not between a letter and its mark
  CHECK(cut("a👩🏽\u200d🔧", 12) == "a");                    // nor within a joined emoji
  CHECK(cut("a👩🏽\u200d🔧", 16) == "a👩🏽\u200d🔧");  // that fits
  CHECK(cut("🇩🇪🇫🇷", 12) == "🇩🇪");                                  // nor within a flag, though between two
  CHECK(cut("❤️x", 6) == "❤️");                            // the variation selector stays
  CHECK(cut("क्षि", 6) == "क्");
  CHECK(cut("\xff\xff\xff", 2) == "\xff\xff");
}

TEST_CASE("every script is printable as it is, and cut where a name is too long") {
  for (const std::string& text : all_texts()) {
    CAPTURE(text);
    CHECK(printable(text, 200) == text);
    CHECK_FALSE(is_blank(text));
    for (std::size_t limit = 0; limit < text.size(); ++limit) CHECK(is_utf8(printable("x" + text, limit)));
    const std::string quoted = quoted_name("0123456789012345678901234567890" + text + text);
    CHECK(is_utf8(quoted));
    CHECK(is_between(quoted, quoted.size() - 1));
  }
}

TEST_CASE("what reorders or hides text never reaches people") {
  CHECK(printable("\u202eteas\u202c") == "teas");
  CHECK(printable("a\u2066b\u2069c\u061cd\u200ee") == "a b c d e");
  CHECK(printable("zero\u200bwidth\u200djoined\u200capart") ==
        "zero width joined apart");  // no joiner between Latin letters
  CHECK(printable("پایه\u200cها") == "پایه\u200cها");
  CHECK(printable("پ\u200c\u200c\u200cه\u200c") == "پ ه");  // one at a time, and between letters
  CHECK(printable("\u0301\u0301a") == "a");                 // would join the quotation mark before it
  CHECK(printable("a\xc3") == "a");
  CHECK(printable(std::string("a\0b", 3)) == "a b");
  for (const std::string& name : hostile_names) CHECK(is_utf8(printable(name, 40)));
  // What is printable stays as it is: the shape that was written can be read again.
  std::vector<std::string> names = all_texts();
  names.insert(names.end(), hostile_names.begin(), hostile_names.end());
  names.push_back("_\u0301_seat");
  for (int times = 0; times < 6; ++times) names.push_back(names.back() + "👩🏽\u200d🔧\u200d");
  for (const std::string& name : names) {
    CAPTURE(name);
    for (const std::size_t limit : {5, 12, 40, 64, 200}) {
      const std::string once = printable(name, limit);
      CHECK(printable(once, limit) == once);
    }
    const std::string label = clean_label(name);
    CHECK(printable(label) == label);
  }
  for (const char* nothing :
       {"", " ", "\t\n", "\u200b", "\u202e", "\u0301", "\u3000", "\u00a0\u2003", "\u3164", "\xff"}) {
    CAPTURE(nothing);
    CHECK(is_blank(nothing));
  }
}

TEST_CASE("characters are counted and told apart") {
  CHECK(count_characters("añ座🪑") == 4);
  CHECK(count_characters("a\xff\xc3") == 3);
  CHECK(character_at("座", 0).code == U'座');
  CHECK(character_at("\xed\xa0\x80", 0).code == 0xfffd);
  CHECK(plain_latin(U'é') == "e");
  CHECK(plain_latin(U'ß') == "ss");
  CHECK(plain_latin(U'ž') == "z");
  CHECK(plain_latin(U'ſ') == "s");
  CHECK(plain_latin(U'ộ') == "o");
  CHECK(plain_latin(U'×').empty());
  CHECK(plain_latin(U'e').empty());
  CHECK(plain_latin(U'座').empty());
}

TEST_CASE("ids of every script are usable and unique") {
  CHECK(slug("Füße") == "fusse");
  CHECK(slug("Fu\u0308ße") == "fusse");
  CHECK(slug("mặt bàn") == "mat_ban");
  CHECK(slug("ножка 2") == "2");
  for (const Script& script : scripts) {
    CAPTURE(script.name);
    // Every part twice, so that some share a label.
    std::vector<std::string> labels;
    std::vector<Vec3> centres;
    for (const std::string& part : script.parts) {
      for (const double x : {-1.0, 1.0}) {
        labels.push_back(clean_label(part));
        centres.emplace_back(x, static_cast<double>(labels.size()), 0);
        CHECK(labels.back() == part);
      }
    }
    std::set<std::string> ids, names;
    for (std::size_t i = 0; i < labels.size(); ++i) {
      const PartName name = name_parts(labels, centres)[i];
      CHECK(name.id.find_first_not_of("abcdefghijklmnopqrstuvwxyz0123456789_") == name.id.npos);
      CHECK(ids.insert(name.id).second);
      CHECK(names.insert(name.name).second);
      CHECK(name.name.find(labels[i].substr(1)) != name.name.npos);  // its first letter may be made small
    }
  }
  // Labels that have one slug but mean different things are not numbered together.
  const auto named = name_parts({"стол", "ножка", "ножка"}, {{0, 1, 0}, {1, 0, 0}, {-1, 0, 0}});
  CHECK(named[0].name == "стол");
  CHECK(named[1].name == "ножка (left)");
  CHECK(named[2].name == "ножка (right)");
}
