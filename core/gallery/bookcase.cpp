// A bookcase: two sides, a row of equal boards from the floor to the top, and a back.
#include <cmath>

#include "core/gallery/model_builder.h"

namespace parsel::gallery {
namespace {

void layout(ModelBuilder& m) {
  const double inner = m["inner_width"], height = m["height"], depth = m["depth"];
  const double side = m["side_thickness"], board = m["shelf_thickness"], back = m["back_thickness"];
  const double recess = m["shelf_recess"];
  const int count = m.count("shelf_count");
  const double overlap = 0.003;
  const MaterialId wood = m.material(finish::birch), paint = m.material(finish::teal);

  const MeshId side_mesh = m.mesh("side", {side, height, depth}, wood, rounded_box(0.004));
  const double side_x = inner / 2 + side / 2;
  const NodeId left = m.part("side", side_mesh, {side_x, height / 2, 0});
  const NodeId right = m.part("side", side_mesh, {-side_x, height / 2, 0});
  m.reflect(0, {{left, right}});

  const double length = inner + 2 * overlap;
  const MeshId back_mesh = m.mesh("back", {length, height, back}, paint, rounded_box(0.002, 1));
  const NodeId panel = m.part("back", back_mesh, {0, height / 2, -depth / 2 + recess + overlap - back / 2});
  m.attach({panel}, {left, right}, RelationKind::line);

  const MeshId shelf_mesh = m.mesh("shelf", {length, board, depth - 2 * recess}, wood, rounded_box(0.004));
  std::vector<NodeId> shelves;
  for (int i = 0; i < count; ++i) {
    const double y = board / 2 + (height - board) * i / (count - 1);
    shelves.push_back(m.part("shelf", shelf_mesh, {0, y, 0}, NodeId::none, "shelf." + std::to_string(i + 1)));
  }
  const Side row = m.translation(shelves);
  m.attach({row}, {left, right, panel}, RelationKind::face);
  m.stand({left, right, panel, row});

  const double spacing = (height - board) / (count - 1);
  m.edit({"widen", "Widen the bookcase.", {seed_scale_1d(panel, Vec3::UnitX())}, {}, {}}, [=](double x) {
    return GalleryValues{{"inner_width", inner * (1 + x)}};
  });
  m.edit({"raise",
          "Make the bookcase taller, the shelves further apart.",
          {seed_scale_1d(left, Vec3::UnitY(), {0, -1, 0})},
          {},
          {{row, "change_delta"}}},
         [=](double x) {
           return GalleryValues{{"height", height * (1 + x)}};
         });
  m.edit({"add_shelves", "Put more shelves into the bookcase.", {seed_change_count("t1", "fit", "8*x")}, {}, {}},
         [=](double x) {
           return GalleryValues{{"shelf_count", count + std::floor(8 * x + 1e-9)}};
         });
  m.edit({"add_shelves_on_top",
          "Add shelves of the same spacing and raise the sides to hold them.",
          {seed_change_count("t1", "start", "8*x")},
          {},
          {}},
         [=](double x) {
           const double more = std::floor(8 * x + 1e-9);
           return GalleryValues{{"shelf_count", count + more}, {"height", height + more * spacing}};
         });
}

}  // namespace

extern const GalleryModel bookcase;
const GalleryModel bookcase = {"bookcase",
                               "Bookcase",
                               {{"inner_width", 0.8, 0.5, 1.2, "m", "width between the sides"},
                                {"height", 1.8, 0.7, 2.6, "m", "height of the sides"},
                                {"depth", 0.3, 0.2, 0.45, "m", "depth of the sides"},
                                {"side_thickness", 0.025, 0.018, 0.04, "m", "thickness of the sides"},
                                {"shelf_thickness", 0.024, 0.015, 0.04, "m", "thickness of a shelf"},
                                {"shelf_recess", 0.024, 0.02, 0.035, "m", "how far the shelves stand back"},
                                {"back_thickness", 0.018, 0.012, 0.02, "m", "thickness of the back"},
                                {"shelf_count", 6, 3, 8, "count", "number of boards, top and bottom included"}},
                               layout};

}  // namespace parsel::gallery
