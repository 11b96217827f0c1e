#include "core/prove/stack.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <set>

#include "core/base/random.h"
#include "core/prove/first_fault.h"
#include "core/prove/prove.h"
#include "core/prove/scope.h"

namespace parsel {

namespace {

constexpr std::uint64_t sampling_seed = 1;
constexpr int random_settings = 48;
constexpr int halvings = 7;

using Setting = std::vector<double>;

double drawn(const Parameter& p, Random& random) {
  return random.uniform(p.min, p.max);
}

std::vector<Setting> settings_of(const Program& program) {
  const std::size_t n = program.layers.size();
  Random random(sampling_seed);
  std::vector<Setting> settings;
  const bool all_corners = n < 31 && (1U << n) <= most_corners;
  const int corners = all_corners ? static_cast<int>(1U << n) : most_corners;
  for (int i = 0; i < corners; ++i) {
    Setting& setting = settings.emplace_back();
    for (std::size_t l = 0; l < n; ++l) {
      const bool high = all_corners ? (i >> l & 1) != 0 : random.uniform(0, 1) < 0.5;
      setting.push_back(high ? program.layers[l].parameter.max : program.layers[l].parameter.min);
    }
  }
  for (std::size_t l = 0; l < n; ++l) {
    const Parameter& p = program.layers[l].parameter;
    for (int quarter = 0; quarter <= 4; ++quarter) {
      Setting others(n, 0.0);
      others[l] = p.min + (p.max - p.min) * quarter / 4;
      settings.push_back(others);
      for (std::size_t k = 0; k < n; ++k) {
        if (k != l) others[k] = drawn(program.layers[k].parameter, random);
      }
      settings.push_back(std::move(others));
    }
  }
  for (int i = 0; i < random_settings; ++i) {
    Setting& setting = settings.emplace_back();
    for (const Layer& layer : program.layers) setting.push_back(drawn(layer.parameter, random));
  }
  return settings;
}

/// From a sound setting of slider l towards `end`: the last sound one, and what goes wrong beyond.
RangeEnd reach(const Together& together, Setting setting, std::size_t l, double end) {
  const double start = setting[l];
  RangeEnd found = first_fault(start, end, stop_steps, halvings, [&](double value) {
    setting[l] = value;
    return together.fault(setting);
  });
  // Rounded towards where it is sound.
  if (!found.reason.empty()) found.x = start + shortened(found.x - start);
  return found;
}

SliderStop stop_of(const Together& together, const Program& program, std::size_t l) {
  Setting setting;
  for (const Layer& layer : program.layers) setting.push_back(layer.parameter.value);
  const Parameter& p = program.layers[l].parameter;
  std::string fault = together.fault(setting);
  if (!fault.empty()) {
    setting[l] = 0;
    if (!together.fault(setting).empty()) return {p.value, p.value, fault, fault};
  }
  const RangeEnd low = reach(together, setting, l, p.min), high = reach(together, setting, l, p.max);
  return {low.x, high.x, low.reason, high.reason};
}

}  // namespace

StackVerdict judge_stack(const Shape& shape, const Program& program) {
  StackVerdict verdict;
  if (program.layers.empty()) return verdict;
  const Together together(shape, program, Together::Alone::as_reported);
  verdict.of = static_cast<int>(together.kept_alone().size());
  std::set<std::size_t> lost;
  for (const Setting& setting : settings_of(program)) {
    const Together::Look look = together.look(setting);
    ++verdict.settings;
    lost.insert(look.lost.begin(), look.lost.end());
    if (look.failure.empty()) continue;
    if (verdict.failed++ == 0) verdict.failure = look.failure;
  }
  for (const std::size_t i : lost) verdict.lost.push_back(together.kept_alone()[i]);
  for (std::size_t l = 0; l < program.layers.size(); ++l) verdict.stops.push_back(stop_of(together, program, l));
  return verdict;
}

void prove_anew(const Shape& shape, Program& program) {
  for (std::size_t l = 0; l < program.layers.size(); ++l) {
    program.layers[l].relations = prove_relations(shape, program, l, disabled_in(program.layers[l]));
  }
}

std::string in_words(const StackVerdict& verdict) {
  const std::string looked = " at all of " + std::to_string(verdict.settings) + " settings that were sampled";
  std::string words = "of " + std::to_string(verdict.of) + " relations that each layer keeps alone, " +
                      std::to_string(verdict.of - static_cast<int>(verdict.lost.size())) + " are kept" + looked;
  if (verdict.failed > 0) words += "; at " + std::to_string(verdict.failed) + " of them parts fail: " + verdict.failure;
  return words;
}

nlohmann::json to_json(const StackVerdict& verdict) {
  nlohmann::json stops = nlohmann::json::array();
  for (const SliderStop& stop : verdict.stops) {
    stops.push_back(
        {{"min", stop.min}, {"max", stop.max}, {"minReason", stop.min_reason}, {"maxReason", stop.max_reason}});
  }
  return {{"of", verdict.of},         {"lost", verdict.lost},       {"settings", verdict.settings},
          {"failed", verdict.failed}, {"failure", verdict.failure}, {"stops", std::move(stops)}};
}

}  // namespace parsel
