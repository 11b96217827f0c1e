// JSON that remembers its own text, so that a file can be patched without touching what is not meant.
//
// Parsing into nlohmann::ordered_json and dumping again would keep the order of the keys but not the spelling of the
// numbers (1.0e-3, 0.10), the escapes, the white space or the integers beyond 64 bits. Here a value is its text until
// somebody looks into it; then it is split one level deep, and only what was set is written anew.
#pragma once

#include <cstddef>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/result.h"

namespace parsel::gltf {

class JsonText {
 public:
  /// `null`.
  JsonText();
  /// A new value, written compactly; strings must be UTF-8.
  explicit JsonText(const nlohmann::ordered_json& value);
  /// Any valid JSON text (RFC 8259) of at most 128 levels. Keeps everything, leading and trailing white space included.
  static Result<JsonText> parse(std::string_view text);

  /// Every byte that was not set, as it was.
  std::string text() const;

  bool is_object() const { return first() == '{'; }
  bool is_array() const { return first() == '['; }
  /// Members or elements; 0 for anything else.
  std::size_t size() const;

  /// The member's value or the element; a shared `null` when there is none, so that look-ups chain. Of members with
  /// the same key the last one counts, as in JSON.parse.
  const JsonText& get(std::string_view key) const;
  const JsonText& item(std::size_t i) const;
  bool has(std::string_view key) const { return position(key).has_value(); }
  std::string key(std::size_t i) const;
  /// The value of member or element i < size().
  const JsonText& value(std::size_t i) const;

  /// As get() and item(), to be changed; null pointers when there is none.
  JsonText* find(std::string_view key);
  JsonText* find_item(std::size_t i);

  std::optional<double> number() const;
  /// A whole number from 0 to 2^53, or to 2^32 - 1 on 32-bit machines (an index, a count, an offset).
  std::optional<std::size_t> index() const;
  std::optional<bool> boolean() const;
  /// Unescaped.
  std::optional<std::string> string() const;

  /// Replaces the member's value or appends a member, in the style of the member before. This must be an object.
  void set(std::string_view key, JsonText value);
  void erase(std::string_view key);
  /// This must be an array.
  void push_back(JsonText value);
  /// Removes element or member i < size().
  void erase_at(std::size_t i);

 private:
  struct Member;
  char first() const;
  const std::vector<Member>& members() const;
  std::vector<Member>& members();
  std::optional<std::size_t> position(std::string_view key) const;
  void append(Member member);

  // Either the raw text or, once split, the members between `open_` and `close_`. Splitting changes nothing that can be
  // seen from outside, so const functions may do it.
  mutable std::string raw_;
  mutable bool split_ = false;
  mutable std::vector<Member> members_;
  mutable std::string open_, close_;  ///< '{' or '[' with the white space before; what closes, likewise
};

struct JsonText::Member {
  std::string before, key, colon;  ///< white space; the key with its quotes and the colon, empty in arrays
  JsonText value;
  std::string after;  ///< white space before the comma or the end
};

inline JsonText::JsonText() : raw_("null") {}

}  // namespace parsel::gltf
