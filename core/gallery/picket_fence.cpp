// A length of picket fence: two capped posts, two rails, a row of pointed pickets before them.
#include "core/gallery/model_builder.h"

namespace parsel::gallery {
namespace {

void layout(ModelBuilder& m) {
  const double distance = m["post_distance"], height = m["height"], post = m["post_thickness"];
  const double picket = m["picket_width"], thickness = m["picket_thickness"];
  const int count = m.count("picket_count");
  const double overlap = 0.003;
  const MaterialId paint = m.material(finish::white), cap_paint = m.material(finish::teal);

  const double post_x = distance / 2;
  const MeshId post_mesh = m.mesh("post", {post, height, post}, paint, rounded_box(0.006));
  const NodeId left = m.part("post", post_mesh, {post_x, height / 2, 0});
  const NodeId right = m.part("post", post_mesh, {-post_x, height / 2, 0});
  m.reflect(0, {{left, right}});
  const double cap_height = m["cap_height"];
  const MeshId cap_mesh = m.mesh("cap", {1.3 * post, cap_height, 1.3 * post}, cap_paint,
                                 [](const Vec3& size) { return faceted(4, 0.12, 0.7853981633974483, 0.35)(size); });
  const NodeId cap_left = m.part("cap", cap_mesh, {post_x, height - overlap + cap_height / 2, 0});
  const NodeId cap_right = m.part("cap", cap_mesh, {-post_x, height - overlap + cap_height / 2, 0});
  m.reflect(0, {{cap_left, cap_right}});
  m.attach(left, cap_left, RelationKind::face);
  m.attach(right, cap_right, RelationKind::face);

  const double rail_height = m["rail_height"], rail = 0.03, length = 2 * (post_x - post / 2 + overlap);
  const MeshId rail_mesh = m.mesh("rail", {length, rail_height, rail}, paint, rounded_box(0.004));
  const NodeId lower = m.part("rail", rail_mesh, {0, m["lower_level"] * height, 0});
  const NodeId upper = m.part("rail", rail_mesh, {0, m["upper_level"] * height, 0});
  m.reflect(1, {{lower, upper}});
  m.attach({lower, upper}, {left, right}, RelationKind::line);

  // The outer edges of the row of pickets keep their share of the rails.
  const double row = 0.93 * length - picket, picket_height = 0.94 * height;
  const MeshId picket_mesh = m.mesh("picket", {picket, picket_height, thickness}, paint,
                                    prism({{-1, -1}, {1, -1}, {1, 0.9}, {0, 1}, {-1, 0.9}}, 0.003));
  std::vector<NodeId> pickets;
  for (int i = 0; i < count; ++i) {
    const double x = row * (0.5 - double(i) / (count - 1));
    pickets.push_back(m.part("picket", picket_mesh, {x, picket_height / 2, rail / 2 - overlap + thickness / 2}));
  }
  const Side fence = m.translation(pickets);
  m.attach({fence}, {lower, upper}, RelationKind::line);

  const double metres = m.half_diagonal();
  m.edit({"lengthen",
          "Make the fence longer, the pickets further apart.",
          {seed_translate(left, Vec3::UnitX())},
          {},
          {{fence, "change_delta"}}},
         [=](double x) {
           return GalleryValues{{"post_distance", distance + 2 * x * metres}};
         });
  m.edit({"space_pickets",
          "Space the pickets more widely and let the fence follow.",
          {seed_change_delta("t1", "middle")},
          {},
          {}},
         [=](double x) {
           // The rails stretch as the outer edges of the row do, the posts move with the rails' ends.
           const double stretch = x * row / (row + picket);
           return GalleryValues{{"post_distance", distance + length * stretch}};
         });
  m.edit({"raise",
          "Make the fence higher.",
          {seed_scale_1d(left, Vec3::UnitY(), {0, -1, 0}), seed_scale_1d(right, Vec3::UnitY(), {0, -1, 0})},
          {"kind:reflection"},
          {{fence, "scale"}}},
         [=](double x) {
           return GalleryValues{{"height", height * (1 + x)}};
         });
}

}  // namespace

extern const GalleryModel picket_fence;
const GalleryModel picket_fence = {
    "picket_fence",
    "Picket fence",
    {{"post_distance", 1.6, 0.8, 2.4, "m", "distance of the posts"},
     {"height", 1.0, 0.6, 1.4, "m", "height of the posts"},
     {"post_thickness", 0.1, 0.08, 0.14, "m", "section of the posts"},
     {"cap_height", 0.07, 0.04, 0.1, "m", "height of the caps"},
     {"rail_height", 0.07, 0.05, 0.09, "m", "height of the rails"},
     {"lower_level", 0.24, 0.15, 0.35, "ratio", "height of the lower rail as a share of the posts"},
     {"upper_level", 0.72, 0.6, 0.78, "ratio", "height of the upper rail as a share of the posts"},
     {"picket_count", 9, 3, 10, "count", "number of pickets"},
     {"picket_width", 0.07, 0.03, 0.075, "m", "width of a picket"},
     {"picket_thickness", 0.02, 0.015, 0.03, "m", "thickness of a picket"}},
    layout};

}  // namespace parsel::gallery
