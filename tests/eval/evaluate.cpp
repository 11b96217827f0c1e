// Runs the core over a folder of models and writes down what became of every edit.
//   parsel_eval MODELS -o OUTPUT [--edits EDITS.json] [--only TEXT] [--seconds S]
// MODELS: GLBs. EDITS.json: {"model": [{"name", "edit": parsel/edit}]}, model being the file's name without extension;
// models that it does not name get automatic_edits(). --only: models whose name contains TEXT. --seconds: limit for
// each stage of an edit, and for abstraction (default 30).
//
// OUTPUT gets programs/MODEL/EDIT.json and results.jsonl, a line for every model
//   {"kind":"model","model","parts","relations","active_parts","contacts","warnings":[…],"ms":{"abstraction","gauge"},
//    "failure"}
// and for every edit
//   {"kind":"edit","model","edit","seed","parts","relations","statements","why":{"seed":n,…},"range":[min,max],
//    "held","broken","disabled","certified","worst_held","left_broken":[ids],"findings":[…],"ms":{stage: n},"peak_mb",
//    "ends":[{"x","least_jacobian","least_jacobian_of","overlap","gap","overlaps":[…],"gaps":[…],"glb_bytes"}],
//    "failure":{"stage","cause"} or null}
// overlaps and gaps: [{"a","b","amount","tie"}], see measure.h and tie_of().
// relations: those that touch what moves. breaking edits: why.breaking. ms: processor time. peak_mb: of the model's
// process so far. A crash, a stage over its limit, a number that is not finite, an inverted cell, a program that does
// not pass validate(), a finding of the checker and a written GLB that does not read back are failures.
#include <sys/resource.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <sstream>

#include "core/check/check.h"
#include "core/export/apply.h"
#include "core/propagate/propagate.h"
#include "core/shape/gltf_import.h"
#include "tests/eval/isolate.h"
#include "tests/eval/measure.h"
#include "tests/eval/seeds.h"

using namespace parsel;
using namespace parsel::eval;
using nlohmann::json;
namespace fs = std::filesystem;

namespace {

struct Options {
  fs::path models, output, edits;
  std::string only;
  double seconds = 30;
};

[[noreturn]] void refuse(const std::string& message) {
  std::cerr << message << '\n';
  std::exit(2);
}

std::string read(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) refuse(path.string() + " cannot be read");
  std::ostringstream bytes;
  bytes << file.rdbuf();
  return bytes.str();
}

/// Names and messages come from files and need not be UTF-8.
std::string line_of(const json& value) {
  return value.dump(-1, ' ', false, json::error_handler_t::replace);
}

double peak_mb() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024;
}

/// What the program says of the attachment of two parts, or of the groups that they are instances of: "held", "broken",
/// "disabled"; "inactive" for an attachment that does not count, as a group stands for its instances; "group" for two
/// instances of one without any; "none" when nothing ties them.
std::string tie_of(const Shape& shape, const Layer& layer, PartIndex a, PartIndex b) {
  const auto stands_for = [&](PartIndex candidate, PartIndex part) {
    return candidate == part || (shape.parts[part].group && shape.parts[candidate].is_virtual() &&
                                 shape.parts[candidate].group == shape.parts[part].group);
  };
  std::string tie = shape.parts[a].group && shape.parts[a].group == shape.parts[b].group ? "group" : "none";
  for (const Relation& relation : shape.relations) {
    if (!relation.is_attachment()) continue;
    const PartIndex p = relation.parts[0], q = relation.parts[1];
    if (!((stands_for(p, a) && stands_for(q, b)) || (stands_for(p, b) && stands_for(q, a)))) continue;
    const auto report = std::find_if(layer.relations.begin(), layer.relations.end(),
                                     [&](const RelationReport& r) { return r.id == relation.id; });
    if (report != layer.relations.end()) return std::string(to_string(report->status));
    tie = "inactive";
  }
  return tie;
}

json to_json(const std::vector<PairOfParts>& pairs, const Shape& shape, const Layer& layer) {
  json list = json::array();
  for (const auto& [a, b, amount] : pairs) {
    const std::string tie = tie_of(shape, layer, *shape.find_part(a), *shape.find_part(b));
    list.push_back({{"a", a}, {"b", b}, {"amount", amount}, {"tie", tie}});
  }
  return list;
}

/// Why what apply wrote is not what it should be, or nothing.
std::optional<std::string> fault_of(const std::string& glb, const Abstraction& abstraction, bool count_changed) {
  const auto again = import_gltf(glb);
  if (!again.ok()) return "the written file is refused: " + again.error().message();
  if (!count_changed && again->meshes.size() != abstraction.meshes.size()) return "the written file has other parts";
  for (const PartMesh& mesh : again->meshes) {
    for (const Triangle& triangle : mesh.triangles) {
      for (const std::uint32_t v : triangle) {
        if (!mesh.positions[v].allFinite()) return "a written vertex is not finite";
      }
    }
  }
  return std::nullopt;
}

/// One edit, from seed to files. `enter` is told each stage before it begins.
class Run {
 public:
  Run(const std::string& bytes, const Abstraction& abstraction, const Gauge& gauge,
      const std::function<void(const std::string&)>& enter)
      : bytes_(bytes), abstraction_(abstraction), gauge_(gauge), enter_(enter) {}

  json operator()(const NamedEdit& edit, const fs::path& program_file) {
    record_ = {{"kind", "edit"}, {"edit", edit.name}, {"seed", edit.edit["seed"]}, {"failure", nullptr}};
    evaluate(edit, program_file);
    record_["ms"] = times_;
    record_["peak_mb"] = peak_mb();
    return record_;
  }

 private:
  template <class Work>
  auto timed(const std::string& stage, const Work& work) {
    enter_(stage);
    const std::clock_t begin = std::clock();
    auto result = work();
    times_[stage] = times_.value(stage, 0.0) + 1e3 * static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
    return result;
  }

  /// Keeps the first.
  void fail(const std::string& stage, const std::string& cause) {
    if (record_["failure"].is_null()) record_["failure"] = {{"stage", stage}, {"cause", cause}};
  }

  void evaluate(const NamedEdit& edit, const fs::path& program_file) {
    const Shape& shape = abstraction_.shape;
    const auto request = edit_request_from_json(edit.edit);
    if (!request.ok()) return fail("request", request.error().message());
    PropagateOptions options;
    options.request = edit.name;
    const auto found = timed("propagate", [&] { return propagate(shape, *request, options); });
    if (!found.ok()) return fail("propagate", found.error().message());
    const Program& program = found->program;
    if (const Status valid = validate(program, shape); !valid.ok()) return fail("validate", valid.error().message());
    fs::create_directories(program_file.parent_path());
    std::ofstream(program_file) << line_of(parsel::to_json(program)) << '\n';
    describe(program.layers[0], found->trace);

    const auto checked =
        timed("check", [&] { return check_program(shape, program, parsel::to_json(found->trace), 0); });
    record_["findings"] = json::array();
    for (const Finding& finding : checked.findings) {
      if (record_["findings"].size() < 5) record_["findings"].push_back(finding.place + ": " + finding.text);
    }
    if (!checked.accepted()) fail("check", checked.findings[0].text);

    record_["ends"] = json::array();
    const Evaluator evaluator(program, shape);
    for (const double x : {program.layers[0].parameter.min, program.layers[0].parameter.max}) {
      record_["ends"].push_back(look_at(program, evaluator, x));
    }
  }

  void describe(const Layer& layer, const Trace& trace) {
    int held = 0, broken = 0, disabled = 0, certified = 0;
    double worst = 0;
    for (const RelationReport& report : layer.relations) {
      held += report.status == RelationStatus::held;
      broken += report.status == RelationStatus::broken;
      disabled += report.status == RelationStatus::disabled;
      certified += report.status != RelationStatus::disabled && report.proof == Proof::certified;
      if (report.status == RelationStatus::held) worst = std::max(worst, report.worst);
    }
    std::map<std::string, int> why;
    std::set<std::string> parts;
    for (const TraceStep& step : trace.steps) {
      ++why[step.kind];
      parts.insert(step.part);
    }
    json broken_ids = json::array();
    for (const RelationReport& report : layer.relations) {
      if (report.status == RelationStatus::broken) broken_ids.push_back({{"id", report.id}, {"worst", report.worst}});
    }
    record_.update({{"parts", parts.size()},
                    {"relations", held + broken},
                    {"statements", layer.statements.size()},
                    {"why", why},
                    {"range", {layer.parameter.min, layer.parameter.max}},
                    {"held", held},
                    {"broken", broken},
                    {"disabled", disabled},
                    {"certified", certified},
                    {"worst_held", worst},
                    {"left_broken", broken_ids}});
  }

  json look_at(const Program& program, const Evaluator& evaluator, double x) {
    const State state = evaluator({x});
    const Damage damage = timed("measure", [&] { return gauge_.measure(state); });
    if (!damage.finite) fail("evaluate", "a corner is not finite");
    if (damage.least_jacobian <= 0) fail("evaluate", damage.least_jacobian_of + " is turned inside out");
    json end = {{"x", x},
                {"least_jacobian", damage.least_jacobian},
                {"least_jacobian_of", damage.least_jacobian_of},
                {"overlap", damage.overlap},
                {"gap", damage.gap},
                {"overlaps", ::to_json(damage.overlaps, abstraction_.shape, program.layers[0])},
                {"gaps", ::to_json(damage.gaps, abstraction_.shape, program.layers[0])}};
    const auto applied = timed("apply", [&] { return apply_program(bytes_, abstraction_.shape, program, {x}); });
    if (!applied.ok()) {
      fail("apply", applied.error().message());
      return end;
    }
    end["glb_bytes"] = applied->glb.size();
    bool count_changed = false;
    for (const GroupState& group : state.groups) count_changed = count_changed || group.count_changed;
    enter_("read back");
    if (const auto fault = fault_of(applied->glb, abstraction_, count_changed)) fail("apply", *fault);
    return end;
  }

  const std::string& bytes_;
  const Abstraction& abstraction_;
  const Gauge& gauge_;
  const std::function<void(const std::string&)>& enter_;
  json record_;
  json times_ = json::object();
};

/// In the child: the model, then its edits from number `first` on.
void evaluate_model(const Options& options, const fs::path& file, const std::optional<json>& edits, std::size_t first,
                    const std::function<void(const std::string&)>& send) {
  const std::string name = file.stem().string();
  const auto enter = [&](const std::string& stage) { send(line_of({{"kind", "stage"}, {"stage", stage}})); };
  const std::string bytes = read(file);
  enter("abstraction");
  const std::clock_t begin = std::clock();
  const auto abstraction = abstract_shape(bytes, name);
  const std::clock_t abstracted = std::clock();
  json model = {{"kind", "model"}, {"model", name}, {"bytes", bytes.size()}, {"failure", nullptr}};
  if (!abstraction.ok()) {
    model["failure"] = {{"stage", "abstraction"}, {"cause", abstraction.error().message()}};
    return send(line_of(model));
  }
  const Shape& shape = abstraction->shape;
  enter("gauge");
  const Gauge gauge(*abstraction);
  const double to_ms = 1e3 / CLOCKS_PER_SEC;
  std::map<std::string, int> kinds;
  for (const Relation& relation : shape.relations) ++kinds[std::string(to_string(relation.kind))];
  std::size_t triangles = 0;
  for (const PartMesh& mesh : abstraction->meshes) triangles += mesh.triangles.size();
  json warnings = json::array();
  for (const Warning& warning : shape.warnings) warnings.push_back(warning.place + ": " + warning.text);
  model.update({{"parts", abstraction->meshes.size()},
                {"active_parts", active_parts(shape).size()},
                {"relations", shape.relations.size()},
                {"kinds", kinds},
                {"triangles", triangles},
                {"contacts", gauge.contacts()},
                {"warnings", warnings},
                {"ms",
                 {{"abstraction", to_ms * static_cast<double>(abstracted - begin)},
                  {"gauge", to_ms * static_cast<double>(std::clock() - abstracted)}}},
                {"peak_mb", peak_mb()}});
  if (first == 0) send(line_of(model));

  std::vector<NamedEdit> list;
  if (edits) {
    for (const json& entry : *edits) list.push_back({entry.at("name"), entry.at("edit")});
  } else {
    list = automatic_edits(shape);
  }
  for (std::size_t i = first; i < list.size(); ++i) {
    send(line_of({{"kind", "begin"}, {"edit", list[i].name}, {"seed", list[i].edit["seed"]}, {"number", i}}));
    json record =
        Run(bytes, *abstraction, gauge, enter)(list[i], options.output / "programs" / name / (list[i].name + ".json"));
    record["model"] = name;
    send(line_of(record));
  }
}

/// Runs the model until all its edits are through, however often the child dies.
void supervise(const Options& options, const fs::path& file, const std::optional<json>& edits, std::ostream& out) {
  std::size_t first = 0;
  while (true) {
    std::string stage;
    json running;
    const Ending ending = run_isolated([&](const auto& send) { evaluate_model(options, file, edits, first, send); },
                                       [&](const std::string& line) {
                                         const json record = json::parse(line);
                                         if (record["kind"] == "stage") {
                                           stage = record["stage"];
                                         } else if (record["kind"] == "begin") {
                                           running = record;
                                         } else {
                                           running = nullptr;
                                           out << line << std::endl;
                                         }
                                       },
                                       options.seconds);
    if (ending.kind == Ending::Kind::done) return;
    std::string cause = "crashed";
    if (ending.kind == Ending::Kind::timed_out) {
      cause = "took longer than " + std::to_string(std::lround(options.seconds)) + " s";
    }
    if (!ending.detail.empty()) cause += ": " + ending.detail;
    const json failure = {{"stage", stage}, {"cause", cause}};
    const std::string model = file.stem().string();
    if (running.is_null()) {
      out << line_of({{"kind", "model"}, {"model", model}, {"failure", failure}}) << std::endl;
      return;
    }
    out << line_of({{"kind", "edit"},
                    {"model", model},
                    {"edit", running["edit"]},
                    {"seed", running["seed"]},
                    {"failure", failure}})
        << std::endl;
    first = running["number"].get<std::size_t>() + 1;
  }
}

Options options_of(const std::vector<std::string>& arguments) {
  Options options;
  for (std::size_t i = 0; i < arguments.size(); ++i) {
    const std::string& argument = arguments[i];
    if (!argument.starts_with("-")) {
      options.models = argument;
      continue;
    }
    if (i + 1 == arguments.size()) refuse(argument + " needs a value");
    const std::string& value = arguments[++i];
    if (argument == "-o")
      options.output = value;
    else if (argument == "--edits")
      options.edits = value;
    else if (argument == "--only")
      options.only = value;
    else if (argument == "--seconds")
      options.seconds = std::stod(value);
    else
      refuse("unknown option " + argument);
  }
  if (options.models.empty() || options.output.empty()) {
    refuse("usage: parsel_eval MODELS -o OUTPUT [--edits EDITS.json] [--only TEXT] [--seconds S]");
  }
  return options;
}

}  // namespace

int main(int count, char** arguments) {
  const Options options = options_of({arguments + 1, arguments + count});
  json edits = json::object();
  if (!options.edits.empty()) edits = json::parse(read(options.edits));
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(options.models)) {
    const fs::path& path = entry.path();
    if (path.extension() == ".glb" && path.stem().string().find(options.only) != std::string::npos)
      files.push_back(path);
  }
  std::sort(files.begin(), files.end());
  if (files.empty()) refuse(options.models.string() + " holds no such .glb");
  fs::create_directories(options.output);
  std::ofstream out(options.output / "results.jsonl");
  for (std::size_t i = 0; i < files.size(); ++i) {
    std::cerr << '\r' << i + 1 << '/' << files.size() << ' ' << files[i].stem().string() << "\x1b[K" << std::flush;
    const auto own = edits.find(files[i].stem().string());
    supervise(options, files[i], own == edits.end() ? std::nullopt : std::optional<json>(*own), out);
  }
  std::cerr << '\n';
}
