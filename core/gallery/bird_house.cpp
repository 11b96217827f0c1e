// A bird house on a pole: four walls, a floor and a gabled roof, an entrance with a perch.
#include "core/gallery/model_builder.h"

namespace parsel::gallery {
namespace {

void layout(ModelBuilder& m) {
  const double width = m["width"], depth = m["side_depth"], height = m["wall_height"], wall = m["wall_thickness"];
  const double pole_height = m["pole_height"], pole = m["pole_diameter"], roof_height = m["roof_height"];
  const double overlap = 0.003;
  const MaterialId wood = m.material(finish::sage), trim = m.material(finish::white),
                   roof_paint = m.material(finish::terracotta);
  const MaterialId post_wood = m.material(finish::oak), dark = m.material(finish::charcoal);

  const double foot_height = 0.03;
  const MeshId foot_mesh =
      m.mesh("foot", {m["foot_width"], foot_height, m["foot_width"]}, post_wood, rounded_box(0.006));
  const NodeId foot = m.part("foot", foot_mesh, {0, foot_height / 2, 0});
  const double pole_bottom = foot_height - overlap, pole_top = pole_bottom + pole_height;
  const MeshId pole_mesh = m.mesh("pole", {pole, pole_height, pole}, post_wood, cylinder(0.002, 24));
  const NodeId post = m.part("pole", pole_mesh, {0, pole_bottom + pole_height / 2, 0});
  m.attach(foot, post, RelationKind::face);
  m.stand({foot});

  // Side walls stand between front and back, the floor between all four.
  const double side_x = m["side_share"] * width / 2, front_z = depth / 2 - overlap + wall / 2;
  const double bottom = pole_top - overlap, middle = bottom + height / 2;
  const MeshId front_mesh = m.mesh("front_wall", {width, height, wall}, wood, rounded_box(0.003));
  const NodeId front = m.part("front_wall", front_mesh, {0, middle, front_z});
  const NodeId back = m.part("back_wall", front_mesh, {0, middle, -front_z});
  const MeshId side_mesh = m.mesh("side_wall", {wall, height, depth}, wood, rounded_box(0.003));
  const NodeId left = m.part("left_wall", side_mesh, {side_x, middle, 0});
  const NodeId right = m.part("right_wall", side_mesh, {-side_x, middle, 0});
  m.reflect(2, {{front, back}});
  m.reflect(0, {{left, right}});
  m.attach({front, back}, {left, right}, RelationKind::line);

  const double floor_thickness = 0.02;
  const MeshId floor_mesh =
      m.mesh("floor", {2 * (side_x - wall / 2 + overlap), floor_thickness, depth}, trim, rounded_box(0.002, 1));
  const NodeId floor = m.part("floor", floor_mesh, {0, bottom + floor_thickness / 2, 0});
  m.attach({floor}, {front, back, left, right}, RelationKind::line);
  m.attach(floor, post, RelationKind::face);

  const MeshId roof_mesh = m.mesh("roof", {m["roof_overhang"] * width, roof_height, 1.4 * depth}, roof_paint,
                                  prism({{-1, -1}, {1, -1}, {1, -0.84}, {0, 1}, {-1, -0.84}}, 0.005));
  const NodeId roof = m.part("roof", roof_mesh, {0, bottom + height - overlap + roof_height / 2, 0});
  m.attach({roof}, {front, back, left, right}, RelationKind::line);

  const double outside = front_z + wall / 2, entrance_y = bottom + 0.64 * height, perch_y = bottom + 0.33 * height;
  const MeshId entrance_mesh =
      m.mesh("entrance", {m["entrance_share"] * width, 0.076, 0.014}, dark,
             along_z(turned({{0.98, 0}, {1, 0.5}, {0.92, 0.9}, {0.8, 1}, {0.66, 0.85}, {0.6, 0.45}}, 32)));
  const NodeId entrance = m.part("entrance", entrance_mesh, {0, entrance_y, outside - overlap + 0.007});
  const MeshId perch_mesh = m.mesh("perch", {0.012, 0.012, 0.075}, post_wood, along_z(cylinder(0.003, 16)));
  const NodeId perch = m.part("perch", perch_mesh, {0, perch_y, outside - 2 * overlap + 0.0375});
  m.attach({front}, {entrance, perch}, RelationKind::line);

  m.edit({"widen", "Make the bird house wider.", {seed_scale_1d(roof, Vec3::UnitX())}, {}, {}}, [=](double x) {
    return GalleryValues{{"width", width * (1 + x)}};
  });
  m.edit({"deepen", "Make the bird house deeper.", {seed_scale_1d(left, Vec3::UnitZ())}, {}, {}}, [=](double x) {
    return GalleryValues{{"side_depth", depth * (1 + x)}};
  });
  m.edit({"raise", "Put it on a higher pole.", {seed_scale_1d(post, Vec3::UnitY(), {0, -1, 0})}, {}, {}},
         [=](double x) {
           return GalleryValues{{"pole_height", pole_height * (1 + x)}};
         });
}

}  // namespace

extern const GalleryModel bird_house;
const GalleryModel bird_house = {
    "bird_house",
    "Bird house",
    {{"width", 0.26, 0.16, 0.36, "m", "width of the front"},
     {"side_share", 0.86, 0.8, 0.88, "ratio", "distance of the side walls as a share of the width"},
     {"side_depth", 0.22, 0.14, 0.3, "m", "depth of the side walls"},
     {"wall_height", 0.22, 0.18, 0.3, "m", "height of the walls"},
     {"wall_thickness", 0.016, 0.012, 0.02, "m", "thickness of the walls"},
     {"roof_overhang", 1.35, 1.2, 1.5, "ratio", "width of the roof as a share of the front"},
     {"roof_height", 0.15, 0.1, 0.22, "m", "height of the roof"},
     {"entrance_share", 0.29, 0.22, 0.34, "ratio", "width of the entrance as a share of the front"},
     {"pole_height", 0.62, 0.38, 0.9, "m", "length of the pole"},
     {"pole_diameter", 0.032, 0.028, 0.042, "m", "diameter of the pole"},
     {"foot_width", 0.24, 0.18, 0.3, "m", "width of the foot"}},
    layout};

}  // namespace parsel::gallery
