// A bunk bed, long side to the front, with guard rails above and a ladder in the middle.
#include "core/gallery/model_builder.h"

namespace parsel::gallery {
namespace {

void layout(ModelBuilder& m) {
  const double length = m["length"], depth = m["depth"], height = m["height"], post = m["post_thickness"];
  const double mattress_height = m["mattress_height"];
  const int count = m.count("rung_count");
  const double overlap = 0.003;
  const MaterialId wood = m.material(finish::birch), accent = m.material(finish::forest);
  const MaterialId sheet = m.material(finish::mustard);

  const double post_x = length / 2 - overlap + post / 2, post_z = depth / 2 - post / 2;
  const MeshId post_mesh = m.mesh("post", {post, height, post}, wood, rounded_box(0.012));
  const auto post_at = [&](int x, int z) { return m.part("post", post_mesh, {x * post_x, height / 2, z * post_z}); };
  const NodeId front_left = post_at(1, 1), front_right = post_at(-1, 1), back_left = post_at(1, -1),
               back_right = post_at(-1, -1);
  m.reflect(0, {{front_left, front_right}, {back_left, back_right}});
  m.reflect(2, {{front_left, back_left}, {front_right, back_right}});

  const double thickness = 0.11, lower_y = m["lower_level"] * height, upper_y = m["upper_level"] * height;
  const MeshId platform_mesh = m.mesh("platform", {length, thickness, depth}, wood, rounded_box(0.01));
  const MeshId mattress_mesh =
      m.mesh("mattress", {0.96 * length, mattress_height, 0.86 * depth}, sheet, cushion(0.045, 0.012));
  std::vector<NodeId> platforms, mattresses;
  for (const double y : {lower_y, upper_y}) {
    platforms.push_back(m.part("platform", platform_mesh, {0, y, 0}));
    const double mattress_y = y + thickness / 2 - overlap + mattress_height / 2;
    mattresses.push_back(m.part("mattress", mattress_mesh, {0, mattress_y, 0}));
    m.attach({platforms.back()}, {front_left, front_right, back_left, back_right}, RelationKind::point);
    m.attach(platforms.back(), mattresses.back(), RelationKind::face);
  }
  m.reflect(1, {{platforms[0], platforms[1]}, {mattresses[0], mattresses[1]}});

  const double guard_length = 2 * (post_x - post / 2 + overlap), guard_y = 0.945 * height;
  const MeshId guard_mesh = m.mesh("guard", {guard_length, m["guard_height"], 0.024}, accent, rounded_box(0.006));
  const NodeId guard_front = m.part("guard", guard_mesh, {0, guard_y, post_z});
  const NodeId guard_back = m.part("guard", guard_mesh, {0, guard_y, -post_z});
  m.reflect(2, {{guard_front, guard_back}});
  m.attach({guard_front}, {front_left, front_right}, RelationKind::line);
  m.attach({guard_back}, {back_left, back_right}, RelationKind::line);
  m.stand({front_left, front_right, back_left, back_right});

  const double stile = 0.045, ladder_height = 0.9 * height, stile_depth = 0.066,
               ladder_z = depth / 2 - overlap + stile_depth / 2;
  const double stile_x = m["ladder_share"] * length / 2;
  const MeshId stile_mesh = m.mesh("stile", {stile * 0.8, ladder_height, stile_depth}, accent, rounded_box(0.008));
  const NodeId stile_left = m.part("stile", stile_mesh, {stile_x, ladder_height / 2, ladder_z});
  const NodeId stile_right = m.part("stile", stile_mesh, {-stile_x, ladder_height / 2, ladder_z});
  m.reflect(0, {{stile_left, stile_right}});
  for (const NodeId platform : platforms) m.attach({platform}, {stile_left, stile_right}, RelationKind::point);
  m.stand({stile_left, stile_right});

  // The rungs' thickness is a share of the height, as a scale of the whole row has it.
  const double rung_length = 2 * (stile_x - 0.4 * stile + overlap), rung = 0.016 * height;
  const MeshId rung_mesh = m.mesh("rung", {rung_length, rung, 0.02}, wood, rounded_box(0.008, 3));
  std::vector<NodeId> rungs;
  for (int i = 0; i < count; ++i) {
    rungs.push_back(
        m.part("rung", rung_mesh, {0, ladder_height * (0.5 + 0.72 * (double(i) / (count - 1) - 0.5)), ladder_z}));
  }
  const Side row = m.translation(rungs);
  m.attach({row}, {stile_left, stile_right}, RelationKind::face);

  m.edit({"lengthen", "Make the bunk bed longer.", {seed_scale_1d(platforms[0], Vec3::UnitX())}, {}, {{row, "scale"}}},
         [=](double x) {
           return GalleryValues{{"length", length * (1 + x)}};
         });
  m.edit({"raise",
          "Make the bunk bed taller, the bunks further apart.",
          {seed_scale_1d(front_left, Vec3::UnitY(), {0, -1, 0}), seed_scale_1d(front_right, Vec3::UnitY(), {0, -1, 0}),
           seed_scale_1d(back_left, Vec3::UnitY(), {0, -1, 0}), seed_scale_1d(back_right, Vec3::UnitY(), {0, -1, 0})},
          {"kind:reflection"},
          {{stile_left, "scale"}, {stile_right, "scale"}, {row, "scale"}}},
         [=](double x) {
           return GalleryValues{{"height", height * (1 + x)}};
         });
}

}  // namespace

extern const GalleryModel bunk_bed;
const GalleryModel bunk_bed = {
    "bunk_bed",
    "Bunk bed with a ladder",
    {{"length", 2.0, 1.25, 2.75, "m", "length between the posts"},
     {"depth", 0.96, 0.8, 1.2, "m", "depth of the bunks"},
     {"height", 1.75, 1.1, 2.4, "m", "height of the posts"},
     {"post_thickness", 0.085, 0.08, 0.1, "m", "section of the posts"},
     {"lower_level", 0.2, 0.15, 0.25, "ratio", "height of the lower bunk as a share of the posts"},
     {"upper_level", 0.74, 0.65, 0.78, "ratio", "height of the upper bunk as a share of the posts"},
     {"mattress_height", 0.12, 0.08, 0.15, "m", "thickness of the mattresses"},
     {"guard_height", 0.09, 0.06, 0.1, "m", "height of the guard rails"},
     {"ladder_share", 0.2, 0.15, 0.3, "ratio", "width of the ladder as a share of the length"},
     {"rung_count", 5, 3, 8, "count", "number of rungs"}},
    layout};

}  // namespace parsel::gallery
