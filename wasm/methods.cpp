#include "wasm/methods.h"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <optional>
#include <stdexcept>

#include "core/amount/amount.h"
#include "core/check/check.h"
#include "core/export/sliders.h"
#include "core/gallery/gallery.h"
#include "core/infer/inference_json.h"
#include "core/infer/plain_offers.h"
#include "core/infer/plain_reading.h"
#include "core/infer/prompt.h"
#include "core/infer/proposals.h"
#include "core/infer/task_list.h"
#include "core/propagate/clean.h"
#include "core/propagate/compose.h"
#include "core/propagate/propagate.h"
#include "core/propagate/solve.h"
#include "core/prove/clearance.h"
#include "core/prove/stack.h"
#include "core/prove/together.h"
#include "core/shape/abstraction.h"
#include "core/split/split.h"

namespace parsel::wasm {

using nlohmann::json;

namespace {

/// The model that the page has open, and the file it came from. The page opens it again in a new worker.
struct OpenModel {
  Shape shape;
  std::string file;
  ExternalBuffers external;
};
std::optional<OpenModel> model;

Error no_model() {
  return {"wasm", "", "no model is open", "open one first"};
}

Error wrong_parameter(const std::string& name, const std::string& expected) {
  return {"wasm", name, "it is not " + expected, "please report this: page and core disagree"};
}

Result<std::string> text_parameter(const Input& input, const std::string& name) {
  const auto found = input.parameters.find(name);
  if (found == input.parameters.end() || !found->is_string()) return wrong_parameter(name, "a text");
  return found->get<std::string>();
}

/// program: parsel/program v1 that fits the open model.
Result<Program> program_of(const Input& input) {
  if (!model) return no_model();
  Result<Program> program = program_from_json(input.parameters.value("program", json()));
  if (!program.ok()) return program;
  if (const Status valid = validate(*program, model->shape); !valid.ok()) return valid.error();
  return program;
}

Result<Output> version(const Input&) {
  return Output{{{"version", PARSEL_VERSION}}, {}};
}

json solutions(const std::string& equation, const std::string& unknown) {
  json texts = json::array();
  const Result<Amount> parsed = parse_amount(equation);
  PARSEL_ASSERT(parsed.ok(), "the caller checked the equation");
  for (const GiNaC::ex& root : solve_for(parsed->expression(), parameter_symbol(unknown)).roots) {
    texts.push_back(Amount(root).text());
  }
  return texts;
}

Result<Output> warm_up(const Input&) {
  for (int round = 0; round < 20; ++round) {
    solutions("2*y - x", "y");
    solutions("3*cos(y) + 4*sin(y) - x", "y");
  }
  return Output{json::object(), {}};
}

Result<Output> solve(const Input& input) {
  const Result<std::string> equation = text_parameter(input, "equation");
  if (!equation.ok()) return equation.error();
  const Result<std::string> unknown = text_parameter(input, "unknown");
  if (!unknown.ok()) return unknown.error();
  const Result<Amount> parsed = parse_amount(*equation);
  if (!parsed.ok()) return parsed.error();
  const Result<Amount> name = parse_amount(*unknown);
  if (!name.ok() || name->parameters() != std::vector<std::string>{*unknown}) {
    return wrong_parameter("unknown", "the name of a parameter");
  }
  return Output{{{"solutions", solutions(*equation, *unknown)}}, {}};
}

/// buffers = the file, then the external buffers that `external` names, in its order. labels: see abstract_shape(); so corrections,
/// as in corrections_from_json().
Result<Output> open(const Input& input) {
  const Result<std::string> name = text_parameter(input, "name");
  if (!name.ok()) return name.error();
  const json names = input.parameters.value("external", json());
  if (!names.is_array() || input.buffers.size() != names.size() + 1) {
    return wrong_parameter("external", "a name for each buffer after the first");
  }
  ExternalBuffers external;
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (!names[i].is_string()) return wrong_parameter("external", "a list of names");
    external[names[i].get<std::string>()] = input.buffers[i + 1];
  }
  Labels labels;
  const json given = input.parameters.value("labels", json::object());
  if (!given.is_object()) return wrong_parameter("labels", "labels by part");
  for (const auto& [key, label] : given.items()) {
    if (!label.is_string()) return wrong_parameter("labels", "labels by part");
    labels[key] = label.get<std::string>();
  }
  const Result<Corrections> corrections = corrections_from_json(input.parameters.value("corrections", json::array()));
  if (!corrections.ok()) return corrections.error();
  Result<Abstraction> abstraction = abstract_shape(input.buffers[0], *name, external, labels, *corrections);
  if (!abstraction.ok()) return abstraction.error();  // the open model stays
  model = OpenModel{std::move(abstraction->shape), input.buffers[0], std::move(external)};
  return Output{{{"shape", to_json(model->shape)}}, {}};
}

/// by: a method of splitting; fine: from 0 to 1. The open model stays what it is.
Result<Output> split(const Input& input) {
  if (!model) return no_model();
  const Result<std::string> by = text_parameter(input, "by");
  if (!by.ok()) return by.error();
  const auto method = split_method(*by);
  if (!method) return wrong_parameter("by", "auto, components, materials or regions");
  const json fine = input.parameters.value("fine", json());
  if (!fine.is_number()) return wrong_parameter("fine", "a number");
  Result<SplitModel> made = split_model(model->file, model->external, {*method, fine.get<double>()}, input.progress);
  if (!made.ok()) return made.error();
  json result = {{"by", to_string(made->by)},
                 {"before", made->before},
                 {"parts", made->parts},
                 {"joined", made->joined},
                 {"warnings", json::array()}};
  for (const Warning& warning : made->warnings)
    result["warnings"].push_back({{"place", warning.place}, {"text", warning.text}});
  return Output{std::move(result), {std::move(made->glb)}};
}

/// fine: from 0 to 1. What each way would tell apart; nothing is split.
Result<Output> ways_to_split(const Input& input) {
  if (!model) return no_model();
  const json fine = input.parameters.value("fine", json());
  if (!fine.is_number()) return wrong_parameter("fine", "a number");
  const Result<SplitWays> found = split_ways(model->file, model->external, fine.get<double>(), input.progress);
  if (!found.ok()) return found.error();
  json ways = json::array();
  for (const SplitWay& way : found->ways)
    ways.push_back({{"by", to_string(way.by)}, {"parts", way.parts}, {"too_many", way.too_many}});
  return Output{{{"before", found->before}, {"ways", std::move(ways)}}, {}};
}

/// edit: parsel/edit v1.
Result<Output> propagate_edit(const Input& input) {
  if (!model) return no_model();
  const Result<EditRequest> request = edit_request_from_json(input.parameters.value("edit", json()));
  if (!request.ok()) return request.error();
  const Result<Propagation> found = propagate(model->shape, *request, {}, input.progress);
  if (!found.ok()) return found.error();
  return Output{{{"program", to_json(found->program)}, {"trace", to_json(found->trace)}}, {}};
}

/// What geometry and labels offer of the open model.
Result<Output> offers(const Input&) {
  if (!model) return no_model();
  return Output{{{"offers", to_json(plain_offers(model->shape))}}, {}};
}

/// edit: parsel/edit v1. As propagate, but refused unless it is clean, over a range cut to where it is, and passes the
/// checker.
Result<Output> propagate_clean(const Input& input) {
  if (!model) return no_model();
  const Result<EditRequest> request = edit_request_from_json(input.parameters.value("edit", json()));
  if (!request.ok()) return request.error();
  const Result<Propagation> found = propagate_cleanly(model->shape, *request, {}, input.progress);
  if (!found.ok()) return found.error();
  const CheckReport report = check_program(model->shape, found->program);
  if (!report.accepted()) {
    const Finding& first = report.findings.front();
    return Error{"check", first.place, first.text, first.fix};
  }
  return Output{{{"program", to_json(found->program)}, {"trace", to_json(found->trace)}}, {}};
}

/// program: parsel/program v1; layer: an index; to: a value of its parameter.
Result<Output> extend(const Input& input) {
  Result<Program> program = program_of(input);
  if (!program.ok()) return program.error();
  const json layer = input.parameters.value("layer", json()), to = input.parameters.value("to", json());
  if (!layer.is_number_unsigned() || layer.get<std::size_t>() >= program->layers.size())
    return wrong_parameter("layer", "the index of a layer");
  if (!to.is_number()) return wrong_parameter("to", "a number");
  extend_range(model->shape, *program, layer.get<std::size_t>(), to.get<double>());
  return Output{{{"program", to_json(*program)}}, {}};
}

/// program: parsel/program v1; layer: an index.
Result<Output> seen(const Input& input) {
  const Result<Program> program = program_of(input);
  if (!program.ok()) return program.error();
  const json layer = input.parameters.value("layer", json());
  if (!layer.is_number_unsigned() || layer.get<std::size_t>() >= program->layers.size())
    return wrong_parameter("layer", "the index of a layer");
  return Output{{{"faults", to_json(seen_faults(model->shape, *program, layer.get<std::size_t>()))}}, {}};
}

/// See program_of(); first: the number of the first layer that is composed onto those before it.
Result<Output> compose_layers(const Input& input) {
  const Result<Program> program = program_of(input);
  if (!program.ok()) return program.error();
  const json first = input.parameters.value("first", json());
  if (!first.is_number_unsigned()) return wrong_parameter("first", "a whole number");
  return Output{{{"program", to_json(compose(model->shape, *program, first.get<std::size_t>()))}}, {}};
}

/// See program_of(); every layer's slider stands at its value.
Result<Output> judge(const Input& input) {
  const Result<Program> program = program_of(input);
  if (!program.ok()) return program.error();
  return Output{to_json(judge_stack(model->shape, *program)), {}};
}

/// program: parsel/program v1; values: one a layer; animate: a parameter's name, or morph: true, for a morph target of
/// every slider, or repair: true, with what is pulled apart closed; only: ids of parts.
Result<Output> apply(const Input& input) {
  const Result<Program> program = program_of(input);
  if (!program.ok()) return program.error();
  std::vector<double> values;
  for (const json& value : input.parameters.value("values", json::array())) {
    if (!value.is_number()) return wrong_parameter("values", "a list of numbers");
    values.push_back(value.get<double>());
  }
  std::optional<Animate> animate;
  if (input.parameters.contains("animate")) {
    const Result<std::string> parameter = text_parameter(input, "animate");
    if (!parameter.ok()) return parameter.error();
    animate = Animate{*parameter};
  }
  const json wanted = input.parameters.value("morph", json(false));
  if (!wanted.is_boolean()) return wrong_parameter("morph", "true or false");
  const bool morph = wanted.get<bool>();
  if (morph && animate) return wrong_parameter("morph", "false beside animate");
  const json repair = input.parameters.value("repair", json(false));
  if (!repair.is_boolean()) return wrong_parameter("repair", "true or false");
  if (repair.get<bool>() && (morph || animate)) return wrong_parameter("repair", "false beside animate and morph");
  ApplyOptions options;
  options.repair = repair.get<bool>();
  options.external = model->external;
  for (const json& id : input.parameters.value("only", json::array())) {
    const auto part = id.is_string() ? model->shape.find_part(id.get<std::string>()) : std::nullopt;
    if (!part) return wrong_parameter("only", "a list of parts of the model");
    options.only_parts.push_back(*part);
  }
  json result = json::object();
  Applied out;
  if (morph) {
    Result<SlidersApplied> made = apply_sliders(model->file, model->shape, *program, values, std::move(options));
    if (!made.ok()) return made.error();
    result = to_json(*made);
    out = std::move(made->applied);
  } else {
    Result<Applied> applied = apply_program(model->file, model->shape, *program, values, animate, std::move(options));
    if (!applied.ok()) return applied.error();
    out = std::move(*applied);
    if (repair.get<bool>()) result["gaps"] = to_json(model->shape, out.gaps);
  }
  result["warnings"] = json::array();
  for (const Warning& warning : out.warnings)
    result["warnings"].push_back({{"place", warning.place}, {"text", warning.text}});
  return Output{std::move(result), {std::move(out.glb)}};
}

/// program: parsel/program v1; count; seed: a number that a double holds exactly.
Result<Output> siblings(const Input& input) {
  const Result<Program> program = program_of(input);
  if (!program.ok()) return program.error();
  const json count = input.parameters.value("count", json()), seed = input.parameters.value("seed", json());
  if (!count.is_number_integer()) return wrong_parameter("count", "a whole number");
  if (!seed.is_number_unsigned()) return wrong_parameter("seed", "a whole number");
  const auto wanted = static_cast<int>(std::clamp<std::int64_t>(count.get<std::int64_t>(), 0, most_siblings + 1));
  const Result<Siblings> drawn = draw_siblings(model->shape, *program, wanted, seed.get<std::uint64_t>());
  if (!drawn.ok()) return drawn.error();
  return Output{to_json(*drawn), {}};
}

/// Every model of the gallery: one buffer each, in the order of the list.
Result<Output> gallery(const Input&) {
  Output output{{{"models", json::array()}}, {}};
  for (const GalleryModel& entry : gallery_models()) {
    Result<GalleryAsset> asset = build(entry);
    if (!asset.ok()) return asset.error();
    output.result["models"].push_back(gallery_entry(entry, *asset));
    output.buffers.push_back(std::move(asset->glb));
  }
  return output;
}

/// request: a text; mentioned: ids of parts.
Result<EditWish> wish_of(const Input& input) {
  EditWish wish;
  const Result<std::string> request = text_parameter(input, "request");
  if (!request.ok()) return request.error();
  wish.request = *request;
  for (const json& id : input.parameters.value("mentioned", json::array())) {
    if (!id.is_string()) return wrong_parameter("mentioned", "a list of parts of the model");
    wish.mentioned.push_back(id.get<std::string>());
  }
  return wish;
}

/// See wish_of().
Result<Output> read_wish_plainly(const Input& input) {
  if (!model) return no_model();
  const Result<EditWish> wish = wish_of(input);
  if (!wish.ok()) return wish.error();
  const Result<PlainReading> reading = read_plainly(model->shape, *wish);
  if (!reading.ok()) return reading.error();
  return Output{to_json(model->shape, *reading), {}};
}

/// See wish_of().
Result<Output> prompts(const Input& input) {
  if (!model) return no_model();
  const Result<EditWish> wish = wish_of(input);
  if (!wish.ok()) return wish.error();
  const Result<std::vector<Prompt>> made = make_prompts(model->shape, *wish);
  if (!made.ok()) return made.error();
  json list = json::array(), tasks = json::object();
  for (const Prompt& prompt : *made) list.push_back(to_json(model->shape, prompt));
  for (const Task* task : all_tasks()) {
    if (task->is_alone()) continue;
    tasks[std::string(task->name)] = {{"words", task->words}, {"schema", reply_schema(*task)}};
  }
  return Output{{{"prompts", std::move(list)}, {"tasks", std::move(tasks)}}, {}};
}

/// task: the name of one that is asked on its own; request (empty for a task about the model alone) and mentioned as in
/// wish_of(); count; picture: whether one goes along.
Result<Output> proposal_prompt(const Input& input) {
  if (!model) return no_model();
  const Result<std::string> name = text_parameter(input, "task");
  if (!name.ok()) return name.error();
  const Task* task = find_task(*name);
  if (task == nullptr || !task->is_alone()) return wrong_parameter("task", "a task that is asked on its own");
  Result<EditWish> wish = wish_of(input);
  if (!wish.ok()) return wish.error();
  const json count = input.parameters.value("count", json()), picture = input.parameters.value("picture", json());
  if (!count.is_number_integer() || !picture.is_boolean()) return wrong_parameter("count", "a whole number");
  wish->count = static_cast<int>(std::clamp<std::int64_t>(count.get<std::int64_t>(), 0, most_proposals + 1));
  wish->picture = picture.get<bool>();
  const Result<Prompt> made = make_prompt(model->shape, *wish, *task);
  if (!made.ok()) return made.error();
  json numbered = json::array();
  for (const PartIndex part : numbered_parts(model->shape, *task)) numbered.push_back(model->shape.parts[part].id);
  return Output{{{"prompt", to_json(model->shape, *made)},
                 {"words", task->words},
                 {"schema", reply_schema(*task)},
                 {"numbered", std::move(numbered)}},
                {}};
}

/// replies: for each prompt the texts that the language model gave.
Result<Output> read_replies(const Input& input) {
  if (!model) return no_model();
  const Result<std::vector<Replies>> replies =
      replies_from_json(model->shape, input.parameters.value("replies", json()));
  if (!replies.ok()) return replies.error();
  return Output{to_json(model->shape, infer(model->shape, *replies)), {}};
}

/// Bytes of linear memory: it grows and never shrinks, so this is the peak as well.
Result<Output> memory(const Input&) {
#ifdef __wasm__
  return Output{{{"bytes", __builtin_wasm_memory_size(0) * 65536.0}}, {}};
#else
  return Error{"wasm", "memory", "only WebAssembly knows its memory", "ask the operating system"};
#endif
}

/// Goes wrong on purpose, in the way that is asked for: how the page's recovery is tested.
Result<Output> fail(const Input& input) {
  const Result<std::string> kind = text_parameter(input, "kind");
  if (!kind.ok()) return kind.error();
  if (*kind == "exception") throw std::runtime_error("asked to fail");
  if (*kind == "abort") std::abort();
  if (*kind == "memory") {
    std::vector<std::string> blocks;
    for (;;) blocks.emplace_back(std::size_t{1} << 28, 'x');
  }
  if (*kind == "hang") {
    for (volatile int forever = 0;; forever = forever + 1) {
    }
  }
  return wrong_parameter("kind", "exception, abort, memory or hang");
}

constexpr std::array all_methods = {
    Method{"version", version},
    Method{"warm_up", warm_up},
    Method{"solve", solve},
    Method{"open", open},
    Method{"split", split},
    Method{"split_ways", ways_to_split},
    Method{"propagate", propagate_edit},
    Method{"offers", offers},
    Method{"propagate_clean", propagate_clean},
    Method{"extend", extend},
    Method{"apply", apply},
    Method{"siblings", siblings},
    Method{"compose", compose_layers},
    Method{"judge", judge},
    Method{"seen", seen},
    Method{"gallery", gallery},
    Method{"read_plainly", read_wish_plainly},
    Method{"prompts", prompts},
    Method{"proposal_prompt", proposal_prompt},
    Method{"read_replies", read_replies},
    Method{"memory", memory},
    Method{"fail", fail},
};

}  // namespace

std::span<const Method> methods() {
  return all_methods;
}

}  // namespace parsel::wasm
