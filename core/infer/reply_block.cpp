#include "core/infer/reply_block.h"

namespace parsel {

Error reply_refused(std::string place, std::string cause, std::string fix) {
  return {"infer/reply", std::move(place), std::move(cause), std::move(fix)};
}

const nlohmann::json& member(const nlohmann::json& block, std::initializer_list<const char*> names) {
  static const nlohmann::json none;
  for (const char* name : names) {
    if (const auto found = block.find(name); found != block.end() && !found->is_null()) return *found;
  }
  return none;
}

std::string lower_case(std::string text) {
  for (char& c : text) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  return text;
}

}  // namespace parsel
