// What neighbour edits and breaking edits are worth (ParSEL §7.3.2, table 4): the gallery's edits, whose right answers
// the generators know, with each of the two left out and with both.
// CSV: benchmark,case,metric,value. Not times: the numbers are the same on every machine.
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <nlohmann/json.hpp>

#include "core/propagate/propagate.h"
#include "core/propagate/score.h"
#include "tests/core/gallery_truth.h"

using namespace parsel;

namespace {

struct Totals {
  int edits = 0, right = 0, held = 0, relations = 0;
  double distance = 0, programmatic = 0, structural = 0;
};

/// Worst distance from the generator's model over three slider values, as a share of the half-diagonal.
double worst_distance(const GalleryModel& model, const GalleryAsset& asset, const GalleryEdit& edit, const Shape& shape,
                      const Program& program) {
  const Parameter& range = program.layers[0].parameter;
  const Evaluator evaluate(program, shape);
  double worst = 0;
  for (const double x : {0.85 * range.min, 0.3 * range.max, 0.9 * range.max}) {
    const auto truth = build(model, edit.values(x));
    if (!truth.ok()) std::exit(1);
    const auto boxes = test::edited_boxes(shape, evaluate({x}), asset.parts);
    worst = std::max(worst, test::distance_from_truth(boxes, truth->parts, shape.frame.scale).first);
  }
  return worst;
}

void add(Totals& totals, const Program& program, const Program& full, const Shape& shape, double distance) {
  ++totals.edits;
  totals.right += distance <= 0.005;
  totals.distance += distance;
  for (const RelationReport& report : program.layers[0].relations) {
    if (report.status == RelationStatus::disabled) continue;
    ++totals.relations;
    totals.held += report.status == RelationStatus::held;
  }
  const Score score = score_program(shape, full, program);
  totals.programmatic += score.programmatic;
  totals.structural += score.structural;
}

}  // namespace

int main() {
  struct Variant {
    const char* name;
    bool neighbour_edits, breaking_edits;
    Totals totals;
  };
  std::vector<Variant> variants = {{"full", true, true, {}},
                                   {"without neighbour edits", false, true, {}},
                                   {"without breaking edits", true, false, {}},
                                   {"without both", false, false, {}}};
  for (const GalleryModel& model : gallery_models()) {
    const auto asset = build(model);
    const auto abstraction = abstract_shape(asset->glb, model.id);
    const Shape& shape = abstraction->shape;
    for (const GalleryEdit& edit : asset->edits) {
      const auto request = edit_request_from_json(nlohmann::json::parse(edit.json));
      const auto full = propagate(shape, *request);
      for (Variant& variant : variants) {
        PropagateOptions options;
        options.neighbour_edits = variant.neighbour_edits;
        options.breaking_edits = variant.breaking_edits;
        const auto found = propagate(shape, *request, options);
        if (!found.ok() || !full.ok()) {
          std::fprintf(stderr, "%s/%s: %s\n", model.id.c_str(), edit.id.c_str(), found.error().message().c_str());
          return 1;
        }
        const double distance = worst_distance(model, *asset, edit, shape, found->program);
        add(variant.totals, found->program, full->program, shape, distance);
      }
    }
  }
  for (const auto& [name, neighbour, breaking, totals] : variants) {
    const double n = totals.edits;
    std::printf("ablation,%s,edits,%d\n", name, totals.edits);
    std::printf("ablation,%s,right within 0.5 %% of the half-diagonal,%d\n", name, totals.right);
    std::printf("ablation,%s,mean worst distance %%,%.3f\n", name, 100 * totals.distance / n);
    std::printf("ablation,%s,statements as in full (Jaccard),%.3f\n", name, totals.programmatic / n);
    std::printf("ablation,%s,relations in the state of full %%,%.2f\n", name, 100 * totals.structural / n);
    std::printf("ablation,%s,relations held %%,%.2f\n", name, 100.0 * totals.held / totals.relations);
  }
}
