#include "core/infer/json_block.h"

#include <algorithm>
#include <optional>
#include <string>

#include "core/base/json.h"

namespace parsel {

namespace {

using nlohmann::json;

bool is_blank(char c) {
  return c == ' ' || c == '\t' || c == '\n' || c == '\r';
}

bool is_word(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_';
}

/// One past the string that opens at `at`; the end of the text when it does not close.
std::size_t end_of_string(std::string_view text, std::size_t at) {
  for (++at; at < text.size() && text[at] != '"'; ++at) {
    if (text[at] == '\\') ++at;
  }
  return std::min(at + 1, text.size());
}

/// One past the comment that begins at `at`; `at` when none does.
std::size_t end_of_comment(std::string_view text, std::size_t at) {
  const std::string_view rest = text.substr(at);
  if (rest.starts_with("//") || rest.starts_with("#")) return std::min(text.find('\n', at), text.size());
  if (!rest.starts_with("/*")) return at;
  const std::size_t close = text.find("*/", at + 2);
  return close == text.npos ? text.size() : close + 2;
}

/// Strict JSON in place of what models write.
std::string cleaned(std::string_view text) {
  std::string out;
  for (std::size_t i = 0; i < text.size();) {
    if (text[i] == '"') {
      const std::size_t end = end_of_string(text, i);
      for (; i < end; ++i) out += static_cast<unsigned char>(text[i]) < 0x20 ? ' ' : text[i];
      continue;
    }
    if (const std::size_t end = end_of_comment(text, i); end > i) {
      i = end;
      continue;
    }
    if (is_word(text[i])) {
      std::size_t end = i;
      while (end < text.size() && is_word(text[end])) ++end;
      const std::string_view word = text.substr(i, end - i);
      out += word == "True" ? "true" : word == "False" ? "false" : word == "None" ? "null" : word;
      i = end;
      continue;
    }
    if (text[i] == '}' || text[i] == ']') {
      std::size_t last = out.size();
      while (last > 0 && is_blank(out[last - 1])) --last;
      if (last > 0 && out[last - 1] == ',') out.erase(last - 1);
    }
    out += text[i++];
  }
  return out;
}

std::optional<json> parsed(std::string_view text) {
  if (text.size() > ReplyLimits::block_bytes) return std::nullopt;
  JsonLimits limits;
  limits.depth = ReplyLimits::nesting;
  Result<json> value = json_from_text(cleaned(text), "infer/reply", limits);
  if (!value.ok()) return std::nullopt;
  return std::move(value).value();
}

struct Fenced {
  std::string_view content;
  bool closed = false;
};

std::vector<Fenced> fenced_blocks(std::string_view reply) {
  std::vector<Fenced> blocks;
  std::size_t start = reply.npos;  // of the content of the open block, if one is open
  for (std::size_t line = 0; line < reply.size();) {
    const std::size_t next = std::min(reply.find('\n', line), reply.size() - 1) + 1;
    std::string_view text = reply.substr(line, next - line);
    while (!text.empty() && is_blank(text.front())) text.remove_prefix(1);
    const bool fence = text.starts_with("```") || text.starts_with("~~~");
    if (fence && text.find(text.substr(0, 3), 3) == text.npos) {  // else a whole block on one line: bare_blocks()
      if (start != reply.npos) {
        blocks.push_back({reply.substr(start, line - start), true});
        start = reply.npos;
      } else {
        start = next;
      }
    } else if (start != reply.npos && text.find("```") != text.npos) {  // closed on the line of the JSON's end
      blocks.push_back({reply.substr(start, line + reply.substr(line).find("```") - start), true});
      start = reply.npos;
    }
    line = next;
  }
  if (start != reply.npos) blocks.push_back({reply.substr(start), false});
  return blocks;
}

enum class Ending { closed, none, cut };
/// Where the value that opens at `at` closes. Bounded by the limits, so that hostile text costs linear time.
std::pair<Ending, std::size_t> balanced(std::string_view text, std::size_t at) {
  const std::size_t limit = std::min(text.size(), at + ReplyLimits::block_bytes);
  int depth = 0;
  for (std::size_t i = at; i < limit;) {
    if (text[i] == '"') {
      i = end_of_string(text.substr(0, limit), i);
      continue;
    }
    if ((text[i] == '{' || text[i] == '[') && ++depth > ReplyLimits::nesting) return {Ending::none, i};
    if ((text[i] == '}' || text[i] == ']') && --depth == 0) return {Ending::closed, i + 1};
    ++i;
  }
  return {Ending::cut, limit};
}

/// Objects, and lists of objects, outside of each other; nothing at all when the text ends within one.
std::optional<std::vector<std::string_view>> bare_blocks(std::string_view reply) {
  std::vector<std::string_view> blocks;
  for (std::size_t i = 0; i < reply.size();) {
    bool opens = reply[i] == '{' || reply[i] == '[';
    if (opens) {
      const std::size_t inside = reply.find_first_not_of(" \t\r\n", i + 1);
      const char first = inside == reply.npos ? '\0' : reply[inside];
      opens = first == (reply[i] == '{' ? '"' : '{') || (reply[i] == '{' && first == '\0');
    }
    if (!opens) {
      ++i;
      continue;
    }
    const auto [ending, end] = balanced(reply, i);
    if (ending == Ending::cut) return std::nullopt;
    if (ending == Ending::closed) blocks.push_back(reply.substr(i, end - i));
    i = ending == Ending::closed ? end : i + 1;
  }
  return blocks;
}

}  // namespace

std::vector<json> json_blocks(std::string_view reply) {
  std::vector<json> values;
  if (reply.size() > ReplyLimits::text_bytes) return values;
  const std::vector<Fenced> fenced = fenced_blocks(reply);
  std::size_t looked_at = 0;
  for (auto block = fenced.rbegin(); block != fenced.rend() && looked_at < ReplyLimits::blocks; ++block, ++looked_at) {
    if (auto value = parsed(block->content)) {
      values.push_back(std::move(*value));
    } else if (!block->closed && block == fenced.rbegin() && !bare_blocks(block->content)) {
      return {};
    }
  }
  const auto bare = bare_blocks(reply);
  if (!bare) return values;
  for (auto block = bare->rbegin(); block != bare->rend() && looked_at < ReplyLimits::blocks; ++block, ++looked_at) {
    if (auto value = parsed(*block)) values.push_back(std::move(*value));
  }
  return values;
}

}  // namespace parsel
