// An armchair: a base between two upholstered arms on tapered feet, with a backrest and two loose cushions.
#include "core/gallery/model_builder.h"

namespace parsel::gallery {
namespace {

void layout(ModelBuilder& m) {
  const double inner = m["inner_width"], depth = m["depth"], foot_height = m["foot_height"];
  const double arm = m["arm_thickness"], arm_height = m["arm_height"], base_height = m["base_height"];
  const double back_thickness = m["back_thickness"], back_height = m["back_height"];
  const double cushion_height = m["cushion_height"];
  const double overlap = 0.003;
  const MaterialId fabric = m.material(finish::slate), soft = m.material(finish::linen);
  const MaterialId wood = m.material(finish::walnut);

  const double arm_x = inner / 2 - overlap + arm / 2, bottom = foot_height - overlap;
  const MeshId arm_mesh = m.mesh("arm", {arm, arm_height, depth}, fabric, cushion(0.045, 0.01));
  const NodeId arm_left = m.part("arm", arm_mesh, {arm_x, bottom + arm_height / 2, 0});
  const NodeId arm_right = m.part("arm", arm_mesh, {-arm_x, bottom + arm_height / 2, 0});
  m.reflect(0, {{arm_left, arm_right}});

  const double foot_x = m["foot_share"] * arm, foot_z = 0.4 * depth;
  const MeshId foot_mesh = m.mesh("foot", {foot_x, foot_height, 0.05}, wood, tapered_box(0.006, 0.6));
  const auto foot_at = [&](int x, int z) {
    return m.part("foot", foot_mesh, {x * arm_x, foot_height / 2, z * foot_z});
  };
  const NodeId front_left = foot_at(1, 1), front_right = foot_at(-1, 1), back_left = foot_at(1, -1),
               back_right = foot_at(-1, -1);
  m.reflect(0, {{front_left, front_right}, {back_left, back_right}});
  m.reflect(2, {{front_left, back_left}, {front_right, back_right}});
  m.attach({arm_left}, {front_left, back_left}, RelationKind::line);
  m.attach({arm_right}, {front_right, back_right}, RelationKind::line);
  m.stand({front_left, front_right, back_left, back_right});

  const double base_bottom = bottom + 0.03, base_top = base_bottom + base_height;
  const MeshId base_mesh = m.mesh("base", {inner, base_height, depth * 0.96}, fabric, rounded_box(0.012));
  const NodeId base = m.part("base", base_mesh, {0, (base_bottom + base_top) / 2, 0});
  m.attach({base}, {arm_left, arm_right}, RelationKind::line);

  // The backrest keeps clear of the arms; the seat cushion fills the width between them.
  const double back_width = 0.93 * inner, back_z = -0.48 * depth + back_thickness / 2;
  const MeshId back_mesh = m.mesh("backrest", {back_width, back_height, back_thickness}, fabric, cushion(0.05, 0.012));
  const NodeId back = m.part("backrest", back_mesh, {0, base_top - overlap + back_height / 2, back_z});
  m.attach(back, base, RelationKind::line);

  const double back_front = back_z + back_thickness / 2;
  const double seat_depth = 0.49 * depth - back_front + overlap, seat_z = back_front - overlap + seat_depth / 2;
  const double seat_y = base_top - overlap + cushion_height / 2;
  const MeshId seat_mesh = m.mesh("seat_cushion", {inner, cushion_height, seat_depth}, soft, cushion(0.045, 0.016));
  const NodeId seat = m.part("seat_cushion", seat_mesh, {0, seat_y, seat_z});
  // It lies on most of the base and along most of the arms, though not in their middle.
  m.attach(seat, base, RelationKind::face);
  m.attach(seat, back, RelationKind::line);
  m.attach({seat}, {arm_left, arm_right}, RelationKind::line);

  const double pillow = 0.13, pillow_height = 0.95 * (back_height - cushion_height);
  const MeshId pillow_mesh = m.mesh("back_cushion", {0.86 * inner, pillow_height, pillow}, soft, cushion(0.05, 0.02));
  const NodeId back_cushion =
      m.part("back_cushion", pillow_mesh,
             {0, seat_y + cushion_height / 2 - overlap + pillow_height / 2, back_front - overlap + pillow / 2});
  m.attach(back_cushion, seat, RelationKind::line);
  m.attach(back_cushion, back, RelationKind::face);

  m.edit({"widen", "Make the seat wider.", {seed_scale_1d(base, Vec3::UnitX())}, {}, {}}, [=](double x) {
    return GalleryValues{{"inner_width", inner * (1 + x)}};
  });
  m.edit({"taller_feet",
          "Put the armchair on taller feet.",
          {seed_scale_1d(front_left, Vec3::UnitY(), {0, -1, 0})},
          {},
          {}},
         [=](double x) {
           return GalleryValues{{"foot_height", foot_height * (1 + x)}};
         });
  m.edit({"thicker_arms",
          "Make the arms thicker towards the outside.",
          {seed_scale_1d(arm_left, Vec3::UnitX(), {-1, 0, 0})},
          {},
          {}},
         [=](double x) {
           return GalleryValues{{"arm_thickness", arm * (1 + x)}};
         });
}

}  // namespace

extern const GalleryModel armchair;
const GalleryModel armchair = {
    "armchair",
    "Armchair",
    {{"inner_width", 0.56, 0.35, 0.8, "m", "width between the arms"},
     {"depth", 0.78, 0.6, 1.0, "m", "depth of the arms"},
     {"foot_height", 0.13, 0.08, 0.2, "m", "height of the feet"},
     {"foot_share", 0.36, 0.25, 0.45, "ratio", "width of a foot as a share of the arm's thickness"},
     {"arm_thickness", 0.15, 0.09, 0.21, "m", "thickness of the arms"},
     {"arm_height", 0.48, 0.42, 0.6, "m", "height of the arms above the feet"},
     {"base_height", 0.17, 0.12, 0.2, "m", "height of the base"},
     {"cushion_height", 0.14, 0.1, 0.17, "m", "thickness of the seat cushion"},
     {"back_thickness", 0.13, 0.1, 0.18, "m", "thickness of the backrest"},
     {"back_height", 0.56, 0.45, 0.8, "m", "height of the backrest above the base"}},
    layout};

}  // namespace parsel::gallery
