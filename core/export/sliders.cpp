#include "core/export/sliders.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <set>

#include "core/base/text.h"
#include "core/base/tolerance.h"

namespace parsel {
namespace {

constexpr const char* stage = "export/sliders";
/// Where a slider is looked at on each side of its value.
constexpr std::size_t positions = 20;
/// Pieces of a side, as divisors of positions; their ends are targets.
constexpr std::array<std::size_t, 3> pieces{1, 2, 4};
constexpr double linear_error = 1e-6;
constexpr std::size_t title_bytes = 40;  // with " − 50%" and a number below the 63 that Blender keeps

/// The corners that a file shows of a state, in a fixed order.
using Shown = std::vector<Corners>;

class Viewer {
 public:
  Viewer(const Shape& shape, const std::vector<PartIndex>& only) : shape_(shape) {
    std::set<PartIndex> selected(only.begin(), only.end());
    for (const PartIndex p : only) selected.insert(shape.parts[p].members.begin(), shape.parts[p].members.end());
    const auto is_shown = [&](PartIndex p) { return only.empty() || selected.count(p) > 0; };
    std::set<PartIndex> members;
    for (const RelationIndex r : shape.relations.indices()) {
      const Relation& relation = shape.relations[r];
      if (!relation.is_group()) continue;
      members.insert(relation.parts.begin(), relation.parts.end());
      if (std::any_of(relation.parts.begin(), relation.parts.end(), is_shown)) groups_.push_back(r);
    }
    for (const PartIndex p : shape.parts.indices()) {
      if (!shape.parts[p].is_virtual() && members.count(p) == 0 && is_shown(p)) parts_.push_back(p);
    }
  }

  Shown operator()(const State& state) const {
    Shown out;
    for (const PartIndex p : parts_) out.push_back(state.parts[p]);
    for (const RelationIndex r : groups_) {
      const std::vector<Corners>& instances = state.groups[r].instances;
      out.insert(out.end(), instances.begin(), instances.end());
    }
    return out;
  }

  bool same_counts(const State& a, const State& b) const {
    const auto indices = shape_.relations.indices();
    return std::all_of(indices.begin(), indices.end(),
                       [&](RelationIndex r) { return a.groups[r].instances.size() == b.groups[r].instances.size(); });
  }

 private:
  const Shape& shape_;
  std::vector<PartIndex> parts_;  ///< that belong to no group
  std::vector<RelationIndex> groups_;
};

/// Largest distance of a corner from a + t·(b − a).
double distance(const Shown& from, const Shown& a, const Shown& b, double t) {
  double worst = 0;
  for (std::size_t i = 0; i < from.size(); ++i) {
    worst = std::max(worst, (from[i] - a[i] - t * (b[i] - a[i])).rowwise().norm().maxCoeff());
  }
  return worst;
}

/// Error of straight lines between the ends of n pieces; `side` has positions 0 … 20.
double error_of(const std::vector<Shown>& side, std::size_t n) {
  const std::size_t length = positions / n;
  double worst = 0;
  for (std::size_t k = 0; k <= positions; ++k) {
    const std::size_t begin = std::min(k / length, n - 1) * length;
    const double t = static_cast<double>(k - begin) / static_cast<double>(length);
    worst = std::max(worst, distance(side[k], side[begin], side[begin + length], t));
  }
  return worst;
}

/// At most title_bytes and "…", cut between words where there are some.
std::string shortened(const std::string& text) {
  if (text.size() <= title_bytes) return text;
  std::string_view head = cut(text, title_bytes);
  const std::size_t blank = head.rfind(' ');
  if (text[head.size()] != ' ' && blank != std::string_view::npos && blank >= title_bytes / 2) {
    head = head.substr(0, blank);
  }
  while (!head.empty() && head.back() == ' ') head.remove_suffix(1);
  return std::string(head) + "…";
}

std::string metres(double length) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.2g m", length);
  return text.data();
}

class Maker {
 public:
  Maker(const Shape& shape, const Program& program, const std::vector<double>& values,
        const std::vector<PartIndex>& only, std::set<std::string> taken)
      : shape_(shape),
        program_(program),
        values_(values),
        view_(shape, only),
        evaluate_(program, shape),
        base_(evaluate_(values)),
        taken_(std::move(taken)) {}

  const State& base() const { return base_; }
  const std::optional<Error>& refused() const { return refused_; }

  void add_all() {
    for (std::size_t i = 0; i < program_.layers.size(); ++i) add(i);
  }

  /// What two sliders do together beyond the sum of what they do alone.
  void measure_together() {
    const Shown rest = view_(base_);
    for (std::size_t a = 0; a < ends_.size(); ++a) {
      for (std::size_t b = a + 1; b < ends_.size(); ++b) {
        std::vector<double> at = values_;
        at[ends_[a].layer] = ends_[a].value;
        at[ends_[b].layer] = ends_[b].value;
        const State state = evaluate_(at);
        if (!view_.same_counts(state, base_)) continue;  // no target shows that
        Shown sum = ends_[a].shown;
        for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += ends_[b].shown[i] - rest[i];
        const double off = distance(view_(state), sum, sum, 0) * shape_.frame.scale;
        if (!out.worst_pair.empty() && !(off > out.together)) continue;
        out.together = off;
        out.worst_pair = {out.sliders[a].targets[0], out.sliders[b].targets[0]};
      }
    }
  }

  void warn() {
    const double limit = slider_tolerance * shape_.frame.scale;
    for (const Slider& slider : out.sliders) {
      if (!(slider.error > limit)) continue;
      warnings.push_back(
          {"slider " + slider.targets[0],
           "it is not linear: between its morph targets vertices are off by up to " + metres(slider.error)});
    }
    if (!(out.together > limit)) return;
    warnings.push_back({"sliders " + out.worst_pair[0] + ", " + out.worst_pair[1],
                        "with both at 1, vertices are off by up to " + metres(out.together) +
                            ": morph targets add up, and these two do more together"});
  }

  std::vector<Pose> poses;
  std::vector<Warning> warnings;
  SlidersApplied out;

 private:
  struct End {
    std::size_t layer;
    double value;
    Shown shown;
  };

  void add(std::size_t layer) {
    const Parameter& parameter = program_.layers[layer].parameter;
    const std::string place = "layer " + std::to_string(layer + 1) + " (" + wish(layer) + ")";
    Slider slider{parameter.name, {}, true, 0, 0};
    std::vector<Pose> added;
    std::optional<End> first;
    std::string title;
    for (const bool upwards : {true, false}) {
      const double end = upwards ? parameter.max : parameter.min;
      if (end == values_[layer]) continue;
      std::vector<State> states;
      std::vector<Shown> side;
      for (std::size_t k = 0; k <= positions; ++k) {
        states.push_back(evaluate_(between(layer, end, k)));
        side.push_back(view_(states.back()));
        if (view_.same_counts(states.back(), base_)) continue;
        const std::string cause =
            "its slider " + parameter.name + " changes how many instances there are, which no morph target can show";
        if (!refused_) refused_ = Error{stage, place, cause, "export one value of it, or its animation"};
        warnings.push_back({place, cause + "; it is left out"});
        return;
      }
      double moved = 0;
      for (const Shown& shown : side) moved = std::max(moved, distance(shown, side[0], side[0], 0));
      if (!(moved > noise)) continue;
      std::size_t n = pieces.front();
      for (std::size_t p = 1; p < pieces.size() && error_of(side, n) > slider_tolerance; ++p) n = pieces[p];
      const double straight = error_of(side, 1);
      slider.linear = slider.linear && straight <= linear_error;
      slider.straight = std::max(slider.straight, straight * shape_.frame.scale);
      slider.error = std::max(slider.error, error_of(side, n) * shape_.frame.scale);
      if (title.empty()) title = new_title(layer);
      const std::string name = side_name(title, upwards);
      added.push_back({name, states.back()});
      for (std::size_t p = 1; p < n; ++p) added.push_back({on_the_way(name, p, n), states[p * positions / n]});
      if (!first) {
        first = End{layer, end, side.back()};
      } else {
        slider.linear =
            slider.linear && distance(first->shown, side[0], side.back(),
                                      (first->value - values_[layer]) / (end - values_[layer])) <= linear_error;
      }
    }
    if (!first) {
      warnings.push_back({place, "its slider " + parameter.name + " moves nothing, so it is left out"});
      return;
    }
    for (Pose& pose : added) {
      slider.targets.push_back(pose.name);
      poses.push_back(std::move(pose));
    }
    out.sliders.push_back(std::move(slider));
    ends_.push_back(std::move(*first));
  }

  std::vector<double> between(std::size_t layer, double end, std::size_t k) const {
    std::vector<double> at = values_;
    const double t = static_cast<double>(k) / static_cast<double>(positions);
    at[layer] = k == positions ? end : at[layer] + t * (end - at[layer]);
    return at;
  }

  std::string wish(std::size_t layer) const {
    const std::string request = printable(program_.layers[layer].request, ProgramLimits::request_bytes);
    return shortened(is_blank(request) ? printable(program_.layers[layer].parameter.name) : request);
  }

  static std::string side_name(const std::string& title, bool upwards) { return upwards ? title : title + " −"; }
  static std::string on_the_way(const std::string& name, std::size_t piece, std::size_t n) {
    return name + " " + std::to_string(100 * piece / n) + "%";
  }

  /// The layer's wish with a number, when a target that it might get has its name already.
  std::string new_title(std::size_t layer) {
    for (std::size_t number = 1;; ++number) {
      const std::string title = number == 1 ? wish(layer) : wish(layer) + " " + std::to_string(number);
      std::vector<std::string> names;
      for (const bool upwards : {true, false}) {
        names.push_back(side_name(title, upwards));
        for (std::size_t p = 1; p < pieces.back(); ++p) {
          names.push_back(on_the_way(side_name(title, upwards), p, pieces.back()));
        }
      }
      if (std::any_of(names.begin(), names.end(), [&](const std::string& n) { return taken_.count(n) > 0; })) continue;
      taken_.insert(names.begin(), names.end());
      return title;
    }
  }

  const Shape& shape_;
  const Program& program_;
  const std::vector<double>& values_;
  const Viewer view_;
  const Evaluator evaluate_;
  const State base_;
  std::set<std::string> taken_;
  std::optional<Error> refused_;  ///< the first layer that changes counts
  std::vector<End> ends_;         ///< of every slider, the one that its first target shows
};

/// The names of morph targets that the model has.
std::set<std::string> names_of(const gltf::Document& document) {
  std::set<std::string> names;
  const auto meshes = document.json.find("meshes");
  if (meshes == document.json.end() || !meshes->is_array()) return names;
  for (const auto& mesh : *meshes) {
    const auto& extras = mesh.is_object() ? mesh.value("extras", nlohmann::json()) : nlohmann::json();
    const auto list = extras.is_object() ? extras.value("targetNames", nlohmann::json()) : nlohmann::json();
    for (const auto& name : list) {
      if (name.is_string()) names.insert(name.get<std::string>());
    }
  }
  return names;
}

}  // namespace

Result<SlidersApplied> apply_sliders(std::string_view file, const Shape& shape, const Program& program,
                                     const std::vector<double>& values, ApplyOptions options) {
  PARSEL_ASSERT(!options.sweep && options.poses.empty(), "the targets are those of the sliders");
  if (values.size() != program.layers.size()) {
    return Error{stage, "values",
                 std::to_string(values.size()) + " are given for " + std::to_string(program.layers.size()) + " layers",
                 "give one value a layer"};
  }
  const auto document = gltf::read_document(file, options.external);
  if (!document) return document.error();
  Maker maker(shape, program, values, options.only_parts, names_of(*document));
  maker.add_all();
  if (maker.poses.empty() && maker.refused()) return *maker.refused();
  maker.measure_together();
  maker.warn();
  options.poses = std::move(maker.poses);
  auto applied = apply_state(file, shape, maker.base(), options);
  if (!applied) return applied.error();
  maker.out.applied = std::move(applied).value();
  std::vector<Warning>& warnings = maker.out.applied.warnings;
  warnings.insert(warnings.begin(), maker.warnings.begin(), maker.warnings.end());
  return std::move(maker.out);
}

nlohmann::json to_json(const SlidersApplied& model) {
  nlohmann::json sliders = nlohmann::json::array();
  for (const Slider& slider : model.sliders) {
    sliders.push_back({{"parameter", slider.parameter},
                       {"targets", slider.targets},
                       {"linear", slider.linear},
                       {"error_m", slider.error},
                       {"ends_error_m", slider.straight}});
  }
  return {{"sliders", std::move(sliders)}, {"together", {{"targets", model.worst_pair}, {"error_m", model.together}}}};
}

}  // namespace parsel
