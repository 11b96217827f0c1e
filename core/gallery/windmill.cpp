// A tower mill: an eight-sided tower, a cap, and four sails on a hub that looks to the front.
#include <cmath>

#include "core/base/tolerance.h"
#include "core/gallery/model_builder.h"

namespace parsel::gallery {
namespace {

void layout(ModelBuilder& m) {
  const double tower_height = m["tower_height"], tower = m["tower_width"], cap_height = m["cap_height"];
  const double hub = m["hub_diameter"], reach = m["sail_reach"], sail_width = m["sail_width"];
  const int count = m.count("sail_count");
  const double overlap = 0.006;
  const MaterialId wall = m.material(finish::cream), roof = m.material(finish::terracotta);
  const MaterialId dark = m.material(finish::walnut), cloth = m.material(finish::linen),
                   blue = m.material(finish::teal);

  const MeshId tower_mesh = m.mesh("tower", {tower, tower_height, tower}, wall, faceted(8, 0.62, pi / 8, 0.06));
  const NodeId body = m.part("tower", tower_mesh, {0, tower_height / 2, 0});
  const double cap = 0.74 * tower, cap_bottom = tower_height - overlap;
  const MeshId cap_mesh =
      m.mesh("cap", {cap, cap_height, cap}, roof,
             turned({{0.9, 0}, {1, 0.06}, {0.97, 0.14}, {0.82, 0.42}, {0.55, 0.72}, {0.2, 0.95}, {0.06, 1}}, 32));
  const NodeId roof_cap = m.part("cap", cap_mesh, {0, cap_bottom + cap_height / 2, 0});
  m.attach(body, roof_cap, RelationKind::face);
  m.stand({body});

  // Door and window stand within the tower's box, where its wall leans inwards.
  const double door_height = 0.2 * tower_height, window_height = 0.085 * tower_height;
  const MeshId door_mesh =
      m.mesh("door", {0.17 * tower, door_height, 0.09 * tower}, dark,
             prism({{-1, -1}, {1, -1}, {1, 0.55}, {0.72, 0.86}, {0, 1}, {-0.72, 0.86}, {-1, 0.55}}, 0.008));
  const NodeId door = m.part("door", door_mesh, {0, door_height / 2 + 0.03 * tower_height, 0.445 * tower});
  const MeshId window_mesh = m.mesh("window", {0.11 * tower, window_height, 0.08 * tower}, blue, rounded_box(0.012));
  const NodeId window = m.part("window", window_mesh, {0, 0.52 * tower_height, 0.4 * tower});
  m.attach({body}, {door, window}, RelationKind::volume);

  const double hub_y = cap_bottom + 0.3 * cap_height, hub_length = m["hub_length"];
  const double hub_z = 0.36 * cap + hub_length / 2;
  const MeshId hub_mesh = m.mesh("hub", {hub, hub, hub_length}, dark,
                                 along_z(turned({{0.8, 0}, {0.8, 0.55}, {1, 0.62}, {1, 0.93}, {0.7, 1}}, 24)));
  const NodeId axle = m.part("hub", hub_mesh, {0, hub_y, hub_z});
  m.attach(roof_cap, axle, RelationKind::line);

  const double inner = 0.2 * hub, sail_z = hub_z + 0.31 * hub_length;
  const MeshId sail_mesh = m.mesh("sail", {sail_width, reach - inner, 0.03}, cloth,
                                  prism({{-0.2, -1},
                                         {0.2, -1},
                                         {0.24, -0.72},
                                         {0.8, -0.62},
                                         {1, 0.96},
                                         {0.94, 1},
                                         {-0.94, 1},
                                         {-1, 0.96},
                                         {-0.8, -0.62},
                                         {-0.24, -0.72}},
                                        0.006));
  std::vector<NodeId> sails;
  for (int i = 0; i < count; ++i) {
    const double angle = pi / 4 + 2 * pi * i / count;
    const Vec3 outward(-std::sin(angle), std::cos(angle), 0);
    sails.push_back(m.part("sail", sail_mesh,
                           {Vec3(0, hub_y, sail_z) + (inner + reach) / 2 * outward, turn(Vec3::UnitZ(), angle)}));
  }
  const Side cross = m.rotation(sails);
  m.attach(cross, axle, RelationKind::face);

  m.edit({"raise", "Make the mill taller.", {seed_scale_1d(body, Vec3::UnitY(), {0, -1, 0})}, {}, {}}, [=](double x) {
    return GalleryValues{{"tower_height", tower_height * (1 + x)}};
  });
  m.edit({"more_sails", "Give the mill more sails.", {seed_change_count("o1", "fit", "8*abs(x)")}, {}, {}},
         [=](double x) {
           return GalleryValues{{"sail_count", count + std::floor(8 * std::abs(x) + 1e-9)}};
         });
}

}  // namespace

extern const GalleryModel windmill;
const GalleryModel windmill = {"windmill",
                               "Windmill",
                               {{"tower_height", 2.2, 1.4, 3.0, "m", "height of the tower"},
                                {"tower_width", 1.15, 0.9, 1.3, "m", "width of the tower at its foot"},
                                {"cap_height", 0.5, 0.4, 0.7, "m", "height of the cap"},
                                {"hub_diameter", 0.16, 0.12, 0.2, "m", "diameter of the hub"},
                                {"hub_length", 0.56, 0.5, 0.7, "m", "length of the hub"},
                                {"sail_count", 4, 3, 8, "count", "number of sails"},
                                {"sail_reach", 1.25, 0.9, 1.35, "m", "from the hub's axis to the tip of a sail"},
                                {"sail_width", 0.3, 0.2, 0.34, "m", "width of a sail"}},
                               layout};

}  // namespace parsel::gallery
