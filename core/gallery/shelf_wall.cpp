// A wall of shelves of any size, to measure how time grows with the number of parts.
//
// Every board has a label of its own, so that no symmetry shortens the work and each part is a node of the graph.
#include <algorithm>
#include <cmath>

#include "core/gallery/model_builder.h"

namespace parsel::gallery {

Result<GalleryAsset> build_shelf_wall(int part_count) {
  if (part_count < 5 || part_count > 1000) {
    return Error{"gallery/shelf_wall", std::to_string(part_count), "the number of parts is out of range",
                 "use a number from 5 to 1000"};
  }
  // Bays of one upright, one back and shelves each, and a last upright: about as wide as high.
  const int bays = std::max(1, static_cast<int>(std::lround(std::sqrt(part_count / 5.0))));
  const int shelves = part_count - 2 * bays - 1;
  const int highest = (shelves + bays - 1) / bays;
  const double pitch = 0.34, depth = 0.32, thickness = 0.045, overlap = 0.003;
  const double height = pitch * (highest + 1), bay = 0.8;

  const GalleryModel model{"shelf_wall_" + std::to_string(part_count), "Wall of shelves", {}, nullptr};
  const NominalSizes own_sizes;
  ModelBuilder m(model, {}, &own_sizes);
  const MaterialId wood = m.material(finish::oak), paint = m.material(finish::white);
  const auto numbered = [](const char* stem, int i) {
    // Letters, as a number at the end would be a counter of one label.
    return std::string(stem) + "_" + char('a' + i / 100) + char('a' + i / 10 % 10) + char('a' + i % 10);
  };

  const MeshId upright_mesh = m.mesh("upright", {thickness, height, depth}, wood, rounded_box(0.004, 1));
  const MeshId back_mesh = m.mesh("back", {bay - thickness + 2 * overlap, height, 0.03}, paint, rounded_box(0.002, 1));
  const MeshId shelf_mesh =
      m.mesh("shelf", {bay - thickness + 2 * overlap, 0.03, 0.8 * depth}, wood, rounded_box(0.004, 1));
  std::vector<NodeId> uprights;
  for (int i = 0; i <= bays; ++i) {
    uprights.push_back(m.part(numbered("upright", i), upright_mesh, {bay * (i - bays / 2.0), height / 2, 0}));
  }
  int placed = 0;
  for (int i = 0; i < bays; ++i) {
    const auto side = static_cast<std::size_t>(i);
    const double x = bay * (i + 0.5 - bays / 2.0);
    const NodeId back = m.part(numbered("back", i), back_mesh, {x, height / 2, -0.4 * depth - 0.015 + overlap});
    m.attach({back}, {uprights[side], uprights[side + 1]}, RelationKind::line);
    const int in_bay = shelves / bays + (i < shelves % bays ? 1 : 0);
    for (int k = 0; k < in_bay; ++k) {
      const NodeId shelf = m.part(numbered("shelf", placed++), shelf_mesh, {x, pitch * (k + 0.6), 0});
      m.attach({shelf}, {uprights[side], uprights[side + 1], back}, RelationKind::line);
    }
  }
  return m.finish();
}

}  // namespace parsel::gallery
