// A Shaker-like chair: slat back, tapered feet, H-shaped stretchers. The back hangs in a frame node that can tilt.
#include "core/gallery/model_builder.h"

namespace parsel::gallery {
namespace {

void layout(ModelBuilder& m) {
  const double width = m["seat_width"], depth = m["seat_depth"], leg_height = m["leg_height"];
  const double seat_thickness = m["seat_thickness"], leg = m["leg_thickness"], post = m["post_thickness"];
  const double back_height = m["back_height"], slat_width = m["slat_width"], tilt = m["back_tilt"];
  const int slat_count = m.count("slat_count");
  const double overlap = 0.003;
  const MaterialId wood = m.material(finish::oak), fabric = m.material(finish::sage);

  // Positions are shares of the seat's size, so that widening the seat carries everything along.
  const double leg_x = m["leg_spread"] * width / 2, leg_z = m["leg_spread"] * depth / 2;
  const double seat_bottom = leg_height - overlap, seat_top = seat_bottom + seat_thickness;
  const double post_x = 0.86 * width / 2, post_z = -0.88 * depth / 2;

  const MeshId seat_mesh = m.mesh("seat", {width, seat_thickness, depth}, fabric, cushion(0.016, 0.006));
  const NodeId seat = m.part("seat", seat_mesh, {0, seat_bottom + seat_thickness / 2, 0});

  const MeshId leg_mesh = m.mesh("leg", {leg, leg_height, leg}, wood, tapered_box(0.005, 0.62, 0.4));
  const auto leg_at = [&](int x, int z) { return m.part("leg", leg_mesh, {x * leg_x, leg_height / 2, z * leg_z}); };
  const NodeId front_left = leg_at(1, 1), front_right = leg_at(-1, 1), back_left = leg_at(1, -1),
               back_right = leg_at(-1, -1);
  m.reflect(0, {{front_left, front_right}, {back_left, back_right}});
  m.reflect(2, {{front_left, back_left}, {front_right, back_right}});
  m.attach({seat}, {front_left, front_right, back_left, back_right}, RelationKind::point);
  m.stand({front_left, front_right, back_left, back_right});

  const double bar = 0.022, bar_y = 0.48 * leg_height;
  const double bar_length = 2 * (leg_z - leg / 2 + overlap);
  const MeshId bar_mesh = m.mesh("stretcher", {bar * 0.8, bar, bar_length}, wood, rounded_box(0.004));
  const NodeId bar_left = m.part("stretcher", bar_mesh, {leg_x, bar_y, 0});
  const NodeId bar_right = m.part("stretcher", bar_mesh, {-leg_x, bar_y, 0});
  m.reflect(0, {{bar_left, bar_right}});
  m.attach({bar_left}, {front_left, back_left}, RelationKind::line);
  m.attach({bar_right}, {front_right, back_right}, RelationKind::line);
  const double cross_length = 2 * (leg_x - 0.4 * bar + overlap);
  const MeshId cross_mesh = m.mesh("crossbar", {cross_length, bar, bar * 0.8}, wood, rounded_box(0.004));
  const NodeId cross = m.part("crossbar", cross_mesh, {0, bar_y, 0});
  m.attach({cross}, {bar_left, bar_right}, RelationKind::face);

  // The back stands on the seat and turns about the line on which its posts stand.
  const NodeId back = m.frame("back", {{0, seat_top - overlap, post_z}, turn(-Vec3::UnitX(), tilt)});
  const MeshId post_mesh = m.mesh("post", {post, back_height, post}, wood, rounded_box(0.009));
  const NodeId post_left = m.part("post", post_mesh, {post_x, back_height / 2, 0}, back);
  const NodeId post_right = m.part("post", post_mesh, {-post_x, back_height / 2, 0}, back);
  m.reflect(0, {{post_left, post_right}});
  m.attach({seat}, {post_left, post_right}, RelationKind::point);

  const double rail_length = 2 * (post_x - post / 2 + overlap);
  const double crest_height = 0.075, rail_height = 0.035, rail_y = 0.26 * back_height;
  const double crest_y = 0.97 * back_height - crest_height / 2;
  const MeshId crest_mesh = m.mesh("crest", {rail_length, crest_height, 0.02}, wood, arched_box(0.005, 0.012));
  const NodeId crest = m.part("crest", crest_mesh, {0, crest_y, 0}, back);
  const MeshId rail_mesh = m.mesh("cross_rail", {rail_length, rail_height, 0.02}, wood, rounded_box(0.005));
  const NodeId rail = m.part("cross_rail", rail_mesh, {0, rail_y, 0}, back);
  m.attach({crest, rail}, {post_left, post_right}, RelationKind::line);

  // The outer edges of the row of slats keep their share of the rail.
  const double slat_bottom = rail_y + rail_height / 2 - overlap, slat_top = crest_y - crest_height / 2 + overlap;
  const double row = 0.86 * rail_length - slat_width;
  const MeshId slat_mesh = m.mesh("slat", {slat_width, slat_top - slat_bottom, 0.012}, wood, rounded_box(0.004));
  std::vector<NodeId> slats;
  for (int i = 0; i < slat_count; ++i) {
    const double x = row * (0.5 - double(i) / (slat_count - 1));
    slats.push_back(m.part("slat", slat_mesh, {x, (slat_bottom + slat_top) / 2, 0}, back));
  }
  const Side row_of_slats = m.translation(slats);
  m.attach({row_of_slats}, {crest, rail}, RelationKind::face);

  m.edit({"widen", "Widen the chair.", {seed_scale_1d(seat, Vec3::UnitX())}, {}, {{row_of_slats, "change_delta"}}},
         [=](double x) {
           return GalleryValues{{"seat_width", width * (1 + x)}};
         });
  m.edit({"longer_legs",
          "Make the legs longer so that the seat is higher.",
          {seed_scale_1d(front_left, Vec3::UnitY(), {0, -1, 0})},
          {},
          {}},
         [=](double x) {
           return GalleryValues{{"leg_height", leg_height * (1 + x)}};
         });
  m.edit({"lean_back",
          "Lean the back of the chair backwards.",
          {seed_rotate(post_left, -Vec3::UnitX(), {0, -1, 0})},
          {},
          {{crest, "rotate"}, {rail, "rotate"}, {row_of_slats, "rotate"}}},
         [=](double x) {
           return GalleryValues{{"back_tilt", tilt + x}};
         });
}

}  // namespace

extern const GalleryModel chair;
const GalleryModel chair = {"chair",
                            "Chair with back slats",
                            {{"seat_width", 0.46, 0.28, 0.65, "m", "width of the seat"},
                             {"seat_depth", 0.43, 0.28, 0.6, "m", "depth of the seat"},
                             {"seat_thickness", 0.04, 0.03, 0.08, "m", "thickness of the seat"},
                             {"leg_height", 0.43, 0.25, 0.62, "m", "from the floor to the seat"},
                             {"leg_thickness", 0.038, 0.03, 0.05, "m", "section of the legs"},
                             {"leg_spread", 0.86, 0.7, 0.9, "ratio", "distance of the legs as a share of the seat"},
                             {"post_thickness", 0.034, 0.028, 0.045, "m", "section of the back posts"},
                             {"back_height", 0.48, 0.36, 0.7, "m", "length of the back posts"},
                             {"back_tilt", 0, -0.4, 0.4, "rad", "lean of the back, backwards positive"},
                             {"slat_count", 5, 3, 7, "count", "number of slats"},
                             {"slat_width", 0.026, 0.012, 0.03, "m", "width of a slat"}},
                            layout};

}  // namespace parsel::gallery
