// The files of prompts/ and the lists of words beside this header, compiled in: CMakeLists.txt writes prompt_texts.cpp
// from them.
#pragma once

#include <span>
#include <string_view>

namespace parsel {

struct PromptText {
  std::string_view task;  ///< the files' name
  std::string_view markdown;
  std::string_view schema;
};

std::span<const PromptText> prompt_texts();

/// The JSON of every words/<language>.json.
std::span<const std::string_view> word_list_texts();

}  // namespace parsel
