// How long propagation takes on the gallery's edits, on furniture (PARSEL_DATA) and with growing numbers of parts.
// CSV: benchmark,case,metric,value. Each time is the median of several runs, proof and range included; processor time,
// so that a busy machine does not disturb it.
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "core/gallery/gallery.h"
#include "core/propagate/propagate.h"
#include "core/shape/abstraction.h"
#include "tests/core/real_models.h"

using namespace parsel;

namespace {

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

double median_ms(const Shape& shape, const EditRequest& request, int runs) {
  std::vector<double> times;
  for (int run = 0; run < runs; ++run) {
    const std::clock_t begin = std::clock();
    const auto found = propagate(shape, request);
    const std::clock_t end = std::clock();
    if (!found.ok()) {
      std::fprintf(stderr, "%s\n", found.error().message().c_str());
      std::exit(1);
    }
    times.push_back(1e3 * static_cast<double>(end - begin) / CLOCKS_PER_SEC);
  }
  return median(times);
}

void gallery_edits() {
  std::vector<double> all;
  for (const GalleryModel& model : gallery_models()) {
    const auto asset = build(model);
    const auto abstraction = abstract_shape(asset->glb, model.id);
    for (const GalleryEdit& edit : asset->edits) {
      const auto request = edit_request_from_json(nlohmann::json::parse(edit.json));
      all.push_back(median_ms(abstraction->shape, *request, 5));
      std::printf("propagate,%s/%s,ms,%.3f\n", model.id.c_str(), edit.id.c_str(), all.back());
      std::fflush(stdout);
    }
  }
  std::printf("propagate,gallery,median ms,%.3f\n", median(all));
  std::printf("propagate,gallery,worst ms,%.3f\n", *std::max_element(all.begin(), all.end()));
}

/// The part that is longest along x, scaled along it.
EditRequest widen(const Shape& shape) {
  std::string part;
  double longest = 0;
  for (const PartIndex p : active_parts(shape)) {
    const auto column = shape.parts[p].hexahedron.corners.col(0);
    const double extent = column.maxCoeff() - column.minCoeff();
    if (shape.parts[p].is_virtual() || extent <= longest + 1e-9) continue;
    longest = extent;
    part = shape.parts[p].id;
  }
  return *edit_request_from_json({{"seed",
                                   {{{"op", "scale_1d"},
                                     {"part", part},
                                     {"origin", {{"part", part}, {"at", {0, 0, 0}}}},
                                     {"direction", {1, 0, 0}},
                                     {"amount", "x"}}}}});
}

void furniture_widened() {
  std::vector<double> all;
  for (const auto& path : test::real_models("furniture")) {
    const auto abstraction = abstract_shape(test::read_bytes(path), path.stem().string());
    if (!abstraction.ok()) continue;
    all.push_back(median_ms(abstraction->shape, widen(abstraction->shape), 5));
    std::printf("propagate,%s/widen,ms,%.3f\n", path.stem().c_str(), all.back());
  }
  if (all.empty()) return;
  std::printf("propagate,furniture,median ms,%.3f\n", median(all));
  std::printf("propagate,furniture,worst ms,%.3f\n", *std::max_element(all.begin(), all.end()));
}

/// Widening a wall of shelves.
void growing_walls() {
  for (const int parts : {5, 10, 20, 50, 100}) {
    const auto asset = scaling_model(parts);
    if (!asset.ok()) return;
    const auto abstraction = abstract_shape(asset->glb, "scaling");
    const Shape& shape = abstraction->shape;
    std::printf("propagate,%d parts,ms,%.3f\n", parts, median_ms(shape, widen(shape), 3));
    std::printf("propagate,%d parts,active parts,%zu\n", parts, active_parts(shape).size());
    std::fflush(stdout);
  }
}

}  // namespace

int main() {
  gallery_edits();
  furniture_widened();
  growing_walls();
}
