// A garden bench: planks across two supports, and boards across two back posts.
#include "core/gallery/model_builder.h"

namespace parsel::gallery {
namespace {

void layout(ModelBuilder& m) {
  const double support_x = m["support_distance"] / 2, height = m["support_height"], depth = m["depth"];
  const double support = m["support_thickness"], plank_width = m["plank_width"], thickness = m["plank_thickness"];
  const double back_height = m["back_height"], board_height = m["board_height"];
  const int planks_count = m.count("plank_count"), boards_count = m.count("board_count");
  const double overlap = 0.003;
  const MaterialId iron = m.material(finish::charcoal), wood = m.material(finish::cedar);

  const MeshId support_mesh = m.mesh("support", {support, height, depth}, iron, rounded_box(0.012, 3));
  const NodeId left = m.part("support", support_mesh, {support_x, height / 2, 0});
  const NodeId right = m.part("support", support_mesh, {-support_x, height / 2, 0});
  m.reflect(0, {{left, right}});

  // The outer edges of the row of planks keep their share of the supports' depth.
  const double length = m["overhang"] * 2 * support_x, row = 0.78 * depth - plank_width;
  const MeshId plank_mesh = m.mesh("plank", {length, thickness, plank_width}, wood, rounded_box(0.007));
  std::vector<NodeId> planks;
  for (int i = 0; i < planks_count; ++i) {
    const double z = row * (0.5 - double(i) / (planks_count - 1));
    planks.push_back(m.part("plank", plank_mesh, {0, height - overlap + thickness / 2, z}));
  }
  const Side seat = m.translation(planks);
  m.attach({seat}, {left, right}, RelationKind::line);
  m.stand({left, right});

  const double post = m["post_thickness"], post_z = -0.94 * depth / 2;
  const MeshId post_mesh = m.mesh("post", {support, back_height, post}, iron, rounded_box(0.007));
  const double post_y = height - overlap + back_height / 2;
  const NodeId post_left = m.part("post", post_mesh, {support_x, post_y, post_z});
  const NodeId post_right = m.part("post", post_mesh, {-support_x, post_y, post_z});
  m.reflect(0, {{post_left, post_right}});
  m.attach(left, post_left, RelationKind::line);
  m.attach(right, post_right, RelationKind::line);

  const double board = 0.02, board_z = post_z + post / 2 - overlap + board / 2;
  const double board_row = 0.66 * back_height - board_height;
  const MeshId board_mesh = m.mesh("board", {length, board_height, board}, wood, rounded_box(0.006));
  std::vector<NodeId> boards;
  for (int i = 0; i < boards_count; ++i) {
    const double y = post_y + board_row * (0.5 - double(i) / (boards_count - 1));
    boards.push_back(m.part("board", board_mesh, {0, y, board_z}));
  }
  const Side back = m.translation(boards);
  m.attach({back}, {post_left, post_right}, RelationKind::line);

  const double metres = m.half_diagonal();
  m.edit({"lengthen",
          "Make the bench longer by moving its supports apart.",
          {seed_translate(left, Vec3::UnitX())},
          {},
          {{seat, "scale"}, {back, "scale"}}},
         [=](double x) {
           return GalleryValues{{"support_distance", 2 * (support_x + x * metres)}};
         });
  m.edit({"raise", "Make the bench higher.", {seed_scale_1d(left, Vec3::UnitY(), {0, -1, 0})}, {}, {}}, [=](double x) {
    return GalleryValues{{"support_height", height * (1 + x)}};
  });
  m.edit({"deepen",
          "Make the seat deeper with more room between the planks.",
          {seed_scale_1d(left, Vec3::UnitZ())},
          {},
          {{seat, "change_delta"}}},
         [=](double x) {
           return GalleryValues{{"depth", depth * (1 + x)}};
         });
}

}  // namespace

extern const GalleryModel bench;
const GalleryModel bench = {
    "bench",
    "Garden bench",
    {{"support_distance", 1.15, 0.5, 1.9, "m", "distance of the supports"},
     {"support_height", 0.42, 0.26, 0.6, "m", "height of the supports"},
     {"support_thickness", 0.06, 0.045, 0.09, "m", "thickness of supports and posts"},
     {"depth", 0.48, 0.3, 0.68, "m", "depth of the supports"},
     {"overhang", 1.26, 1.1, 1.4, "ratio", "length of the planks as a share of the supports' distance"},
     {"plank_count", 4, 3, 5, "count", "number of planks of the seat"},
     {"plank_width", 0.075, 0.03, 0.08, "m", "width of a plank"},
     {"plank_thickness", 0.03, 0.02, 0.04, "m", "thickness of a plank"},
     {"post_thickness", 0.035, 0.03, 0.04, "m", "depth of the back posts"},
     {"back_height", 0.46, 0.35, 0.6, "m", "height of the back posts"},
     {"board_count", 3, 3, 4, "count", "number of boards of the back"},
     {"board_height", 0.07, 0.05, 0.07, "m", "height of a board"}},
    layout};

}  // namespace parsel::gallery
