// A desk on two pedestals, one with drawers and one with a door, and a panel between them.
#include "core/gallery/model_builder.h"

namespace parsel::gallery {
namespace {

void layout(ModelBuilder& m) {
  const double width = m["width"], depth = m["depth"], thickness = m["top_thickness"];
  const double height = m["pedestal_height"], pedestal = m["pedestal_width"], front = m["front_thickness"];
  const int count = m.count("drawer_count");
  const double overlap = 0.003;
  const MaterialId wood = m.material(finish::oak), paint = m.material(finish::navy), brass = m.material(finish::brass);

  const MeshId top_mesh = m.mesh("desktop", {width, thickness, depth}, wood, rounded_box(0.007, 3));
  const NodeId top = m.part("desktop", top_mesh, {0, height - overlap + thickness / 2, 0});
  const double pedestal_x = m["pedestal_spread"] * width / 2, pedestal_depth = 0.88 * depth;
  const MeshId pedestal_mesh = m.mesh("pedestal", {pedestal, height, pedestal_depth}, paint, rounded_box(0.006));
  const NodeId left = m.part("pedestal", pedestal_mesh, {pedestal_x, height / 2, 0});
  const NodeId right = m.part("pedestal", pedestal_mesh, {-pedestal_x, height / 2, 0});
  m.reflect(0, {{left, right}});
  m.attach({top}, {left, right}, RelationKind::line);
  m.stand({left, right});

  const double panel_length = 2 * (pedestal_x - pedestal / 2 + overlap);
  const MeshId panel_mesh = m.mesh("panel", {panel_length, m["panel_height"], 0.02}, paint, rounded_box(0.003));
  const NodeId panel = m.part("panel", panel_mesh, {0, 0.68 * height, -0.3 * depth});
  m.attach({panel}, {left, right}, RelationKind::point);

  // Heights of fronts and handles are shares of the pedestal's.
  const double stack = 0.92 * height, pitch = stack / count, face_z = pedestal_depth / 2 - overlap + front / 2;
  const double handle_z = pedestal_depth / 2 - 2 * overlap + front + 0.0125;
  const MeshId drawer_mesh = m.mesh("drawer", {0.9 * pedestal, pitch - 0.03 * height, front}, wood, rounded_box(0.004));
  const MeshId handle_mesh = m.mesh("handle", {0.38 * pedestal, 0.024 * height, 0.025}, brass, rounded_box(0.006, 3));
  std::vector<NodeId> drawers, handles;
  for (int i = 0; i < count; ++i) {
    const double y = height / 2 + stack / 2 - pitch * (i + 0.5);
    drawers.push_back(m.part("drawer", drawer_mesh, {pedestal_x, y, face_z}));
    handles.push_back(m.part("handle", handle_mesh, Vec3(0, 0, handle_z - face_z), drawers.back()));
  }
  const Side drawer_row = m.translation(drawers), handle_row = m.translation(handles);
  m.attach(drawer_row, left, RelationKind::face);
  m.attach(handle_row, drawer_row, RelationKind::face);

  const MeshId door_mesh = m.mesh("door", {0.9 * pedestal, stack - 0.03 * height, front}, wood, rounded_box(0.004));
  const NodeId door = m.part("door", door_mesh, {-pedestal_x, height / 2, face_z});
  m.attach(door, right, RelationKind::face);
  const MeshId knob_mesh =
      m.mesh("knob", {0.034, 0.034, 0.03}, brass,
             along_z(turned({{0.4, 0}, {0.4, 0.35}, {0.8, 0.5}, {1, 0.7}, {0.85, 0.92}, {0.5, 1}}, 20)));
  const NodeId knob = m.part("knob", knob_mesh, {-pedestal_x + 0.32 * pedestal, 0.66 * height, handle_z + 0.0025});
  m.attach(knob, door, RelationKind::point);

  m.edit({"widen", "Make the desk wider.", {seed_scale_1d(top, Vec3::UnitX())}, {}, {}}, [=](double x) {
    return GalleryValues{{"width", width * (1 + x)}};
  });
  m.edit({"deepen", "Make the desk deeper.", {seed_scale_1d(top, Vec3::UnitZ())}, {}, {}}, [=](double x) {
    return GalleryValues{{"depth", depth * (1 + x)}};
  });
  m.edit({"raise", "Make the desk higher.", {seed_scale_1d(left, Vec3::UnitY(), {0, -1, 0})}, {}, {}}, [=](double x) {
    return GalleryValues{{"pedestal_height", height * (1 + x)}};
  });
}

}  // namespace

extern const GalleryModel desk;
const GalleryModel desk = {
    "desk",
    "Desk with drawers",
    {{"width", 1.5, 0.95, 2.1, "m", "width of the top"},
     {"depth", 0.7, 0.45, 1.0, "m", "depth of the top"},
     {"top_thickness", 0.034, 0.025, 0.05, "m", "thickness of the top"},
     {"pedestal_width", 0.4, 0.3, 0.42, "m", "width of a pedestal"},
     {"pedestal_height", 0.7, 0.45, 0.95, "m", "height of the pedestals"},
     {"pedestal_spread", 0.69, 0.6, 0.7, "ratio", "distance of the pedestals as a share of the width"},
     {"panel_height", 0.32, 0.2, 0.36, "m", "height of the panel between the pedestals"},
     {"front_thickness", 0.022, 0.018, 0.03, "m", "thickness of drawers and door"},
     {"drawer_count", 3, 3, 5, "count", "number of drawers"}},
    layout};

}  // namespace parsel::gallery
