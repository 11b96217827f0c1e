// A bar stool: everything about one upright axis, with a foot ring on four spokes.
#include "core/base/tolerance.h"
#include "core/gallery/model_builder.h"

namespace parsel::gallery {
namespace {

void layout(ModelBuilder& m) {
  // Girth multiplies all that is measured across the axis, as a scale of the plane does.
  const double girth = m["girth"], column_height = m["column_height"];
  const double base_height = m["base_height"], seat_height = m["seat_height"];
  const double overlap = 0.003;
  const MaterialId metal = m.material(finish::charcoal), brass = m.material(finish::brass);
  const MaterialId leather = m.material(finish::terracotta);
  const auto round = [&](const char* diameter, double height) {
    return Vec3(girth * m[diameter], height, girth * m[diameter]);
  };

  const MeshId base_mesh = m.mesh("base", round("base_diameter", base_height), metal,
                                  turned({{0.94, 0}, {1, 0.12}, {1, 0.3}, {0.6, 0.62}, {0.22, 0.88}, {0.16, 1}}, 48));
  const NodeId base = m.part("base", base_mesh, {0, base_height / 2, 0});
  const double column_bottom = base_height - overlap, column_top = column_bottom + column_height;
  const MeshId column_mesh = m.mesh("column", round("column_diameter", column_height), metal, cylinder(0.002, 24));
  const NodeId column = m.part("column", column_mesh, {0, (column_bottom + column_top) / 2, 0});
  const MeshId seat_mesh = m.mesh(
      "seat", round("seat_diameter", seat_height), leather,
      turned({{0.5, 0}, {0.9, 0.06}, {0.97, 0.16}, {1, 0.4}, {0.99, 0.66}, {0.93, 0.86}, {0.8, 0.96}, {0.55, 1}}, 48));
  const NodeId seat = m.part("seat", seat_mesh, {0, column_top - overlap + seat_height / 2, 0});
  m.attach({column}, {base, seat}, RelationKind::face);
  m.stand({base});

  const double tube = m["ring_tube"], ring_y = column_bottom + m["ring_level"] * column_height;
  const MeshId ring_mesh = m.mesh("foot_ring", round("ring_diameter", tube), brass, ring(tube / 2));
  const NodeId foot_ring = m.part("foot_ring", ring_mesh, {0, ring_y, 0});
  m.attach(foot_ring, column, RelationKind::face);

  const double inner = 0.3 * girth * m["column_diameter"];
  const double outer = girth * (m["ring_diameter"] - m["ring_tube"]) / 2;
  const MeshId spoke_mesh = m.mesh("spoke", {girth * 0.013, 0.013, outer - inner}, brass, along_z(cylinder(0.001, 12)));
  std::vector<NodeId> spokes;
  for (int i = 0; i < 4; ++i) {
    const double angle = pi / 2 * i;
    const Vec3 outward(std::sin(angle), 0, std::cos(angle));
    spokes.push_back(
        m.part("spoke", spoke_mesh, {Vec3(0, ring_y, 0) + (inner + outer) / 2 * outward, turn(Vec3::UnitY(), angle)}));
  }
  const Side wheel = m.rotation(spokes);
  m.attach(wheel, foot_ring, RelationKind::volume);
  m.attach(wheel, column, RelationKind::face);

  m.edit({"raise", "Make the stool taller.", {seed_scale_1d(column, Vec3::UnitY(), {0, -1, 0})}, {}, {}},
         [=](double x) {
           return GalleryValues{{"column_height", column_height * (1 + x)}};
         });
  m.edit({"widen", "Make the whole stool wider.", {seed_scale_2d(seat, Vec3::UnitY())}, {}, {{wheel, "scale"}}},
         [=](double x) {
           return GalleryValues{{"girth", girth * (1 + x)}};
         });
}

}  // namespace

extern const GalleryModel bar_stool;
const GalleryModel bar_stool = {
    "bar_stool",
    "Bar stool with a foot ring",
    {{"column_height", 0.66, 0.4, 0.95, "m", "length of the column"},
     {"girth", 1, 0.6, 1.4, "ratio", "factor on everything across the axis"},
     {"base_diameter", 0.42, 0.3, 0.5, "m", "diameter of the base"},
     {"base_height", 0.06, 0.03, 0.1, "m", "height of the base"},
     {"column_diameter", 0.055, 0.04, 0.065, "m", "diameter of the column"},
     {"seat_diameter", 0.38, 0.3, 0.48, "m", "diameter of the seat"},
     {"seat_height", 0.08, 0.05, 0.12, "m", "thickness of the seat"},
     {"ring_diameter", 0.36, 0.25, 0.42, "m", "outer diameter of the foot ring"},
     {"ring_tube", 0.022, 0.018, 0.03, "m", "thickness of the foot ring"},
     {"ring_level", 0.36, 0.2, 0.6, "ratio", "height of the ring as a share of the column"}},
    layout};

}  // namespace parsel::gallery
