// What the language model is asked about a CAD model: which kinds of such a thing there are, and what its parts measure
// in one of them (ReparamCAD §3.2, where a diffusion model's pictures say so).
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <span>
#include <string>
#include <string_view>

#include "core/base/result.h"
#include "core/cad/model.h"

namespace parsel {

/// A task whose template is prompts/<name>.md, beside those about shapes (core/infer/task.h).
struct CadTask {
  std::string_view name;
  std::string_view words;   ///< what it asks for, for people
  bool about_kind = false;  ///< asked about one kind of the thing; else about all
};

extern const CadTask kinds_task, variation_task;
std::span<const CadTask* const> all_cad_tasks();
/// Null when there is none.
const CadTask* find_cad_task(std::string_view name);

struct CadWish {
  std::string kind;  ///< for a task about one: UTF-8, not blank, at most VariationLimits::name_bytes; else empty
  int count = 0;     ///< how many kinds, 1 to most_kinds; 0: usual_kinds
};

struct CadPrompt {
  const CadTask* task = nullptr;
  std::string text;
  std::string hash;     ///< SHA-256 of the text, in hex
  std::string version;  ///< of the template
};

/// Refuses a kind that is blank, too long or not asked for, and a model with more parts than a family may have.
Result<CadPrompt> make_prompt(const cad::Model& model, const CadTask& task, const CadWish& wish);

/// {"task", "text", "hash", "version"}
nlohmann::json to_json(const CadPrompt& prompt);

}  // namespace parsel
