// A wagon wheel: tyre, rim, hub and spokes about one axis that looks to the front.
#include <cmath>

#include "core/base/tolerance.h"
#include "core/gallery/model_builder.h"

namespace parsel::gallery {
namespace {

void layout(ModelBuilder& m) {
  // Size multiplies everything; breadth multiplies what is measured along the axis.
  const double size = m["size"], breadth = size * m["breadth"];
  const double diameter = size * m["diameter"], tyre_tube = size * m["tyre_thickness"];
  const double rim_tube = size * m["rim_thickness"], hub = size * m["hub_diameter"],
               spoke = size * m["spoke_thickness"];
  const int count = m.count("spoke_count");
  const MaterialId iron = m.material(finish::charcoal), wood = m.material(finish::cedar),
                   brass = m.material(finish::brass);
  const double y = diameter / 2;
  const auto hoop = [](double tube) {
    return along_z([=](const Vec3& box) {
      // A hoop of rectangular section: thickness `tube` of the radius, as wide as its box.
      return shade(tube, 1.0, 64)(box);
    });
  };

  const MeshId tyre_mesh = m.mesh("tyre", {diameter, diameter, 0.062 * breadth}, iron, hoop(m["tyre_thickness"]));
  const NodeId tyre = m.part("tyre", tyre_mesh, {0, y, 0});
  const double rim_diameter = diameter - 2 * tyre_tube + 0.004 * size;
  const MeshId rim_mesh = m.mesh("rim", {rim_diameter, rim_diameter, 0.054 * breadth}, wood, hoop(m["rim_thickness"]));
  const NodeId rim = m.part("rim", rim_mesh, {0, y, 0});
  const MeshId hub_mesh = m.mesh(
      "hub", {hub, hub, 0.19 * breadth}, wood,
      along_z(turned({{0.6, 0}, {0.62, 0.12}, {0.8, 0.24}, {1, 0.36}, {1, 0.64}, {0.8, 0.76}, {0.62, 0.88}, {0.6, 1}},
                     40)));
  const NodeId nave = m.part("hub", hub_mesh, {0, y, 0});
  const MeshId cap_mesh = m.mesh("axle", {0.42 * hub, 0.42 * hub, 0.23 * breadth}, brass, along_z(cylinder(0.004, 24)));
  const NodeId axle = m.part("axle", cap_mesh, {0, y, 0});

  const double inner = 0.3 * hub, outer = rim_diameter / 2 - 0.75 * rim_tube;
  const MeshId spoke_mesh = m.mesh("spoke", {spoke, outer - inner, 0.034 * breadth}, wood,
                                   turned({{0.7, 0}, {0.86, 0.2}, {1, 0.42}, {0.92, 0.7}, {0.75, 1}}, 16));
  std::vector<NodeId> spokes;
  for (int i = 0; i < count; ++i) {
    const double angle = 2 * pi * i / count;
    const Vec3 outward(-std::sin(angle), std::cos(angle), 0);
    spokes.push_back(
        m.part("spoke", spoke_mesh, {Vec3(0, y, 0) + (inner + outer) / 2 * outward, turn(Vec3::UnitZ(), angle)}));
  }
  const Side ring = m.rotation(spokes);
  // All is centred about one point, so that whatever touches, and whatever one hoop's box holds, is tied in full.
  m.attach({tyre}, {rim, nave, axle, ring}, RelationKind::volume);
  m.attach({rim}, {nave, axle, ring}, RelationKind::volume);
  m.attach({nave}, {axle, ring}, RelationKind::volume);
  m.attach(axle, ring, RelationKind::volume);

  m.edit({"enlarge", "Make the whole wheel larger.", {seed_scale_3d(tyre, {0, -1, 0})}, {}, {}}, [=](double x) {
    return GalleryValues{{"size", size * (1 + x)}};
  });
  m.edit({"broaden", "Make the wheel broader.", {seed_scale_1d(tyre, Vec3::UnitZ())}, {}, {}},
         [breadth = m["breadth"]](double x) {
           return GalleryValues{{"breadth", breadth * (1 + x)}};
         });
  m.edit({"more_spokes", "Give the wheel more spokes.", {seed_change_count("o1", "fit", "12*x")}, {}, {}},
         [=](double x) {
           return GalleryValues{{"spoke_count", count + std::floor(12 * x + 1e-9)}};
         });
}

}  // namespace

extern const GalleryModel wagon_wheel;
const GalleryModel wagon_wheel = {"wagon_wheel",
                                  "Wagon wheel",
                                  {{"size", 1, 0.6, 1.4, "ratio", "factor on everything"},
                                   {"breadth", 1, 0.6, 1.4, "ratio", "factor on everything along the axis"},
                                   {"diameter", 0.9, 0.6, 1.2, "m", "outer diameter"},
                                   {"tyre_thickness", 0.014, 0.01, 0.03, "m", "thickness of the tyre"},
                                   {"rim_thickness", 0.05, 0.035, 0.07, "m", "thickness of the rim"},
                                   {"hub_diameter", 0.17, 0.13, 0.22, "m", "diameter of the hub"},
                                   {"spoke_thickness", 0.036, 0.025, 0.045, "m", "largest width of a spoke"},
                                   {"spoke_count", 8, 3, 12, "count", "number of spokes"}},
                                  layout};

}  // namespace parsel::gallery
