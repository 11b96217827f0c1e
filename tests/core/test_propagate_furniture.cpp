#include <doctest/doctest.h>

#include <algorithm>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "core/check/check.h"
#include "core/edit/evaluate.h"
#include "core/edit/readable.h"
#include "core/propagate/propagate.h"
#include "core/shape/abstraction.h"
#include "tests/core/real_models.h"
#include "tests/core/told.h"

using namespace parsel;
using nlohmann::json;

namespace {

/// Active real parts that are no instances, the largest extent along an axis first.
PartIndex longest_part(const Shape& shape, int axis) {
  PartIndex best(0);
  double longest = -1;
  for (const PartIndex p : active_parts(shape)) {
    if (shape.parts[p].is_virtual()) continue;
    const auto column = shape.parts[p].hexahedron.corners.col(axis);
    const double extent = column.maxCoeff() - column.minCoeff();
    if (extent > longest + 1e-9) {
      longest = extent;
      best = p;
    }
  }
  return best;
}

json scale(const Part& part, const std::vector<int>& at, const std::vector<int>& direction) {
  return {{"op", "scale_1d"},
          {"part", part.id},
          {"origin", {{"part", part.id}, {"at", at}}},
          {"direction", direction},
          {"amount", "x"}};
}

}  // namespace

TEST_CASE("real furniture: widened, raised and with one part moved, nothing fails and nothing turns inside out") {
  const auto files = test::real_models("furniture");
  if (files.empty()) return;
  std::printf("%-24s %-6s %5s %5s %7s %7s %5s/%-5s %s\n", "model", "edit", "parts", "moves", "min", "max", "held",
              "all", "certified");
  int held = 0, all = 0, certified = 0;
  for (const auto& path : files) {
    const auto abstraction = abstract_shape(test::read_bytes(path), path.stem().string());
    REQUIRE(abstraction.ok());
    const Shape& shape = abstraction->shape;
    const Part& wide = shape.parts[longest_part(shape, 0)];
    const Part& high = shape.parts[longest_part(shape, 1)];
    const Part& deep = shape.parts[longest_part(shape, 2)];
    const std::vector<std::pair<const char*, json>> seeds = {
        {"widen", scale(wide, {0, 0, 0}, {1, 0, 0})},
        {"raise", scale(high, {0, -1, 0}, {0, 1, 0})},
        {"move", {{"op", "translate"}, {"part", deep.id}, {"direction", {0, 0, 1}}, {"amount", "x"}}}};
    for (const auto& entry : seeds) {
      const char* const name = entry.first;
      const json& seed = entry.second;
      CAPTURE(path.stem().string());
      CAPTURE(name);
      const auto request = edit_request_from_json({{"seed", {seed}}});
      REQUIRE(request.ok());
      const auto found = propagate(shape, *request);
      if (!found.ok()) FAIL(found.error().message());
      const CheckReport checked = check_program(shape, found->program, to_json(found->trace), 0);
      for (const Finding& finding : checked.findings) FAIL_CHECK(finding.place << ": " << finding.text);
      const Status again = readable(found->program, shape);
      if (!again.ok()) FAIL_CHECK(again.error().message());
      for (const std::string& gap : test::untold_gaps(shape, found->program)) FAIL_CHECK(gap << " comes apart untold");
      const Layer& layer = found->program.layers[0];
      int kept = 0, count = 0, proven = 0;
      for (const RelationReport& report : layer.relations) {
        if (report.status == RelationStatus::disabled) continue;
        ++count;
        kept += report.status == RelationStatus::held;
        proven += report.proof == Proof::certified;
      }
      std::printf("%-24s %-6s %5zu %5zu %7.3f %7.3f %5d/%-5d %d\n", path.stem().c_str(), name,
                  active_parts(shape).size(), layer.statements.size(), layer.parameter.min, layer.parameter.max, kept,
                  count, proven);
      held += kept;
      all += count;
      certified += proven;
      CHECK(layer.parameter.max - layer.parameter.min > 0.05);
      const Evaluator evaluate(found->program, shape);
      for (const double x :
           {layer.parameter.min, layer.parameter.min / 2, layer.parameter.max / 2, layer.parameter.max}) {
        const State state = evaluate({x});
        for (const PartIndex p : active_parts(shape)) {
          CHECK(relative_jacobians(state.parts[p], shape.parts[p].hexahedron.corners).minCoeff() > 0);
        }
      }
    }
  }
  std::printf("relations held: %d of %d (%.1f %%), certified %d\n", held, all, 100.0 * held / all, certified);
  CHECK(held >= 0.9 * all);
}
