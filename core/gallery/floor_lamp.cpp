// A floor lamp. Its head hangs in a frame node that can tilt; part names stand in extras, node names say nothing.
#include "core/gallery/model_builder.h"

namespace parsel::gallery {
namespace {

void layout(ModelBuilder& m) {
  const double pole_height = m["pole_height"], pole_diameter = m["pole_diameter"], base_height = m["base_height"];
  const double shade_diameter = m["shade_diameter"], shade_height = m["shade_height"], tilt = m["head_tilt"];
  const double overlap = 0.003;
  const MaterialId metal = m.material(finish::brass), dark = m.material(finish::charcoal);
  const MaterialId cloth = m.material(finish::cream), glass = m.material(finish::white);
  const auto round = [](double diameter, double height) { return Vec3(diameter, height, diameter); };

  const MeshId base_mesh = m.mesh("base", round(m["base_diameter"], base_height), dark,
                                  turned({{0.96, 0}, {1, 0.2}, {1, 0.62}, {0.97, 0.86}, {0.9, 1}}, 48));
  const NodeId base = m.part("base", base_mesh, {0, base_height / 2, 0});
  const double pole_bottom = base_height - overlap, pole_top = pole_bottom + pole_height;
  const MeshId pole_mesh = m.mesh("pole", round(pole_diameter, pole_height), metal, cylinder(0.002, 20));
  const NodeId pole = m.part("pole", pole_mesh, {0, pole_bottom + pole_height / 2, 0});
  m.attach(base, pole, RelationKind::face);
  m.stand({base});

  const double collar_height = m["collar_height"];
  const MeshId collar_mesh = m.mesh("collar", round(2.4 * pole_diameter, collar_height), dark,
                                    turned({{0.7, 0}, {1, 0.15}, {1, 0.85}, {0.7, 1}}, 24));
  const NodeId collar = m.part("collar", collar_mesh, {0, pole_bottom + m["collar_level"] * pole_height, 0});
  m.attach(collar, pole, RelationKind::face);

  // The head turns about the pole's upper end, where the shade's lower rim is.
  const NodeId head = m.frame("head", {{0, pole_top - 0.006, 0}, turn(Vec3::UnitX(), tilt)});
  const MeshId shade_mesh = m.mesh("shade", round(shade_diameter, shade_height), cloth, shade(0.004, 0.72));
  const NodeId lampshade = m.part("shade", shade_mesh, {0, shade_height / 2, 0}, head);
  m.attach(lampshade, pole, RelationKind::face);
  const double bulb_height = 0.42 * shade_height, bulb_bottom = 0.006 - overlap;
  const MeshId bulb_mesh = m.mesh(
      "bulb", round(m["bulb_share"] * shade_diameter, bulb_height), glass,
      turned({{0.34, 0}, {0.36, 0.25}, {0.6, 0.36}, {0.9, 0.52}, {1, 0.68}, {0.92, 0.84}, {0.65, 0.96}, {0.3, 1}}, 24));
  const NodeId bulb = m.part("bulb", bulb_mesh, {0, bulb_bottom + bulb_height / 2, 0}, head);
  m.attach(bulb, lampshade, RelationKind::volume);
  m.attach(bulb, pole, RelationKind::face);
  const NodeId nodes[] = {base, pole, collar, lampshade, bulb};
  for (const NodeId node : nodes) m.label_by_extras(node, "Object_" + std::to_string(static_cast<int>(node)));

  m.edit({"raise", "Make the lamp taller.", {seed_scale_1d(pole, Vec3::UnitY(), {0, -1, 0})}, {}, {}}, [=](double x) {
    return GalleryValues{{"pole_height", pole_height * (1 + x)}};
  });
  m.edit({"wider_shade", "Use a wider shade.", {seed_scale_2d(lampshade, Vec3::UnitY())}, {}, {}}, [=](double x) {
    return GalleryValues{{"shade_diameter", shade_diameter * (1 + x)}};
  });
  m.edit({"tilt_head",
          "Tilt the shade forward.",
          {seed_rotate(lampshade, Vec3::UnitX(), {0, -1, 0})},
          {},
          {{bulb, "rotate"}}},
         [=](double x) {
           return GalleryValues{{"head_tilt", tilt + x}};
         });
}

}  // namespace

extern const GalleryModel floor_lamp;
const GalleryModel floor_lamp = {
    "floor_lamp",
    "Floor lamp",
    {{"pole_height", 1.25, 0.8, 1.75, "m", "length of the pole"},
     {"pole_diameter", 0.024, 0.018, 0.026, "m", "diameter of the pole"},
     {"base_diameter", 0.32, 0.22, 0.4, "m", "diameter of the base"},
     {"base_height", 0.03, 0.02, 0.06, "m", "height of the base"},
     {"collar_level", 0.62, 0.3, 0.8, "ratio", "place of the collar as a share of the pole"},
     {"collar_height", 0.06, 0.04, 0.09, "m", "height of the collar"},
     {"shade_diameter", 0.46, 0.29, 0.64, "m", "lower diameter of the shade"},
     {"shade_height", 0.3, 0.2, 0.4, "m", "height of the shade"},
     {"bulb_share", 0.22, 0.15, 0.3, "ratio", "diameter of the bulb as a share of the shade"},
     {"head_tilt", 0, -0.4, 0.4, "rad", "tilt of the shade, forwards positive"}},
    layout};

}  // namespace parsel::gallery
