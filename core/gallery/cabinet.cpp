// A sideboard with two doors. Each door hangs in a frame node at its hinge, its handle in the door.
#include "core/gallery/model_builder.h"

namespace parsel::gallery {
namespace {

void layout(ModelBuilder& m) {
  const double width = m["width"], height = m["height"], depth = m["depth"], foot_height = m["foot_height"];
  const double thickness = m["top_thickness"], door_thickness = m["door_thickness"], opening = m["left_door_angle"];
  const double overlap = 0.003;
  const MaterialId wood = m.material(finish::walnut), paint = m.material(finish::sage),
                   metal = m.material(finish::brass);

  const double bottom = foot_height - overlap, middle = bottom + height / 2;
  const MeshId body_mesh = m.mesh("body", {width, height, depth}, wood, rounded_box(0.006));
  const NodeId body = m.part("body", body_mesh, {0, middle, 0});
  const double top_width = m["top_share"] * width;
  const MeshId top_mesh = m.mesh("worktop", {top_width, thickness, 1.08 * depth}, wood, rounded_box(0.007, 3));
  const NodeId top = m.part("worktop", top_mesh, {0, bottom + height - overlap + thickness / 2, 0});
  m.attach(body, top, RelationKind::face);

  const double foot = m["foot_thickness"], foot_x = 0.42 * width, foot_z = 0.38 * depth;
  const MeshId foot_mesh = m.mesh("foot", {foot, foot_height, foot}, metal, cone(0.55, 1, 0.003, 20));
  const auto foot_at = [&](int x, int z) {
    return m.part("foot", foot_mesh, {x * foot_x, foot_height / 2, z * foot_z});
  };
  const NodeId front_left = foot_at(1, 1), front_right = foot_at(-1, 1), back_left = foot_at(1, -1),
               back_right = foot_at(-1, -1);
  m.reflect(0, {{front_left, front_right}, {back_left, back_right}});
  m.reflect(2, {{front_left, back_left}, {front_right, back_right}});
  m.attach({body}, {front_left, front_right, back_left, back_right}, RelationKind::point);
  m.stand({front_left, front_right, back_left, back_right});

  // Hinges at the doors' outer back edges; a stile of the body shows between the doors.
  const double hinge_x = 0.47 * width, door = 0.445 * width, door_height = 0.92 * height;
  const double handle_x = 0.385 * width, handle = 0.018;
  const MeshId door_mesh = m.mesh("door", {door, door_height, door_thickness}, paint, rounded_box(0.005));
  const MeshId handle_mesh =
      m.mesh("handle", {handle, m["handle_share"] * height, 0.024}, metal, rounded_box(0.006, 3));
  const auto hang = [&](int side, double angle) {
    const NodeId hinge = m.frame(side > 0 ? "left_hinge" : "right_hinge",
                                 {{side * hinge_x, middle, depth / 2 - overlap}, turn(Vec3::UnitY(), angle)});
    const NodeId panel = m.part("door", door_mesh, {-side * door / 2, 0, door_thickness / 2}, hinge);
    const NodeId grip =
        m.part("handle", handle_mesh, {-side * (handle_x - door / 2), 0, door_thickness / 2 - overlap + 0.012}, panel);
    m.attach(panel, body, RelationKind::line);
    m.attach(grip, panel, RelationKind::line);
    return std::pair(panel, grip);
  };
  const auto [left_door, left_handle] = hang(1, opening);
  const auto [right_door, right_handle] = hang(-1, 0);
  m.reflect(0, {{left_door, right_door}, {left_handle, right_handle}});

  m.edit({"open_left_door",
          "Open the left door.",
          {seed_rotate(left_door, Vec3::UnitY(), {1, 0, -1})},
          {"kind:reflection"},
          {{body, "keep_fixed"}, {left_handle, "rotate"}}},
         [=](double x) {
           return GalleryValues{{"left_door_angle", opening + x}};
         });
  m.edit({"widen",
          "Widen the cabinet with its doors.",
          {seed_scale_1d(body, Vec3::UnitX())},
          {},
          {{left_door, "scale"}, {right_door, "scale"}}},
         [=](double x) {
           return GalleryValues{{"width", width * (1 + x)}};
         });
  m.edit({"taller_feet",
          "Put the cabinet on taller feet.",
          {seed_scale_1d(front_left, Vec3::UnitY(), {0, -1, 0})},
          {},
          {}},
         [=](double x) {
           return GalleryValues{{"foot_height", foot_height * (1 + x)}};
         });
}

}  // namespace

extern const GalleryModel cabinet;
const GalleryModel cabinet = {
    "cabinet",
    "Sideboard with two doors",
    {{"width", 1.2, 0.75, 1.7, "m", "width of the body"},
     {"height", 0.62, 0.4, 0.9, "m", "height of the body"},
     {"depth", 0.42, 0.3, 0.6, "m", "depth of the body"},
     {"top_share", 1.04, 1.0, 1.1, "ratio", "width of the top as a share of the body"},
     {"top_thickness", 0.03, 0.02, 0.05, "m", "thickness of the top"},
     {"foot_height", 0.16, 0.1, 0.25, "m", "height of the feet"},
     {"foot_thickness", 0.045, 0.03, 0.06, "m", "largest diameter of a foot"},
     {"door_thickness", 0.024, 0.02, 0.03, "m", "thickness of the doors"},
     {"handle_share", 0.28, 0.15, 0.5, "ratio", "length of a handle as a share of the height"},
     {"left_door_angle", 0, -0.4, 1.6, "rad", "how far the left door stands open"}},
    layout};

}  // namespace parsel::gallery
