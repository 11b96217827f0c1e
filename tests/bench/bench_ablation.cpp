// What neighbour edits, breaking edits and the second look are worth (ParSEL §7.3.2, table 4): the gallery's edits,
// whose right answers the generators know, and for the share of relations held furniture as well (PARSEL_DATA), each
// part along its longest side. CSV: benchmark,case,metric,value. Not times: the numbers are the same on every machine.
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <nlohmann/json.hpp>

#include "core/check/score.h"
#include "core/propagate/propagate.h"
#include "tests/core/gallery_truth.h"
#include "tests/core/real_models.h"

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

void count_relations(Totals& totals, const Program& program) {
  ++totals.edits;
  for (const RelationReport& report : program.layers[0].relations) {
    if (report.status == RelationStatus::disabled) continue;
    ++totals.relations;
    totals.held += report.status == RelationStatus::held;
  }
}

void compare(Totals& totals, const Program& program, const Program& full, const Shape& shape, double distance) {
  totals.right += distance <= 0.005;
  totals.distance += distance;
  const Score score = score_program(shape, full, program);
  totals.programmatic += score.programmatic;
  totals.structural += score.structural;
}

struct Variant {
  const char* name;
  bool neighbour_edits, breaking_edits, revisions;
  Totals gallery, furniture;

  Program run(const Shape& shape, const EditRequest& request) const {
    PropagateOptions options;
    options.neighbour_edits = neighbour_edits;
    options.breaking_edits = breaking_edits;
    options.revisions = revisions;
    auto found = propagate(shape, request, options);
    if (!found.ok()) {
      std::fprintf(stderr, "%s: %s\n", shape.name.c_str(), found.error().message().c_str());
      std::exit(1);
    }
    return std::move(found->program);
  }
};

void gallery_edits(std::vector<Variant>& variants) {
  for (const GalleryModel& model : gallery_models()) {
    const auto asset = build(model);
    const auto abstraction = abstract_shape(asset->glb, model.id);
    const Shape& shape = abstraction->shape;
    for (const GalleryEdit& edit : asset->edits) {
      const auto request = edit_request_from_json(nlohmann::json::parse(edit.json));
      const Program full = variants[0].run(shape, *request);
      for (Variant& variant : variants) {
        const Program program = variant.run(shape, *request);
        count_relations(variant.gallery, program);
        const double distance = worst_distance(model, *asset, edit, shape, program);
        if (&variant == &variants[0] && distance > 0.005)
          std::fprintf(stderr, "%s/%s is off by %.4f\n", model.id.c_str(), edit.id.c_str(), distance);
        compare(variant.gallery, program, full, shape, distance);
      }
    }
  }
}

/// On every axis the longest part that is no instance, stretched about its centre.
void furniture_edits(std::vector<Variant>& variants) {
  for (const auto& path : test::real_models("furniture")) {
    const auto abstraction = abstract_shape(test::read_bytes(path), path.stem().string());
    const Shape& shape = abstraction->shape;
    for (int axis = 0; axis < 3; ++axis) {
      std::string part;
      double longest = 0;
      for (const PartIndex p : active_parts(shape)) {
        const auto column = shape.parts[p].hexahedron.corners.col(axis);
        const double extent = column.maxCoeff() - column.minCoeff();
        if (shape.parts[p].is_virtual() || extent <= longest + 1e-9) continue;
        longest = extent;
        part = shape.parts[p].id;
      }
      if (part.empty()) continue;
      const auto request =
          edit_request_from_json({{"seed",
                                   {{{"op", "scale_1d"},
                                     {"part", part},
                                     {"origin", {{"part", part}, {"at", {0, 0, 0}}}},
                                     {"direction", {axis == 0 ? 1 : 0, axis == 1 ? 1 : 0, axis == 2 ? 1 : 0}},
                                     {"amount", "x"}}}}});
      for (Variant& variant : variants) count_relations(variant.furniture, variant.run(shape, *request));
    }
  }
}

}  // namespace

int main() {
  std::vector<Variant> variants = {{"full", true, true, true, {}, {}},
                                   {"without neighbour edits", false, true, true, {}, {}},
                                   {"without breaking edits", true, false, true, {}, {}},
                                   {"without both", false, false, true, {}, {}},
                                   {"without the second look", true, true, false, {}, {}},
                                   {"without all three", false, false, false, {}, {}}};
  gallery_edits(variants);
  furniture_edits(variants);
  for (const Variant& variant : variants) {
    const char* name = variant.name;
    const Totals& gallery = variant.gallery;
    std::printf("ablation,%s,gallery edits,%d\n", name, gallery.edits);
    std::printf("ablation,%s,right within 0.5 %% of the half-diagonal,%d\n", name, gallery.right);
    std::printf("ablation,%s,mean worst distance %%,%.3f\n", name, 100 * gallery.distance / gallery.edits);
    std::printf("ablation,%s,statements as in full (Jaccard),%.3f\n", name, gallery.programmatic / gallery.edits);
    std::printf("ablation,%s,relations in the state of full %%,%.2f\n", name, 100 * gallery.structural / gallery.edits);
    for (const auto& [set, totals] : {std::pair{"gallery", gallery}, {"furniture", variant.furniture}}) {
      if (totals.edits == 0) continue;
      std::printf("ablation,%s,%s relations broken,%d\n", name, set, totals.relations - totals.held);
      std::printf("ablation,%s,%s relations held %%,%.2f\n", name, set, 100.0 * totals.held / totals.relations);
    }
  }
}
