// A family: a CAD model, what its variations share, and the few sliders that are left (ReparamCAD, Kodnongbua et al.
// 2023).
//
// Candidates that hold in the base ► agreement of the variations (or the paper's ranking) ► optional parts ► a basis in
// exact fractions ► sliders with names, ranges and stops. Everything is in the model's own unit and frame.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "core/family/fill.h"
#include "core/family/order.h"
#include "core/family/slider.h"

namespace parsel::family {

/// How constraints are selected: those that hold in all variations, or the paper's greedy ranking, cut off by either of
/// its two rules (ranking.h), or none at all, the paper's ablation "no constraints".
enum class Selection { agreement, ranking, ranking_by_derivative, none };

struct Options {
  Vocabulary vocabulary = Vocabulary::paper;
  Selection selection = Selection::agreement;
  double tolerance = 1e-6;  ///< of the half-diagonal: what is nearer counts as equal
  Choices choices;
};

struct Family {
  cad::Model model;
  Options options;
  double tolerance = 0;  ///< in the model's unit
  Layout layout;
  Values base;  ///< on the family's space, as near to the model as numbers allow
  std::vector<Variation> variations;

  Count candidates;
  std::vector<Constraint> constraints;   ///< those that hold in the base
  std::vector<Evidence> evidence;        ///< by constraint
  std::vector<std::size_t> independent;  ///< of the kept ones
  std::size_t base_rank = 0;             ///< of all constraints

  Pins pins;
  Eigen::Vector3d pinned;  ///< values of the pinned forms
  Basis basis;
  std::vector<Slider> sliders;
  std::vector<Eigen::VectorXd> settings;  ///< free parameters, by variation
  Eigen::VectorXd base_setting;
  Orders orders;
  std::vector<Bound> bounds;
  std::vector<OptionalGroup> optional;
  std::vector<std::string> warnings;

  std::size_t dimensions() const { return layout.size() - basis.rank; }
  /// The model at values of the sliders.
  cad::Model at(const Eigen::VectorXd& setting) const;
};

struct FamilyLimits {
  static constexpr std::size_t parts = 64;  ///< pairs of points grow with the square of it
};

/// Refuses models with too many parts and choices that name no constraint of the base. Without variations every
/// constraint of the base is kept: the paper's ablation "no variations".
Result<Family> make_family(const cad::Model& model, std::vector<Variation> variations, const Options& options = {});

/// Format `parsel/family` v1: {"format","version","name","unit","cad": sha256 of the parsel/cad JSON,"vocabulary",
/// "selection","counts":{"parameters","candidates","holding","rank","common","independent","dimensions","sliders",
/// "orders"},"constraints":[{"id","kind","a","b","state": common|near|accidental|forced|off,"kept","holds","of",
/// "broken_by"?}],"sliders":[{"parameter","name","variable","section","value","min","max","stops":[low|null,
/// high|null],"stopped_by":[text|null ×2],"coefficients":{parameter: fraction}}],"pins":[{"parameter"…}],"optional":
/// [{"parts","absent_from"}],"variations":[{"name","setting","absent"}],"warnings"}
nlohmann::json to_json(const Family& family);

/// Where a slider may go: the hull, and beyond it on either side a quarter of it (where no variation changes it: of its
/// value), as far as nothing stops it while the others are as in the base. Within the hull the others may stop it.
Interval reach(const Family& family, std::size_t slider);

/// What stops a slider, in words: "the seat meets the back", "the leg's height ends".
std::string stop_text(const Family& family, const Stop& stop);

}  // namespace parsel::family
