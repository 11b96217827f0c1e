// A garden pavilion: eight columns in a ring under an eight-sided roof.
#include <cmath>

#include "core/base/tolerance.h"
#include "core/gallery/model_builder.h"

namespace parsel::gallery {
namespace {

void layout(ModelBuilder& m) {
  const double diameter = m["diameter"], floor_height = m["floor_height"], step_height = m["step_height"];
  const double column_height = m["column_height"], column = m["column_diameter"], roof_height = m["roof_height"];
  const int count = m.count("column_count");
  const double overlap = 0.006;
  const MaterialId stone = m.material(finish::slate), wood = m.material(finish::oak);
  const MaterialId paint = m.material(finish::white), roof_paint = m.material(finish::forest);
  const MaterialId brass = m.material(finish::brass);
  const auto round = [](double width, double height) { return Vec3(width, height, width); };

  const MeshId step_mesh = m.mesh("step", round(1.12 * diameter, step_height), stone, faceted(8, 0.985, 0, 0.08));
  const NodeId step = m.part("step", step_mesh, {0, step_height / 2, 0});
  const double floor_bottom = step_height - overlap, floor_top = floor_bottom + floor_height;
  const MeshId floor_mesh = m.mesh("floor", round(diameter, floor_height), wood, faceted(8, 0.985, 0, 0.08));
  const NodeId floor = m.part("floor", floor_mesh, {0, floor_bottom + floor_height / 2, 0});
  m.attach(step, floor, RelationKind::face);
  m.stand({step});

  const double column_y = floor_top - overlap + column_height / 2;
  const double radius = m["column_share"] * diameter / 2 - column / 2;
  const MeshId column_mesh = m.mesh("column", {column, column_height, column}, paint,
                                    turned({{1, 0},
                                            {1, 0.03},
                                            {0.84, 0.04},
                                            {0.84, 0.05},
                                            {0.74, 0.065},
                                            {0.7, 0.3},
                                            {0.66, 0.7},
                                            {0.62, 0.93},
                                            {0.78, 0.945},
                                            {0.78, 0.955},
                                            {1, 0.965},
                                            {1, 1}},
                                           20));
  std::vector<NodeId> columns;
  for (int i = 0; i < count; ++i) {
    const double angle = 2 * pi * i / count;
    columns.push_back(
        m.part("column", column_mesh,
               {{radius * std::sin(angle), column_y, radius * std::cos(angle)}, turn(Vec3::UnitY(), angle)}));
  }
  const Side ring = m.rotation(columns);
  m.attach(ring, floor, RelationKind::face);

  const double roof_bottom = column_y + column_height / 2 - overlap;
  const MeshId roof_mesh =
      m.mesh("roof", round(m["roof_share"] * diameter, roof_height), roof_paint, faceted(8, 0.035, 0, 0.09));
  const NodeId roof = m.part("roof", roof_mesh, {0, roof_bottom + roof_height / 2, 0});
  m.attach(ring, roof, RelationKind::face);
  const double finial_height = m["finial_height"];
  const MeshId finial_mesh = m.mesh("finial", {0.13, finial_height, 0.13}, brass,
                                    turned({{0.5, 0},
                                            {0.8, 0.06},
                                            {0.35, 0.16},
                                            {0.4, 0.22},
                                            {0.85, 0.34},
                                            {1, 0.48},
                                            {0.82, 0.62},
                                            {0.35, 0.74},
                                            {0.12, 0.88},
                                            {0.05, 1}},
                                           24));
  const NodeId finial = m.part("finial", finial_mesh, {0, roof_bottom + roof_height - 0.02 + finial_height / 2, 0});
  m.attach(roof, finial, RelationKind::face);

  const double metres = m.half_diagonal();
  m.edit({"widen",
          "Make the pavilion wider with its columns further out.",
          {seed_scale_2d(floor, Vec3::UnitY())},
          {},
          {{ring, "change_delta"}}},
         [=](double x) {
           return GalleryValues{{"diameter", diameter * (1 + x)}};
         });
  m.edit(
      {"raise_roof", "Raise the roof on longer columns.", {seed_translate(roof, Vec3::UnitY())}, {}, {{ring, "scale"}}},
      [=](double x) {
        return GalleryValues{{"column_height", column_height + x * metres}};
      });
  m.edit({"more_columns", "Use more columns.", {seed_change_count("o1", "fit", "8*x")}, {}, {}}, [=](double x) {
    return GalleryValues{{"column_count", count + std::floor(8 * x + 1e-9)}};
  });
}

}  // namespace

extern const GalleryModel gazebo;
const GalleryModel gazebo = {
    "gazebo",
    "Garden pavilion",
    {{"diameter", 3.0, 1.9, 4.1, "m", "width of the floor from corner to corner"},
     {"step_height", 0.14, 0.1, 0.2, "m", "height of the step"},
     {"floor_height", 0.12, 0.08, 0.2, "m", "thickness of the floor"},
     {"column_height", 2.2, 1.0, 3.4, "m", "height of the columns"},
     {"column_diameter", 0.16, 0.12, 0.22, "m", "diameter of a column"},
     {"column_share", 0.92, 0.8, 0.95, "ratio", "outer edge of the columns as a share of the floor"},
     {"column_count", 8, 5, 10, "count", "number of columns"},
     {"roof_share", 1.14, 1.0, 1.25, "ratio", "width of the roof as a share of the floor"},
     {"roof_height", 0.95, 0.6, 1.4, "m", "height of the roof"},
     {"finial_height", 0.34, 0.2, 0.5, "m", "height of the finial"}},
    layout};

}  // namespace parsel::gallery
