#include "core/base/json.h"

#include <algorithm>

#include "core/base/text.h"

namespace parsel {

namespace {

using nlohmann::json;

std::string line_and_column(std::string_view text, std::size_t at) {
  const std::string_view before = text.substr(0, at);
  const auto line = 1 + std::count(before.begin(), before.end(), '\n');
  const std::size_t start = before.rfind('\n') + 1;  // 0 when there is none
  return "line " + std::to_string(line) + ", column " + std::to_string(1 + count_characters(before.substr(start)));
}

/// The library's text without its own tag, position and quotation: "unexpected end of input".
std::string cause_of(const json::parse_error& error) {
  const std::string what = error.what();
  std::string cause = "it is not JSON";
  if (const std::size_t said = what.rfind("; expected "); said != what.npos)
    cause += ", " + what.substr(said + 2) + " here";
  return printable(cause, 200);
}

}  // namespace

std::optional<JsonFault> json_limits_fault(std::string_view text, const JsonLimits& limits) {
  if (text.size() > limits.bytes) {
    return JsonFault{limits.bytes, "it is longer than " + std::to_string(limits.bytes) + " bytes"};
  }
  std::size_t depth = 0, values = 0;
  bool in_string = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (in_string) {
      if (c == '\\') ++i;
      if (c == '"') in_string = false;
      continue;
    }
    if (c == '"') in_string = true;
    if (c == '{' || c == '[') ++depth;
    if ((c == '}' || c == ']') && depth > 0) --depth;
    if (c == ',' || c == ':' || c == '{' || c == '[') ++values;
    if (depth > limits.depth) {
      return JsonFault{i, "it is nested deeper than " + std::to_string(limits.depth) + " levels"};
    }
    if (values > limits.values) return JsonFault{i, "it has more than " + std::to_string(limits.values) + " values"};
  }
  return std::nullopt;
}

Result<json> json_from_text(std::string_view text, const std::string& stage, const JsonLimits& limits) {
  if (const auto fault = json_limits_fault(text, limits)) {
    return Error{stage, line_and_column(text, fault->at), fault->cause, "make it smaller or flatter"};
  }
  try {
    return json::parse(text);
  } catch (const json::parse_error& error) {
    // The library counts the bytes that it has read, the wrong one included.
    const std::size_t at = std::min(error.byte == 0 ? 0 : error.byte - 1, text.size());
    return Error{stage, line_and_column(text, at), cause_of(error), "check it for missing commas and brackets"};
  } catch (const json::out_of_range& error) {  // a number such as 1e999
    return Error{stage, "", "it holds a number that is out of range", "write smaller numbers"};
  }
}

}  // namespace parsel
