// The files of prompts/, compiled in: CMakeLists.txt writes prompt_texts.cpp from them.
#pragma once

#include <array>
#include <string_view>

namespace parsel {

struct PromptText {
  std::string_view markdown;
  std::string_view schema;
};

/// In the order of all_tasks.
extern const std::array<PromptText, 4> prompt_texts;

}  // namespace parsel
