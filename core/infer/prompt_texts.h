// The files of prompts/, compiled in: CMakeLists.txt writes prompt_texts.cpp from them.
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

}  // namespace parsel
