// The record of one propagation: what broke, what was tried, what was chosen and why. Format `parsel/trace` v1:
//   {"format":"parsel/trace","version":1,
//    "parameter":"x1","samples":[8 values of the parameter at which the search looked],
//    "tolerances":{"exact","one_edited","both_edited"},
//    "dissolved":[group relation ids],"disabled":[relation ids],
//    "steps":[{"part":id,
//      "kind":"seed|symmetry|attachment|neighbour|breaking|group|keep_fixed|left_alone",
//      "statements":[indices into the layer's statements],   // none for left_alone, and for a keep_fixed by hint
//                                                            // that nothing pulls at
//      "pulled_by":[{"relation":id,"by":number}],            // relations to edited parts, and how far each is off
//                                                            // (largest |coordinate| at the samples) while the part
//                                                            // stays at rest
//      "result":[{"relation":id,"by":number}],               // the same relations with the statements applied
//      "left_broken":[relation ids],                         // given up; not chased again
//      "hint":"…",                                           // when there is one
//      "held":true,                                          // stays from the start: by a hint, or with the body
//      "tolerance":number,                                   // accepted within; 0 for seeds and copies by symmetry
//      "candidates":{"own":n,"neighbour":n,"pairs":n},       // generated
//      "survivors":n,"solved":n,                             // passed the numeric screen; given to the algebra
//      "symmetry_cost":n,"energy":number,
//      "runners_up":[{"statement":text,"symmetry_cost","energy","error"}],   // best first, at most 3
//      "why":"sentence"}],
//    "ends":{"min":clause,"max":clause},                     // why the slider goes no further: "seat would collapse";
//                                                            // "limit" where that is far enough
//    "notes":[sentences: hints without effect, …],
//    "stop":"sentence"}
// A step's relations are evaluated on the shape at rest with only the statements of this step and of earlier ones
// applied, so that a checker can replay it.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

namespace parsel {

struct TracedRelation {
  std::string relation;
  double by = 0;
};

struct RunnerUp {
  std::string statement;
  int symmetry_cost = 0;
  double energy = 0;
  double error = 0;
};

struct TraceStep {
  std::string part;
  std::string kind;
  std::vector<int> statements;
  std::vector<TracedRelation> pulled_by, result;
  std::vector<std::string> left_broken;
  std::string hint;
  bool held = false;
  double tolerance = 0;
  int own_candidates = 0, neighbour_candidates = 0, pairs = 0;
  int survivors = 0, solved = 0;
  int symmetry_cost = 0;
  double energy = 0;
  std::vector<RunnerUp> runners_up;
  std::string why;
};

struct Trace {
  std::string parameter;
  std::vector<double> samples;
  double exact = 0, one_edited = 0, both_edited = 0;
  std::vector<std::string> dissolved, disabled;
  std::vector<TraceStep> steps;
  std::string low_end, high_end;
  std::vector<std::string> notes;
  std::string stop;
};

nlohmann::json to_json(const Trace& trace);

}  // namespace parsel
