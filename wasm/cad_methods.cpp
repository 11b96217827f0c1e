// What the page can ask about CAD programs and their families. No state: every call brings its program.
#include <algorithm>
#include <array>

#include "core/base/sha256.h"
#include "core/cad/cad_mesh.h"
#include "core/cad/scad_flatten.h"
#include "core/family/family.h"
#include "core/family/family_program.h"
#include "core/family/family_scad.h"
#include "core/gallery/programs.h"
#include "core/infer/cad_task.h"
#include "core/infer/prompt.h"
#include "core/infer/variation_reply.h"
#include "wasm/methods.h"

namespace parsel::wasm {

using family::Family;
using nlohmann::json;

namespace {

Error not_as_agreed(const std::string& name, const std::string& expected) {
  return {"wasm", name, "it is not " + expected, "please report this: page and core disagree"};
}

Result<family::Choices> choices_of(const json& given) {
  if (!given.is_object()) return not_as_agreed("choices", "choices by constraint");
  family::Choices choices;
  for (const auto& [id, choice] : given.items()) {
    if (choice != "forced" && choice != "off") return not_as_agreed("choices", "forced or off for each");
    choices[id] = choice == "forced" ? family::Choice::forced : family::Choice::off;
  }
  return choices;
}

Result<Family> family_of(const json& parameters) {
  Result<cad::Model> model = cad::model_from_json(parameters.value("cad", json()));
  if (!model.ok()) return model.error();
  family::Options options;
  options.vocabulary = family::Vocabulary::extended;
  Result<family::Choices> choices = choices_of(parameters.value("choices", json::object()));
  if (!choices.ok()) return choices.error();
  options.choices = std::move(*choices);
  std::vector<family::Variation> variations;
  if (const json given = parameters.value("variations", json()); !given.is_null()) {
    auto read = family::variations_from_json(given, family::layout_of(*model, options.vocabulary), *model);
    if (!read.ok()) return read.error();
    variations = std::move(*read);
  }
  return make_family(*model, std::move(variations), options);
}

json bounds_json(const Family& family) {
  json list = json::array();
  for (const family::Bound& bound : family.bounds) {
    json pairs = json::array();
    for (const auto& [a, b] : bound.parts)
      pairs.push_back(json::array({family.model.parts[a].id, family.model.parts[b].id}));
    list.push_back({{"form", std::vector<double>(bound.form.data(), bound.form.data() + bound.form.size())},
                    {"constant", bound.constant},
                    {"text", stop_text(family, bound.stop)},
                    {"parts", std::move(pairs)}});
  }
  return list;
}

/// A variation as it lies in the family, with the parts that it has.
cad::Model shown_model(const Family& family, std::size_t variation) {
  cad::Model model = family.at(family.settings[variation]);
  std::size_t p = 0;
  std::erase_if(model.parts, [&](const cad::Part&) { return !family.variations[variation].has(p++); });
  return model;
}

/// name; buffers = the OpenSCAD text. Answers {cad: parsel/cad, warnings: [text], parts: [{id, name, stem}]} and the
/// GLB.
Result<Output> open_cad(const Input& input) {
  const json name = input.parameters.value("name", json());
  if (!name.is_string() || input.buffers.size() != 1) return not_as_agreed("name", "a text, and one file with it");
  const Result<cad::Model> model = cad::read_scad(input.buffers[0], name.get<std::string>());
  if (!model.ok()) return model.error();
  json warnings = json::array(), parts = json::array();
  for (const cad::Notice& notice : model->warnings) {
    warnings.push_back((notice.place.line > 0 ? to_string(notice.place) + ": " : "") + notice.text);
  }
  for (const cad::Part& part : model->parts) {
    parts.push_back({{"id", part.id}, {"name", part.name}, {"stem", stem(part)}, {"role", to_string(part.role)}});
  }
  return Output{{{"cad", to_json(*model)}, {"warnings", std::move(warnings)}, {"parts", std::move(parts)}},
                {cad::to_glb(*model)}};
}

/// cad: parsel/cad; variations: parsel/variations, or null for none; choices: {constraint id: "forced"|"off"}. Answers
/// the family, its program (lengths in half-diagonals of the drawn model, `scale` units each), what the sliders are
/// bounded by, and one GLB a variation with the parts that it has.
Result<Output> find_family(const Input& input) {
  const Result<Family> family = family_of(input.parameters);
  if (!family.ok()) return family.error();
  const Result<Program> program =
      family::family_program(*family, family->model.name, sha256_hex(cad::to_glb(family->model)));
  if (!program.ok()) return program.error();
  json values = json::object();
  for (std::size_t i = 0; i < family->layout.size(); ++i) {
    values[family->layout.parameters[i].name] = family->base[static_cast<Eigen::Index>(i)];
  }
  Output output{{{"family", to_json(*family)},
                 {"program", to_json(*program)},
                 {"values", std::move(values)},
                 {"bounds", bounds_json(*family)},
                 {"scale", family::drawn_frame(family->model).scale},
                 {"metres", cad::metres(family->model)}},
                {}};
  for (std::size_t v = 0; v < family->variations.size(); ++v) {
    output.buffers.push_back(cad::to_glb(shown_model(*family, v)));
  }
  return output;
}

/// As find_family, and setting: one value a slider, in the model's unit; with: one true or false an optional group.
/// Answers the OpenSCAD text that begins there, and the Customizer's parameter sets.
Result<Output> family_text(const Input& input) {
  const Result<Family> family = family_of(input.parameters);
  if (!family.ok()) return family.error();
  const json setting = input.parameters.value("setting", json()), with = input.parameters.value("with", json());
  if (!setting.is_array() || setting.size() != family->sliders.size() ||
      !std::all_of(setting.begin(), setting.end(), [](const json& value) { return value.is_number(); })) {
    return not_as_agreed("setting", "a number for each slider");
  }
  if (!with.is_array() || with.size() != family->optional.size() ||
      !std::all_of(with.begin(), with.end(), [](const json& value) { return value.is_boolean(); })) {
    return not_as_agreed("with", "true or false for each optional group");
  }
  family::Shown shown{Eigen::VectorXd(static_cast<Eigen::Index>(setting.size())), with.get<std::vector<bool>>()};
  for (std::size_t k = 0; k < setting.size(); ++k) shown.setting[static_cast<Eigen::Index>(k)] = setting[k];
  return Output{{{"scad", family_scad(*family, shown)}, {"sets", parameter_sets(*family)}}, {}};
}

struct Asked {
  cad::Model model;
  const CadTask* task;
  std::string kind;
};

Result<Asked> asked_of(const json& parameters) {
  Result<cad::Model> model = cad::model_from_json(parameters.value("cad", json()));
  if (!model.ok()) return model.error();
  const json task = parameters.value("task", json()), kind = parameters.value("kind", json());
  const CadTask* known = task.is_string() ? find_cad_task(task.get_ref<const std::string&>()) : nullptr;
  if (known == nullptr) return not_as_agreed("task", "a task about a CAD program");
  if (!kind.is_string()) return not_as_agreed("kind", "a text");
  return Asked{std::move(*model), known, kind.get<std::string>()};
}

/// cad; task: kinds or variation; kind: which one, for variation, else empty; count: of kinds, 0 as many as usual.
/// Answers {prompt: {task, text, hash, version}, words, schema}.
Result<Output> cad_prompt(const Input& input) {
  const Result<Asked> asked = asked_of(input.parameters);
  if (!asked.ok()) return asked.error();
  const json count = input.parameters.value("count", json());
  if (!count.is_number_integer()) return not_as_agreed("count", "a whole number");
  const auto wanted = static_cast<int>(std::clamp<std::int64_t>(count.get<std::int64_t>(), -1, 1000));
  const Result<CadPrompt> prompt = make_prompt(asked->model, *asked->task, {asked->kind, wanted});
  if (!prompt.ok()) return prompt.error();
  return Output{
      {{"prompt", to_json(*prompt)}, {"words", asked->task->words}, {"schema", reply_schema(asked->task->name)}}, {}};
}

/// cad, task and kind as for cad_prompt; texts: the replies. Answers what they mean, counted:
/// core/infer/variation_reply.h.
Result<Output> read_cad_replies(const Input& input) {
  const Result<Asked> asked = asked_of(input.parameters);
  if (!asked.ok()) return asked.error();
  std::vector<std::string> texts;
  for (const json& text : input.parameters.value("texts", json::array())) {
    if (!text.is_string()) return not_as_agreed("texts", "a list of texts");
    texts.push_back(text.get<std::string>());
  }
  const Result<json> read =
      asked->task->about_kind ? read_variation(asked->model, asked->kind, texts) : read_kinds(asked->model, texts);
  if (!read.ok()) return read.error();
  return Output{*read, {}};
}

/// The gallery's CAD programs: [{id}], and their texts and variations as buffers, two each.
Result<Output> cad_gallery(const Input&) {
  Output output{{{"programs", json::array()}}, {}};
  for (const GalleryProgram& program : gallery_programs()) {
    output.result["programs"].push_back({{"id", program.id}});
    output.buffers.emplace_back(program.scad);
    output.buffers.emplace_back(program.variations);
  }
  return output;
}

constexpr std::array all_methods = {
    Method{"open_cad", open_cad},     Method{"find_family", find_family},           Method{"family_text", family_text},
    Method{"cad_prompt", cad_prompt}, Method{"read_cad_replies", read_cad_replies}, Method{"cad_gallery", cad_gallery},
};

}  // namespace

std::span<const Method> methods() {
  return all_methods;
}

}  // namespace parsel::wasm
