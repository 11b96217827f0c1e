// A dining table: four tapered legs tied by aprons below a floating top.
#include "core/gallery/model_builder.h"

namespace parsel::gallery {
namespace {

void layout(ModelBuilder& m) {
  const double extension = m["extension"], width = m["width"] + extension, depth = m["depth"];
  const double leg_height = m["leg_height"], thickness = m["top_thickness"], leg = m["leg_thickness"];
  const double apron_height = m["apron_height"], apron = m["apron_thickness"];
  const double overlap = 0.003, centre = extension / 2;
  const MaterialId top_wood = m.material(finish::walnut), leg_wood = m.material(finish::cream);

  const double leg_x = m["leg_spread_x"] * width / 2, leg_z = m["leg_spread_z"] * depth / 2;
  const MeshId top_mesh = m.mesh("tabletop", {width, thickness, depth}, top_wood, rounded_box(0.009, 3));
  const NodeId top = m.part("tabletop", top_mesh, {centre, leg_height - overlap + thickness / 2, 0});

  const MeshId leg_mesh = m.mesh("leg", {leg, leg_height, leg}, leg_wood, tapered_box(0.007, 0.55, 0.82));
  const auto leg_at = [&](int x, int z) {
    return m.part("leg", leg_mesh, {centre + x * leg_x, leg_height / 2, z * leg_z});
  };
  const NodeId front_left = leg_at(1, 1), front_right = leg_at(-1, 1), back_left = leg_at(1, -1),
               back_right = leg_at(-1, -1);
  m.reflect(0, {{front_left, front_right}, {back_left, back_right}});
  m.reflect(2, {{front_left, back_left}, {front_right, back_right}});
  m.attach({top}, {front_left, front_right, back_left, back_right}, RelationKind::point);
  m.stand({front_left, front_right, back_left, back_right});

  // A shadow gap parts the aprons from the top: only the legs carry it.
  const double apron_y = m["apron_level"] * leg_height;
  const MeshId long_mesh =
      m.mesh("long_apron", {2 * (leg_x - leg / 2 + overlap), apron_height, apron}, leg_wood, rounded_box(0.004));
  const NodeId long_front = m.part("long_apron", long_mesh, {centre, apron_y, leg_z});
  const NodeId long_back = m.part("long_apron", long_mesh, {centre, apron_y, -leg_z});
  m.reflect(2, {{long_front, long_back}});
  m.attach({long_front}, {front_left, front_right}, RelationKind::line);
  m.attach({long_back}, {back_left, back_right}, RelationKind::line);
  const MeshId short_mesh =
      m.mesh("short_apron", {apron, apron_height, 2 * (leg_z - leg / 2 + overlap)}, leg_wood, rounded_box(0.004));
  const NodeId short_left = m.part("short_apron", short_mesh, {centre + leg_x, apron_y, 0});
  const NodeId short_right = m.part("short_apron", short_mesh, {centre - leg_x, apron_y, 0});
  m.reflect(0, {{short_left, short_right}});
  m.attach({short_left}, {front_left, back_left}, RelationKind::line);
  m.attach({short_right}, {front_right, back_right}, RelationKind::line);

  const double metres = m.half_diagonal(), own_width = m["width"];
  m.edit({"widen", "Make the table wider.", {seed_scale_1d(top, Vec3::UnitX())}, {}, {}}, [=](double x) {
    return GalleryValues{{"width", own_width * (1 + x)}};
  });
  m.edit({"deepen", "Make the table deeper from front to back.", {seed_scale_1d(top, Vec3::UnitZ())}, {}, {}},
         [=](double x) {
           return GalleryValues{{"depth", depth * (1 + x)}};
         });
  m.edit({"raise", "Raise the table by its legs.", {seed_scale_1d(front_left, Vec3::UnitY(), {0, -1, 0})}, {}, {}},
         [=](double x) {
           return GalleryValues{{"leg_height", leg_height * (1 + x)}};
         });
  m.edit({"extend_left",
          "Extend the table on its left side only.",
          {seed_translate(top, Vec3::UnitX(), {1, 0, 0})},
          {"kind:reflection"},
          {}},
         [=](double x) {
           return GalleryValues{{"extension", extension + x * metres}};
         });
}

}  // namespace

extern const GalleryModel dining_table;
const GalleryModel dining_table = {
    "dining_table",
    "Dining table",
    {{"width", 1.6, 1.0, 2.3, "m", "width of the top"},
     {"depth", 0.85, 0.5, 1.3, "m", "depth of the top"},
     {"leg_height", 0.72, 0.45, 1.0, "m", "from the floor to the top"},
     {"top_thickness", 0.036, 0.025, 0.06, "m", "thickness of the top"},
     {"leg_thickness", 0.07, 0.05, 0.1, "m", "section of the legs"},
     {"leg_spread_x", 0.86, 0.6, 0.93, "ratio", "distance of the legs as a share of the width"},
     {"leg_spread_z", 0.78, 0.6, 0.9, "ratio", "distance of the legs as a share of the depth"},
     {"apron_height", 0.09, 0.05, 0.1, "m", "height of the aprons"},
     {"apron_thickness", 0.024, 0.018, 0.035, "m", "thickness of the aprons"},
     {"apron_level", 0.89, 0.7, 0.9, "ratio", "middle of the aprons as a share of the leg's height"},
     {"extension", 0, -0.4, 0.4, "m", "added to the width on the left side only"}},
    layout};

}  // namespace parsel::gallery
