// What is to be done with one model: a line of a batch's manifest, format `parsel/job` v1.
//   {"model": "chair.glb",                                         needed; all else may be left out
//    "id": "wide chairs",                                          what the result is called
//    "labels": {"node:3": "leg"},                                  see abstract_shape()
//    "corrections": [{"kind": "apart", "parts": ["node:3/0", "node:5/0"]}],   see core/shape/corrections.h
//    "edits": [{"request": "widen the chair", "mention": [ids]},   read plainly, without a language model
//              {"edit": parsel/edit or its file, "request": "…"},  a seed edit, propagated
//              {"program": parsel/program or its file}],           as it is
//    "apply": [{"set": {"x1": 0.2}, "animate": "x1", "morph": true, "only": [ids]}],
//    "siblings": {"count": 9, "seed": 1},
//    "shape": true}                                                the shape is written too
// Every edit is a layer (a program: its layers), named x1, x2, … in order. "format" and "version" may be left out.
#pragma once

#include <cstdint>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/infer/prompt.h"
#include "core/shape/abstraction.h"

namespace parsel::cli {

/// One of three; `given` is an object, or the path of a file that holds it.
struct JobEdit {
  enum class Kind { request, edit, program } kind = Kind::request;
  EditWish wish;  ///< its request also names the layer of an edit
  nlohmann::json given;
};

struct JobApply {
  std::map<std::string, double> set;  ///< by parameter; the others have their value in the program
  std::string animate;                ///< a parameter; empty for none
  bool morph = false;
  std::vector<std::string> only;
};

struct JobSiblings {
  int count = 9;
  std::uint64_t seed = 1;
};

struct Job {
  std::string id, model;
  Labels labels;
  Corrections corrections;
  std::vector<JobEdit> edits;
  std::vector<JobApply> apply;
  std::optional<JobSiblings> siblings;
  bool shape = false;
};

/// Untrusted JSON → job. Unknown keys are refused by name. Error place is a JSON pointer: "/edits/0/request".
Result<Job> job_from_json(const nlohmann::json& json);

}  // namespace parsel::cli
