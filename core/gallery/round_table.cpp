// A round table on three turned legs, with a lazy Susan.
#include <cmath>

#include "core/base/tolerance.h"
#include "core/gallery/model_builder.h"

namespace parsel::gallery {
namespace {

void layout(ModelBuilder& m) {
  const double diameter = m["diameter"], thickness = m["top_thickness"];
  const double leg_height = m["leg_height"], leg = m["leg_diameter"], tray_height = m["tray_height"];
  const int count = m.count("leg_count");
  const double overlap = 0.003;
  const MaterialId wood = m.material(finish::cherry), dark = m.material(finish::walnut);

  const double top_y = leg_height - overlap + thickness / 2;
  const MeshId top_mesh = m.mesh("tabletop", {diameter, thickness, diameter}, wood,
                                 turned({{0.93, 0}, {0.985, 0.3}, {1, 0.55}, {1, 0.8}, {0.99, 0.95}, {0.98, 1}}, 64));
  const NodeId top = m.part("tabletop", top_mesh, {0, top_y, 0});
  const double tray = m["tray_share"] * diameter;
  const MeshId tray_mesh =
      m.mesh("lazy_susan", {tray, tray_height, tray}, dark,
             turned({{0.6, 0}, {0.6, 0.4}, {0.97, 0.4}, {1, 0.5}, {1, 0.92}, {0.985, 1}, {0.94, 1}, {0.92, 0.8}}, 48));
  const NodeId susan = m.part("lazy_susan", tray_mesh, {0, top_y + thickness / 2 - overlap + tray_height / 2, 0});
  m.attach(top, susan, RelationKind::face);

  // The legs' outer edges keep their share of the top.
  const double radius = m["leg_share"] * diameter / 2 - leg / 2;
  const MeshId leg_mesh = m.mesh("leg", {leg, leg_height, leg}, wood,
                                 turned({{0.5, 0},
                                         {0.58, 0.01},
                                         {0.62, 0.1},
                                         {0.72, 0.22},
                                         {0.8, 0.26},
                                         {0.66, 0.29},
                                         {0.72, 0.33},
                                         {0.92, 0.5},
                                         {1, 0.65},
                                         {0.95, 0.76},
                                         {0.74, 0.82},
                                         {0.86, 0.84},
                                         {0.9, 0.86},
                                         {0.9, 1}},
                                        24));
  std::vector<NodeId> legs;
  for (int i = 0; i < count; ++i) {
    const double angle = 2 * pi * i / count;
    legs.push_back(
        m.part("leg", leg_mesh,
               {{radius * std::sin(angle), leg_height / 2, radius * std::cos(angle)}, turn(Vec3::UnitY(), angle)}));
  }
  const Side ring = m.rotation(legs);
  // Three legs under the top are symmetric from left to right only, but reach over most of it from front to back.
  m.attach(ring, top, RelationKind::face);
  m.stand({ring});

  const double metres = m.half_diagonal();
  m.edit({"widen",
          "Widen the table and move its legs apart.",
          {seed_scale_2d(top, Vec3::UnitY())},
          {},
          {{ring, "change_delta"}}},
         [=](double x) {
           return GalleryValues{{"diameter", diameter * (1 + x)}};
         });
  m.edit({"raise", "Raise the table top.", {seed_translate(top, Vec3::UnitY())}, {}, {{ring, "scale"}}}, [=](double x) {
    return GalleryValues{{"leg_height", leg_height + x * metres}};
  });
  m.edit({"more_legs", "Give the table more legs.", {seed_change_count("o1", "fit", "8*abs(x)")}, {}, {}},
         [=](double x) {
           return GalleryValues{{"leg_count", count + std::floor(8 * std::abs(x) + 1e-9)}};
         });
}

}  // namespace

extern const GalleryModel round_table;
const GalleryModel round_table = {
    "round_table",
    "Round table on three legs",
    {{"diameter", 1.1, 0.7, 1.6, "m", "diameter of the top"},
     {"top_thickness", 0.035, 0.025, 0.05, "m", "thickness of the top"},
     {"leg_height", 0.71, 0.4, 1.05, "m", "from the floor to the top"},
     {"leg_diameter", 0.075, 0.05, 0.1, "m", "largest diameter of a leg"},
     {"leg_share", 0.8, 0.5, 0.92, "ratio", "outer edge of the legs as a share of the top"},
     {"leg_count", 3, 3, 6, "count", "number of legs"},
     {"tray_share", 0.42, 0.3, 0.5, "ratio", "diameter of the lazy Susan as a share of the top"},
     {"tray_height", 0.035, 0.025, 0.05, "m", "height of the lazy Susan"}},
    layout};

}  // namespace parsel::gallery
