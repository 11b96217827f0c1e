// parsel job: everything that a line of a batch's manifest asks for, with the model read once.
#include <algorithm>
#include <filesystem>
#include <iostream>
#include <new>
#include <nlohmann/json.hpp>
#include <optional>

#include "core/base/json.h"
#include "core/check/check.h"
#include "core/cli/command.h"
#include "core/cli/input.h"
#include "core/cli/job_request.h"
#include "core/cli/model.h"
#include "core/cli/program_file.h"
#include "core/cli/siblings.h"
#include "core/edit/readable.h"
#include "core/export/sliders.h"
#include "core/infer/plain_reading.h"
#include "core/propagate/clean.h"
#include "core/propagate/compose.h"
#include "core/propagate/propagate.h"
#include "core/prove/stack.h"

namespace parsel::cli {
namespace {

using nlohmann::json;
namespace fs = std::filesystem;

/// A job that is being done: what is found, and what lies in the folder so far.
class Work {
 public:
  Work(const Job& job, fs::path from, fs::path folder)
      : job_(job), from_(std::move(from)), folder_(std::move(folder)) {}

  /// The result; files are in the folder. Error: nothing of them is.
  Result<json> run() {
    Status done = success();
    try {
      done = all();
    } catch (const std::bad_alloc&) {
      done = Error{"cli/job", job_.model, "there is not enough memory for this", "give it more, or simplify the model"};
    } catch (const std::exception& error) {
      done = Error{"cli/job", job_.model, std::string("internal error: ") + error.what(), "please report it"};
    }
    if (done) return std::move(result_);
    std::error_code ignored;
    for (const std::string& file : files_) fs::remove(folder_ / file, ignored);
    return done.error();
  }

 private:
  Status all() {
    Result<Model> model = load_model((from_ / job_.model).string(), job_.labels, job_.corrections);
    if (!model) return model.error();
    model_ = std::move(*model);
    const Shape& shape = model_.abstraction.shape;
    result_["shape"] = {{"name", shape.name},
                        {"sha256", shape.sha256},
                        {"parts", model_.abstraction.meshes.size()},
                        {"relations", shape.relations.size()}};
    note(shape.warnings);
    if (job_.shape) {
      if (const Status written = write("shape.json", text_of(to_json(shape))); !written) return written;
    }
    for (const auto step : {&Work::edit, &Work::apply, &Work::draw}) {
      if (const Status done = (this->*step)(); !done) return done;
    }
    result_["files"] = files_;
    return success();
  }

  Status edit() {
    if (job_.edits.empty()) return success();
    const Shape& shape = model_.abstraction.shape;
    std::vector<Program> programs;
    for (std::size_t i = 0; i < job_.edits.size(); ++i) {
      Result<Program> program = layers_of(job_.edits[i]);
      if (!program) return within(program.error(), "/edits/" + std::to_string(i));
      programs.push_back(std::move(*program));
    }
    program_ = programs.front();
    if (programs.size() > 1) {
      Result<Program> stacked = stack_programs(shape, programs);
      if (!stacked) return within(stacked.error(), "/edits");
      program_ = std::move(*stacked);
      const StackVerdict verdict = judge_stack(shape, program_);
      result_["together"] = {{"of", verdict.of}, {"lost", verdict.lost}, {"words", in_words(verdict)}};
      prove_anew(shape, program_);
      if (const Status ready = readable(program_, shape); !ready) return ready;
    }
    // What is checked and applied is what is written, to the last digit.
    Result<Program> written = program_from_json(to_json(program_));
    if (!written) return written.error();
    program_ = std::move(*written);
    result_["layers"] = json::array();
    for (const Layer& layer : program_.layers) {
      const auto reported = [&](RelationStatus status) {
        return std::count_if(layer.relations.begin(), layer.relations.end(),
                             [&](const RelationReport& report) { return report.status == status; });
      };
      result_["layers"].push_back({{"request", layer.request},
                                   {"parameter", layer.parameter.name},
                                   {"min", layer.parameter.min},
                                   {"max", layer.parameter.max},
                                   {"value", layer.parameter.value},
                                   {"statements", layer.statements.size()},
                                   {"held", reported(RelationStatus::held)},
                                   {"broken", reported(RelationStatus::broken)}});
    }
    const CheckReport report = check_program(shape, program_);
    result_["check"] = to_json(report);
    result_["check"]["accepted"] = report.accepted();
    return write("program.json", text_of(to_json(program_)));
  }

  Result<Program> layers_of(const JobEdit& edit) {
    const Shape& shape = model_.abstraction.shape;
    if (edit.kind == JobEdit::Kind::program) {
      if (edit.given.is_string()) return read_program((from_ / edit.given.get<std::string>()).string(), shape);
      Result<Program> program = program_from_json(edit.given);
      if (!program) return program.error();
      if (const Status valid = validate(*program, shape); !valid) return valid.error();
      return program;
    }
    PropagateOptions options;
    options.request = edit.wish.request;
    std::optional<PlainTarget> target;
    Result<EditRequest> request = Error{};
    if (edit.kind == JobEdit::Kind::request) {
      const Result<PlainReading> reading = read_plainly(shape, edit.wish);
      if (!reading) return reading.error();
      const auto found = reading->sure ? request_of(shape, reading->edits.front()) : std::nullopt;
      if (!found) {
        return Error{"cli/job", "request", "it is not read without doubt: " + reading->reason,
                     "say it in other words (parsel read tells what may be meant), or give the edit itself"};
      }
      request = *found;
      target = reading->edits.front().target;
    } else if (edit.given.is_string()) {
      request = read_edit((from_ / edit.given.get<std::string>()).string());
    } else {
      request = edit_request_from_json(edit.given);
    }
    if (!request) return request.error();
    Result<Propagation> found = propagate(shape, *request, options);
    if (!found) return found.error();
    for (const std::string& note : found->trace.notes) warn(edit.wish.request + ": " + note);
    // A size that was said sets the slider, beyond its end as far as all holds.
    if (target && !found->program.layers.empty()) {
      extend_range(shape, found->program, 0, target->x);
      Parameter& parameter = found->program.layers.front().parameter;
      parameter.value = std::clamp(target->x, parameter.min, parameter.max);
      if (parameter.value != target->x) warn(edit.wish.request + ": the slider ends before the size that was said");
    }
    return std::move(found->program);
  }

  Status apply() {
    const Shape& shape = model_.abstraction.shape;
    for (std::size_t i = 0; i < job_.apply.size(); ++i) {
      const JobApply& wanted = job_.apply[i];
      const std::string place = "/apply/" + std::to_string(i);
      std::vector<double> values;
      for (const Layer& layer : program_.layers) values.push_back(layer.parameter.value);
      for (const auto& [name, value] : wanted.set) {
        const Status set = set_value(program_, name, value, place + "/set/" + name, values);
        if (!set) return set;
      }
      ApplyOptions options;
      options.external = model_.buffers;
      for (const std::string& id : wanted.only) {
        const auto part = shape.find_part(id);
        if (!part) return Error{"cli/job", place + "/only", "the model has no part " + id, "parsel inspect lists them"};
        options.only_parts.push_back(*part);
      }
      Applied applied;
      if (wanted.morph) {
        Result<SlidersApplied> made = apply_sliders(model_.bytes, shape, program_, values, std::move(options));
        if (!made) return within(made.error(), place);
        result_["morphs"].push_back(to_json(*made));
        applied = std::move(made->applied);
      } else {
        std::optional<Animate> animate;
        if (!wanted.animate.empty()) animate = Animate{wanted.animate};
        auto made = apply_program(model_.bytes, shape, program_, values, animate, std::move(options));
        if (!made) return within(made.error(), place);
        applied = std::move(*made);
      }
      note(applied.warnings);
      if (const Status written = write("edited_" + std::to_string(i + 1) + ".glb", applied.glb); !written)
        return written;
    }
    return success();
  }

  Status draw() {
    if (!job_.siblings) return success();
    auto written = write_siblings(model_, program_, {job_.siblings->count, job_.siblings->seed, true}, folder_);
    if (!written) return within(written.error(), "/siblings");
    files_.insert(files_.end(), written->names.begin(), written->names.end());
    for (const auto& [warning, times] : written->warnings) warn(warning);
    result_["siblings"] = to_json(written->drawn);
    result_["siblings"].erase("siblings");
    result_["siblings"]["count"] = written->drawn.values.size();
    return success();
  }

  static std::string text_of(const json& value) {
    return value.dump(1, ' ', false, json::error_handler_t::replace) + "\n";
  }
  Status write(const std::string& name, std::string_view bytes) {
    files_.push_back(name);
    return write_whole(folder_ / name, bytes);
  }
  void warn(std::string text) { result_["warnings"].push_back(std::move(text)); }
  void note(const std::vector<Warning>& warnings) {
    for (const Warning& warning : warnings) warn(warning.place + ": " + warning.text);
  }

  const Job& job_;
  fs::path from_, folder_;
  Model model_;
  Program program_;
  std::vector<std::string> files_;
  json result_ = {{"format", "parsel/result"}, {"version", 1}, {"warnings", json::array()}};
};

int run(const Arguments& arguments) {
  if (arguments.positional.size() != 1) return misuse("job takes one job");
  if (!arguments.has("-o")) return misuse("job needs -o for the folder that it writes to");
  const std::string& path = arguments.positional.front();
  const Result<json> given = read_json(path);
  if (!given) return refuse(given.error());
  const fs::path folder = arguments.option("-o");
  std::error_code fault;
  fs::create_directories(folder, fault);
  if (fault || !fs::is_directory(folder)) {
    return refuse({"cli", "-o " + folder.string(), "the folder cannot be made", "name one that can be written to"});
  }
  const fs::path from = arguments.has("--from") ? fs::path(arguments.option("--from")) : fs::path(path).parent_path();
  const Result<Job> job = job_from_json(*given);
  Result<json> result = job ? Work(*job, from, folder).run() : Result<json>(job.error());
  json line = result ? *result : json{{"format", "parsel/result"}, {"version", 1}};
  if (job && !job->id.empty()) line["id"] = job->id;
  if (job) line["model"] = job->model;
  if (!result) {
    const Error& error = result.error();
    line["error"] = {{"stage", error.stage}, {"place", error.place}, {"cause", error.cause}, {"fix", error.fix}};
  }
  const std::string text = line.dump(-1, ' ', false, json::error_handler_t::replace) + "\n";
  if (const Status written = write_whole(folder / "result.json", text); !written) return refuse(written.error());
  std::cout << text;
  if (!std::cout.flush()) return exit_refused;
  return result ? exit_done : refuse(within(result.error(), path));
}

}  // namespace

extern const Command job_command;
const Command job_command = {
    "job",
    "JOB.json [--from DIR] -o DIR",
    "Does everything that a job asks for with the model read once (edits, a check, edited models, siblings; format "
    "parsel/job), into a folder with result.json. Paths in a job begin at --from, else at its own folder.",
    {"--from", "-o"},
    {},
    run};

}  // namespace parsel::cli
