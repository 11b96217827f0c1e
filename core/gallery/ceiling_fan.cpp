// A ceiling fan with a lamp, shown at the height where its globe touches the ground.
#include <cmath>

#include "core/base/tolerance.h"
#include "core/gallery/model_builder.h"

namespace parsel::gallery {
namespace {

void layout(ModelBuilder& m) {
  // Span multiplies motor, blades and globe across the axis.
  const double span = m["span"], globe_height = m["globe_height"], motor_height = m["motor_height"];
  const double rod_length = m["rod_length"], canopy_height = m["canopy_height"], rod_diameter = m["rod_diameter"];
  const int count = m.count("blade_count");
  const double overlap = 0.003;
  const MaterialId metal = m.material(finish::steel), wood = m.material(finish::walnut);
  const MaterialId glass = m.material(finish::white);
  const auto round = [](double diameter, double height) { return Vec3(diameter, height, diameter); };

  const MeshId globe_mesh =
      m.mesh("globe", round(span * m["globe_diameter"], globe_height), glass,
             turned({{0.15, 0}, {0.5, 0.06}, {0.8, 0.2}, {0.96, 0.42}, {1, 0.62}, {0.93, 0.84}, {0.85, 1}}, 48));
  const NodeId globe = m.part("globe", globe_mesh, {0, globe_height / 2, 0});
  const double motor_bottom = globe_height - overlap;
  const MeshId motor_mesh = m.mesh("motor", round(span * m["motor_diameter"], motor_height), metal,
                                   turned({{0.86, 0}, {1, 0.12}, {1, 0.62}, {0.8, 0.84}, {0.42, 1}}, 48));
  const NodeId motor = m.part("motor", motor_mesh, {0, motor_bottom + motor_height / 2, 0});
  const double rod_bottom = motor_bottom + motor_height - overlap;
  const MeshId rod_mesh = m.mesh("rod", round(rod_diameter, rod_length), metal, cylinder(0.002, 20));
  const NodeId rod = m.part("rod", rod_mesh, {0, rod_bottom + rod_length / 2, 0});
  const MeshId canopy_mesh = m.mesh("canopy", round(m["canopy_diameter"], canopy_height), metal,
                                    turned({{0.3, 0}, {0.55, 0.16}, {0.82, 0.45}, {1, 0.85}, {1, 1}}, 40));
  const NodeId canopy = m.part("canopy", canopy_mesh, {0, rod_bottom + rod_length - overlap + canopy_height / 2, 0});
  m.attach({motor}, {globe, rod}, RelationKind::face);
  m.attach(canopy, rod, RelationKind::face);

  const double inner = 0.38 * span * m["motor_diameter"], outer = span * m["blade_reach"];
  const double blade_y = motor_bottom + 0.3 * motor_height;
  const MeshId blade_mesh =
      m.mesh("blade", {span * m["blade_width"], 0.012, outer - inner}, wood, [](const Vec3& size) {
        // A paddle: broad at the tip, narrow at the motor, flat.
        const Solid flat = prism({{-0.45, -1},
                                  {0.45, -1},
                                  {0.55, -0.7},
                                  {1, 0.55},
                                  {0.98, 0.85},
                                  {0.75, 1},
                                  {-0.75, 1},
                                  {-0.98, 0.85},
                                  {-1, 0.55},
                                  {-0.55, -0.7}},
                                 0.003);
        TriangleMesh mesh = flat({size.x(), size.z(), size.y()});
        const auto lie = [](Vec3& v) { v = Vec3(-v.x(), v.z(), v.y()); };
        for (Vec3& p : mesh.positions) lie(p);
        for (Vec3& n : mesh.normals) lie(n);
        return mesh;
      });
  std::vector<NodeId> blades;
  for (int i = 0; i < count; ++i) {
    const double angle = 2 * pi * i / count;
    const Vec3 outward(std::sin(angle), 0, std::cos(angle));
    blades.push_back(
        m.part("blade", blade_mesh, {Vec3(0, blade_y, 0) + (inner + outer) / 2 * outward, turn(Vec3::UnitY(), angle)}));
  }
  // Fewer than three blades are no ring, and only the default number has relations to state.
  const Side ring = count > 2 ? m.rotation(blades) : Side(blades.front());
  m.attach(ring, motor, RelationKind::face);

  m.edit({"longer_rod", "Hang the fan on a longer rod.", {seed_scale_1d(rod, Vec3::UnitY(), {0, -1, 0})}, {}, {}},
         [=](double x) {
           return GalleryValues{{"rod_length", rod_length * (1 + x)}};
         });
  m.edit({"larger_span",
          "Make the fan's motor and blades larger across.",
          {seed_scale_2d(motor, Vec3::UnitY())},
          {},
          {{ring, "scale"}, {globe, "scale"}}},
         [=](double x) {
           return GalleryValues{{"span", span * (1 + x)}};
         });
  m.edit({"more_blades", "Give the fan more blades.", {seed_change_count("o1", "fit", "6*x")}, {}, {}}, [=](double x) {
    return GalleryValues{{"blade_count", count + std::floor(6 * x + 1e-9)}};
  });
}

}  // namespace

extern const GalleryModel ceiling_fan;
const GalleryModel ceiling_fan = {"ceiling_fan",
                                  "Ceiling fan with a lamp",
                                  {{"span", 1, 0.6, 1.4, "ratio", "factor on motor, blades and globe across the axis"},
                                   {"blade_count", 4, 1, 6, "count", "number of blades"},
                                   {"blade_reach", 0.6, 0.4, 0.8, "m", "from the axis to the tip of a blade"},
                                   {"blade_width", 0.14, 0.1, 0.18, "m", "largest width of a blade"},
                                   {"motor_diameter", 0.24, 0.2, 0.3, "m", "diameter of the motor"},
                                   {"motor_height", 0.13, 0.1, 0.18, "m", "height of the motor"},
                                   {"globe_diameter", 0.2, 0.15, 0.2, "m", "diameter of the globe"},
                                   {"globe_height", 0.1, 0.07, 0.14, "m", "height of the globe"},
                                   {"rod_length", 0.3, 0.18, 0.5, "m", "length of the rod"},
                                   {"rod_diameter", 0.026, 0.02, 0.03, "m", "diameter of the rod"},
                                   {"canopy_diameter", 0.15, 0.1, 0.2, "m", "diameter of the canopy"},
                                   {"canopy_height", 0.06, 0.04, 0.1, "m", "height of the canopy"}},
                                  layout};

}  // namespace parsel::gallery
