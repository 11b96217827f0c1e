#include "core/gltf/json_text.h"

#include <cmath>
#include <cstdlib>
#include <nlohmann/json.hpp>

namespace parsel::gltf {
namespace {

using nlohmann::ordered_json;

bool is_space(char c) {
  return c == ' ' || c == '\n' || c == '\t' || c == '\r';
}

std::size_t skip_space(std::string_view text, std::size_t at) {
  while (at < text.size() && is_space(text[at])) ++at;
  return at;
}

/// The end of the string that starts with the quote at `at`. The text is valid JSON, here and below.
std::size_t skip_string(std::string_view text, std::size_t at) {
  for (++at; at < text.size() && text[at] != '"'; ++at) {
    if (text[at] == '\\') ++at;
  }
  return at + 1;
}

std::size_t skip_value(std::string_view text, std::size_t at) {
  if (text[at] == '"') return skip_string(text, at);
  if (text[at] != '{' && text[at] != '[') {
    while (at < text.size() && !is_space(text[at]) && text[at] != ',' && text[at] != '}' && text[at] != ']') ++at;
    return at;
  }
  // Brackets are counted, not recursed into: nesting is the file's choice.
  for (std::size_t depth = 0; at < text.size();) {
    const char c = text[at];
    at = c == '"' ? skip_string(text, at) : at + 1;
    if (c == '{' || c == '[') ++depth;
    if ((c == '}' || c == ']') && --depth == 0) break;
  }
  return at;
}

std::string unescape(const std::string& quoted) {
  if (quoted.find('\\') == std::string::npos) return quoted.substr(1, quoted.size() - 2);
  return ordered_json::parse(quoted, nullptr, false).get<std::string>();
}

bool key_is(const std::string& quoted, std::string_view key) {
  if (quoted.find('\\') != std::string::npos) return unescape(quoted) == key;
  return std::string_view(quoted).substr(1, quoted.size() - 2) == key;
}

/// Whether brackets nest deeper than the recursive functions here (and destructors) should follow.
bool too_deep(std::string_view text) {
  constexpr std::size_t max_depth = 128;
  std::size_t depth = 0;
  for (std::size_t at = 0; at < text.size();) {
    const char c = text[at];
    at = c == '"' ? skip_string(text, at) : at + 1;
    if ((c == '{' || c == '[') && ++depth > max_depth) return true;
    if (c == '}' || c == ']') --depth;
  }
  return false;
}

const JsonText& null_value() {
  static const JsonText value;
  return value;
}

std::string trimmed(const std::string& text) {
  std::size_t end = text.size();
  while (end > 0 && is_space(text[end - 1])) --end;
  return text.substr(skip_space(text, 0), end - std::min(end, skip_space(text, 0)));
}

}  // namespace

JsonText::JsonText(const ordered_json& value)
    : raw_(value.dump(-1, ' ', false, ordered_json::error_handler_t::replace)) {}

Result<JsonText> JsonText::parse(std::string_view text) {
  if (!ordered_json::accept(text.begin(), text.end())) {
    return Error{"edit/apply_json", "", "this is not valid JSON", "check that the file is complete"};
  }
  if (too_deep(text)) {
    return Error{"edit/apply_json", "", "the JSON is nested deeper than 128 levels", "simplify its extras"};
  }
  JsonText value;
  value.raw_ = std::string(text.substr(text.substr(0, 3) == "\xEF\xBB\xBF" ? 3 : 0));
  return value;
}

char JsonText::first() const {
  const std::string& text = split_ ? open_ : raw_;
  const std::size_t at = skip_space(text, 0);
  return at < text.size() ? text[at] : '\0';
}

const std::vector<JsonText::Member>& JsonText::members() const {
  if (split_ || (first() != '{' && first() != '[')) return members_;
  split_ = true;
  const std::string text = std::move(raw_);
  raw_.clear();
  const bool object = text[skip_space(text, 0)] == '{';
  std::size_t at = skip_space(text, 0) + 1;
  open_ = text.substr(0, at);
  for (;;) {
    Member member;
    std::size_t begin = at;
    at = skip_space(text, at);
    if (text[at] == '}' || text[at] == ']') {  // only reached in an empty container
      close_ = text.substr(begin);
      return members_;
    }
    member.before = text.substr(begin, at - begin);
    if (object) {
      begin = at;
      at = skip_string(text, at);
      member.key = text.substr(begin, at - begin);
      begin = at;
      at = skip_space(text, skip_space(text, at) + 1);
      member.colon = text.substr(begin, at - begin);
    }
    begin = at;
    at = skip_value(text, at);
    member.value.raw_ = text.substr(begin, at - begin);
    begin = at;
    at = skip_space(text, at);
    member.after = text.substr(begin, at - begin);
    members_.push_back(std::move(member));
    if (text[at] != ',') break;
    ++at;
  }
  close_ = text.substr(at);
  return members_;
}

std::vector<JsonText::Member>& JsonText::members() {
  static_cast<void>(std::as_const(*this).members());
  return members_;
}

std::string JsonText::text() const {
  if (!split_) return raw_;
  std::string out = open_;
  for (std::size_t i = 0; i < members_.size(); ++i) {
    const Member& member = members_[i];
    if (i > 0) out += ',';
    out += member.before + member.key + member.colon;
    out += member.value.text();
    out += member.after;
  }
  return out + close_;
}

std::size_t JsonText::size() const {
  return members().size();
}

std::optional<std::size_t> JsonText::position(std::string_view key) const {
  if (!is_object()) return std::nullopt;
  const std::vector<Member>& all = members();
  for (std::size_t i = all.size(); i-- > 0;) {
    if (key_is(all[i].key, key)) return i;
  }
  return std::nullopt;
}

const JsonText& JsonText::get(std::string_view key) const {
  const auto i = position(key);
  return i ? members()[*i].value : null_value();
}

const JsonText& JsonText::item(std::size_t i) const {
  return is_array() && i < size() ? members()[i].value : null_value();
}

std::string JsonText::key(std::size_t i) const {
  return is_object() && i < size() ? unescape(members()[i].key) : std::string();
}

const JsonText& JsonText::value(std::size_t i) const {
  PARSEL_ASSERT(i < size(), "index out of range");
  return members_[i].value;
}

JsonText* JsonText::find(std::string_view key) {
  const auto i = position(key);
  return i ? &members()[*i].value : nullptr;
}

JsonText* JsonText::find_item(std::size_t i) {
  return is_array() && i < size() ? &members()[i].value : nullptr;
}

std::optional<double> JsonText::number() const {
  const char c = first();
  if (split_ || (c != '-' && (c < '0' || c > '9'))) return std::nullopt;
  return std::strtod(raw_.c_str(), nullptr);
}

std::optional<std::size_t> JsonText::index() const {
  const auto value = number();
  // Exact in a double, and in size_t where that has 32 bits.
  constexpr double limit = sizeof(std::size_t) >= 8 ? 0x1p53 : 0xFFFFFFFFp0;
  if (!value || *value < 0 || *value > limit || *value != std::floor(*value)) return std::nullopt;
  return static_cast<std::size_t>(*value);
}

std::optional<bool> JsonText::boolean() const {
  if (first() == 't') return true;
  if (first() == 'f') return false;
  return std::nullopt;
}

std::optional<std::string> JsonText::string() const {
  if (first() != '"') return std::nullopt;
  return unescape(trimmed(raw_));
}

void JsonText::append(Member member) {
  std::vector<Member>& all = members();
  if (!all.empty()) {
    member.before = all.back().before;
    if (!member.key.empty()) member.colon = all.back().colon;
    member.after = std::move(all.back().after);
    all.back().after.clear();
  }
  all.push_back(std::move(member));
}

void JsonText::set(std::string_view key, JsonText value) {
  PARSEL_ASSERT(is_object(), "only an object has keys");
  if (const auto i = position(key)) {
    members()[*i].value = std::move(value);
    return;
  }
  Member member;
  member.key = ordered_json(key).dump();
  member.colon = ":";
  member.value = std::move(value);
  append(std::move(member));
}

void JsonText::erase(std::string_view key) {
  while (const auto i = position(key)) erase_at(*i);
}

void JsonText::push_back(JsonText value) {
  PARSEL_ASSERT(is_array(), "only an array has elements");
  Member member;
  member.value = std::move(value);
  append(std::move(member));
}

void JsonText::erase_at(std::size_t i) {
  std::vector<Member>& all = members();
  PARSEL_ASSERT(i < all.size(), "index out of range");
  if (i > 0 && i + 1 == all.size()) all[i - 1].after = std::move(all[i].after);
  all.erase(all.begin() + static_cast<std::ptrdiff_t>(i));
}

}  // namespace parsel::gltf
