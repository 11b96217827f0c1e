// A towel ladder: two stiles with shoes and hooks, a row of rungs between them.
#include <cmath>

#include "core/gallery/model_builder.h"

namespace parsel::gallery {
namespace {

void layout(ModelBuilder& m) {
  const double distance = m["stile_distance"], height = m["height"], stile = m["stile_thickness"];
  const int count = m.count("rung_count");
  const double overlap = 0.003, shoe_height = m["shoe_height"];
  const MaterialId wood = m.material(finish::beech), rubber = m.material(finish::charcoal);
  const MaterialId metal = m.material(finish::steel);

  const double stile_x = distance / 2, middle = shoe_height - overlap + height / 2;
  const MeshId stile_mesh = m.mesh("stile", {stile, height, stile}, wood, rounded_box(0.01, 3));
  const MeshId shoe_mesh = m.mesh("shoe", {1.3 * stile, shoe_height, 1.3 * stile}, rubber, rounded_box(0.006));
  const double hook = 0.022, hook_depth = m["hook_depth"], hook_z = -stile / 2 + overlap - hook_depth / 2;
  const MeshId hook_mesh = m.mesh("hook", {hook, hook, hook_depth}, metal, rounded_box(0.006, 3));
  NodeId stiles[2], shoes[2], hooks[2];
  for (const std::size_t i : {0u, 1u}) {
    const double x = i == 0 ? stile_x : -stile_x;
    stiles[i] = m.part("stile", stile_mesh, {x, middle, 0});
    shoes[i] = m.part("shoe", shoe_mesh, {x, shoe_height / 2, 0});
    hooks[i] = m.part("hook", hook_mesh, {x, middle + 0.46 * height, hook_z});
    m.attach(stiles[i], shoes[i], RelationKind::face);
    m.attach(stiles[i], hooks[i], RelationKind::line);
  }
  m.reflect(0, {{stiles[0], stiles[1]}, {shoes[0], shoes[1]}, {hooks[0], hooks[1]}});

  // The rungs' height is a share of the ladder's, as a scale of the whole row has it.
  const double rung_length = 2 * (stile_x - stile / 2 + overlap);
  const MeshId rung_mesh = m.mesh("rung", {rung_length, m["rung_share"] * height, 0.028}, wood, rounded_box(0.009, 3));
  std::vector<NodeId> rungs;
  for (int i = 0; i < count; ++i) {
    const double y = middle + 0.74 * height * (double(i) / (count - 1) - 0.5);
    rungs.push_back(
        m.part("rung", rung_mesh, {0, y, 0}, NodeId::none, i == 0 ? "rung" : "rung.00" + std::to_string(i)));
  }
  const Side row = m.translation(rungs);
  m.attach({row}, {stiles[0], stiles[1]}, RelationKind::face);

  const double metres = m.half_diagonal();
  m.edit({"widen",
          "Make the ladder wider.",
          {seed_translate(stiles[0], Vec3::UnitX(), {0, 0, 0}, "0.4*x")},
          {},
          {{row, "scale"}}},
         [=](double x) {
           return GalleryValues{{"stile_distance", distance + 0.8 * x * metres}};
         });
  m.edit(
      {"raise", "Make the ladder taller.", {seed_scale_1d(stiles[0], Vec3::UnitY(), {0, -1, 0})}, {}, {{row, "scale"}}},
      [=](double x) {
        return GalleryValues{{"height", height * (1 + x)}};
      });
  m.edit({"more_rungs", "Add rungs.", {seed_change_count("t1", "fit", "8*x")}, {}, {}}, [=](double x) {
    return GalleryValues{{"rung_count", count + std::floor(8 * x + 1e-9)}};
  });
}

}  // namespace

extern const GalleryModel ladder;
const GalleryModel ladder = {
    "ladder",
    "Towel ladder",
    {{"stile_distance", 0.5, 0.16, 0.85, "m", "distance of the stiles"},
     {"height", 1.7, 1.1, 2.3, "m", "height of the stiles"},
     {"stile_thickness", 0.042, 0.035, 0.055, "m", "section of the stiles"},
     {"shoe_height", 0.035, 0.025, 0.06, "m", "height of the shoes"},
     {"hook_depth", 0.09, 0.07, 0.14, "m", "length of the hooks"},
     {"rung_count", 6, 3, 8, "count", "number of rungs"},
     {"rung_share", 0.017, 0.012, 0.022, "ratio", "height of a rung as a share of the height"}},
    layout};

}  // namespace parsel::gallery
