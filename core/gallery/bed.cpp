// A bed: head and foot end between posts, rails, a slatted base, a mattress and two pillows.
#include <cmath>

#include "core/gallery/model_builder.h"

namespace parsel::gallery {
namespace {

void layout(ModelBuilder& m) {
  const double inner = m["inner_width"], length = m["rail_length"], post = m["post_thickness"];
  const double head_height = m["head_height"], foot_height = m["foot_height"], rail_height = m["rail_height"];
  const int count = m.count("slat_count");
  const double overlap = 0.003, rail = 0.034, rail_y = 0.3;
  const MaterialId wood = m.material(finish::oak), slat_wood = m.material(finish::birch);
  const MaterialId sheet = m.material(finish::white), pillow_cloth = m.material(finish::rose);

  const double rail_x = inner / 2 + rail / 2;
  const MeshId rail_mesh = m.mesh("side_rail", {rail, rail_height, length}, wood, rounded_box(0.006));
  const NodeId left = m.part("side_rail", rail_mesh, {rail_x, rail_y, 0});
  const NodeId right = m.part("side_rail", rail_mesh, {-rail_x, rail_y, 0});
  m.reflect(0, {{left, right}});

  // Head at the back, foot at the front. Boards and rails end in the posts.
  const double post_z = length / 2 - overlap + post / 2, board_length = 2 * (rail_x - post / 2 + overlap);
  const auto end = [&](const char* post_label, const char* board_label, double height, double board, int z) {
    const MeshId post_mesh = m.mesh(post_label, {post, height, post}, wood, rounded_box(0.01));
    const NodeId post_left = m.part(post_label, post_mesh, {rail_x, height / 2, z * post_z});
    const NodeId post_right = m.part(post_label, post_mesh, {-rail_x, height / 2, z * post_z});
    const MeshId board_mesh = m.mesh(board_label, {board_length, board, 0.026}, wood, arched_box(0.007, 0.03));
    const NodeId panel = m.part(board_label, board_mesh, {0, 0.95 * height - board / 2, z * post_z});
    m.reflect(0, {{post_left, post_right}});
    m.attach({panel}, {post_left, post_right}, RelationKind::line);
    m.stand({post_left, post_right});
    m.attach(left, post_left, RelationKind::line);
    m.attach(right, post_right, RelationKind::line);
    return panel;
  };
  end("head_post", "headboard", head_height, 0.5 * head_height, -1);
  end("foot_post", "footboard", foot_height, 0.46 * foot_height, 1);

  const double slat = m["slat_width"], slat_y = rail_y - 0.045, slat_thickness = 0.02;
  const double row = 0.92 * length - slat;
  const MeshId slat_mesh =
      m.mesh("slat", {inner + 2 * overlap, slat_thickness, slat}, slat_wood, rounded_box(0.004, 1));
  std::vector<NodeId> slats;
  for (int i = 0; i < count; ++i) {
    slats.push_back(m.part("slat", slat_mesh, {0, slat_y, row * (double(i) / (count - 1) - 0.5)}));
  }
  const Side base = m.translation(slats);
  m.attach({base}, {left, right}, RelationKind::line);

  const double mattress_height = m["mattress_height"], mattress_y = slat_y + slat_thickness / 2 - overlap;
  const MeshId mattress_mesh =
      m.mesh("mattress", {0.94 * inner, mattress_height, 0.955 * length}, sheet, cushion(0.05, 0.012));
  const NodeId mattress = m.part("mattress", mattress_mesh, {0, mattress_y + mattress_height / 2, 0});
  m.attach(mattress, base, RelationKind::face);

  const MeshId pillow_mesh = m.mesh("pillow", {m["pillow_width"], 0.13, 0.4}, pillow_cloth, cushion(0.055, 0.04));
  const double pillow_x = 0.24 * inner, pillow_y = mattress_y + mattress_height - 0.008 + 0.065;
  const NodeId pillow_left = m.part("pillow", pillow_mesh, {pillow_x, pillow_y, -0.34 * length});
  const NodeId pillow_right = m.part("pillow", pillow_mesh, {-pillow_x, pillow_y, -0.34 * length});
  m.reflect(0, {{pillow_left, pillow_right}});
  m.attach({mattress}, {pillow_left, pillow_right}, RelationKind::point);

  m.edit({"widen", "Make the bed wider.", {seed_scale_1d(mattress, Vec3::UnitX())}, {}, {{base, "scale"}}},
         [=](double x) {
           return GalleryValues{{"inner_width", inner * (1 + x)}};
         });
  m.edit({"lengthen",
          "Make the bed longer, the slats further apart.",
          {seed_scale_1d(left, Vec3::UnitZ())},
          {},
          {{base, "change_delta"}}},
         [=](double x) {
           return GalleryValues{{"rail_length", length * (1 + x)}};
         });
  m.edit({"more_slats", "Use more slats.", {seed_change_count("t1", "fit", "8*x")}, {}, {}}, [=](double x) {
    return GalleryValues{{"slat_count", count + std::floor(8 * x + 1e-9)}};
  });
}

}  // namespace

extern const GalleryModel bed;
const GalleryModel bed = {"bed",
                          "Double bed with slats",
                          {{"inner_width", 1.5, 0.95, 2.1, "m", "width between the side rails"},
                           {"rail_length", 2.0, 1.25, 2.75, "m", "length of the side rails"},
                           {"rail_height", 0.14, 0.12, 0.16, "m", "height of the side rails"},
                           {"post_thickness", 0.07, 0.055, 0.09, "m", "section of the posts"},
                           {"head_height", 1.0, 0.8, 1.3, "m", "height of the head posts"},
                           {"foot_height", 0.66, 0.55, 0.75, "m", "height of the foot posts"},
                           {"slat_count", 13, 9, 16, "count", "number of slats"},
                           {"slat_width", 0.07, 0.05, 0.08, "m", "width of a slat"},
                           {"mattress_height", 0.2, 0.14, 0.26, "m", "thickness of the mattress"},
                           {"pillow_width", 0.58, 0.4, 0.62, "m", "width of a pillow"}},
                          layout};

}  // namespace parsel::gallery
