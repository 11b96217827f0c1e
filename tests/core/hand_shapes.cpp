#include "hand_shapes.h"

#include <array>
#include <cmath>

#include "core/base/tolerance.h"

namespace parsel::hand {

namespace {

PartIndex add_parent(Shape& shape, const std::string& id, const Vec3& centre, const Vec3& half,
                     const std::vector<PartIndex>& members) {
  const PartIndex parent = add_box(shape, id, centre, half);
  shape.parts[parent].node = -1;
  shape.parts[parent].primitive = -1;
  shape.parts[parent].members = members;
  return parent;
}

void tie_group(Shape& shape, RelationIndex group, PartIndex parent) {
  shape.parts[parent].group = group;
  for (const PartIndex p : shape.parts[parent].members) shape.parts[p].group = group;
}

Vec3 random_direction(Random& random) {
  const Vec3 axes[3] = {Vec3::UnitX(), Vec3::UnitY(), Vec3::UnitZ()};
  if (random.below(2) == 0) return axes[random.below(3)];
  return {random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(0.1, 1)};
}

LocalTriple random_triple(Random& random) {
  LocalTriple triple;
  for (int& t : triple) t = static_cast<int>(random.below(3)) - 1;
  return triple;
}

}  // namespace

PartIndex add_box(Shape& shape, const std::string& id, const Vec3& centre, const Vec3& half) {
  Part part;
  part.id = part.label = part.name = id;
  part.node = static_cast<int>(shape.parts.size());
  part.primitive = 0;
  part.hexahedron = make_box(centre, Mat3::Identity(), half);
  return shape.parts.push_back(std::move(part));
}

RelationIndex attach(Shape& shape, const std::string& id, PartIndex a, PartIndex b, const std::vector<Vec3>& points) {
  Attachment attachment;
  attachment.points = points;
  for (const Vec3& p : points) {
    attachment.local_a.push_back(shape.parts[a].hexahedron.local(p));
    attachment.local_b.push_back(shape.parts[b].hexahedron.local(p));
  }
  const RelationKind kind = points.size() == 1   ? RelationKind::point
                            : points.size() == 2 ? RelationKind::line
                            : points.size() == 4 ? RelationKind::face
                                                 : RelationKind::volume;
  return shape.relations.push_back({id, kind, {a, b}, attachment});
}

RelationIndex mirror(Shape& shape, const std::string& id, PartIndex a, PartIndex b) {
  const Reflection reflection{Vec3::Zero(), Vec3::UnitX(), {1, 0, 3, 2, 5, 4, 7, 6}};
  return shape.relations.push_back({id, RelationKind::reflection, {a, b}, reflection});
}

Shape chair() {
  Shape shape;
  shape.name = "chair";
  shape.sha256 = std::string(64, 'c');
  const PartIndex seat = add_box(shape, "seat", Vec3::Zero(), {0.4, 0.05, 0.4});
  const PartIndex left = add_box(shape, "leg_left", {0.3, -0.3, 0}, {0.05, 0.25, 0.05});
  const PartIndex right = add_box(shape, "leg_right", {-0.3, -0.3, 0}, {0.05, 0.25, 0.05});
  const PartIndex back = add_box(shape, "back", {0, 0.35, -0.35}, {0.4, 0.3, 0.05});
  const PartIndex handle = add_box(shape, "handle", {0.2, 0.4, -0.35}, {0.05, 0.02, 0.03});
  mirror(shape, "r1", left, right);
  attach(shape, "a1", seat, left, {{0.3, -0.05, 0}});
  attach(shape, "a2", seat, right, {{-0.3, -0.05, 0}});
  attach(shape, "a3", seat, back, {{-0.4, 0.05, -0.35}, {0.4, 0.05, -0.35}});
  std::vector<Vec3> corners;
  for (int k = 0; k < 8; ++k) corners.push_back(shape.parts[handle].hexahedron.corners.row(k).transpose());
  attach(shape, "a4", back, handle, corners);
  return shape;
}

Shape slats() {
  Shape shape;
  shape.name = "slats";
  shape.sha256 = std::string(64, 'd');
  const PartIndex rail = add_box(shape, "rail", {0, 0.3, 0}, {0.5, 0.05, 0.05});
  std::vector<PartIndex> members;
  for (int i = 0; i < 3; ++i) {
    members.push_back(add_box(shape, "slat_" + std::to_string(i + 1), {0.2 * (i - 1), 0, 0}, {0.04, 0.25, 0.02}));
  }
  const PartIndex parent = add_parent(shape, "slats", Vec3::Zero(), {0.24, 0.25, 0.02}, members);
  const Translation line{parent, {-0.2, 0, 0}, {0.2, 0, 0}, 0, 1};
  tie_group(shape, shape.relations.push_back({"t1", RelationKind::translation, members, line}), parent);
  std::vector<Vec3> upper;
  for (const double x : {-0.24, 0.24}) {
    for (const double z : {-0.02, 0.02}) upper.push_back({x, 0.25, z});
  }
  attach(shape, "a1", rail, parent, upper);
  attach(shape, "a2", rail, members[0], {{-0.2, 0.25, 0}});
  attach(shape, "a3", rail, members[2], {{0.2, 0.25, 0}});
  return shape;
}

Shape ring() {
  Shape shape;
  shape.name = "ring";
  shape.sha256 = std::string(64, 'e');
  const PartIndex plate = add_box(shape, "plate", {0, 0.3, 0}, {0.5, 0.05, 0.5});
  const PartIndex first = add_box(shape, "foot_1", {0.3, 0, 0}, {0.04, 0.25, 0.06});
  std::vector<PartIndex> members = {first};
  for (int k = 1; k < 4; ++k) {
    const PartIndex foot = add_box(shape, "foot_" + std::to_string(k + 1), Vec3::Zero(), {0.04, 0.25, 0.06});
    const double angle = k * pi / 2;
    Mat3 turn;
    turn << std::cos(angle), 0, std::sin(angle), 0, 1, 0, -std::sin(angle), 0, std::cos(angle);
    Hexahedron& box = shape.parts[foot].hexahedron;
    box.corners = shape.parts[first].hexahedron.corners * turn.transpose();
    box.axes = shape.parts[first].hexahedron.axes * turn.transpose();
    members.push_back(foot);
  }
  const PartIndex parent = add_parent(shape, "feet", Vec3::Zero(), {0.34, 0.25, 0.34}, members);
  const Rotation circle{parent, Vec3::Zero(), Vec3::UnitY(), 1, 0.3};
  tie_group(shape, shape.relations.push_back({"o1", RelationKind::rotation, members, circle}), parent);
  std::vector<Vec3> upper;
  for (const double x : {-0.34, 0.34}) {
    for (const double z : {-0.34, 0.34}) upper.push_back({x, 0.25, z});
  }
  attach(shape, "a1", plate, parent, upper);
  return shape;
}

Shape fan() {
  Shape shape = ring();
  shape.name = "fan";
  const PartIndex motor = add_box(shape, "motor", Vec3::Zero(), {0.26, 0.2, 0.26});
  const std::array<Vec3, 4> outwards = {Vec3(1, 0, 0), Vec3(0, 0, -1), Vec3(-1, 0, 0), Vec3(0, 0, 1)};
  for (std::size_t k = 0; k < outwards.size(); ++k) {
    const std::string number = std::to_string(k + 1);
    attach(shape, "a" + std::to_string(k + 2), motor, *shape.find_part("foot_" + number), {0.26 * outwards[k]});
  }
  attach(shape, "a6", motor, *shape.find_part("feet"), {Vec3::Zero()});
  return shape;
}

Statement statement(Op op, const std::string& part, const Vec3& direction, const std::string& amount,
                    const Vec3& origin, const Vec3& normal) {
  Statement s;
  s.op = op;
  s.part = part;
  if (needs_origin(op)) s.origin = origin;
  if (needs_direction(op)) s.direction = direction;
  if (needs_normal(op)) s.normal = normal;
  if (op != Op::keep_fixed) s.amount = parse_amount(amount).value();
  return s;
}

Statement group_statement(Op op, const std::string& relation, const std::string& amount, Anchor anchor) {
  Statement s;
  s.op = op;
  s.relation = relation;
  s.anchor = anchor;
  s.amount = parse_amount(amount).value();
  return s;
}

Program program(const Shape& shape, std::vector<Statement> statements, double min, double max) {
  Program result;
  result.shape_name = shape.name;
  result.shape_sha256 = shape.sha256;
  Layer layer;
  layer.request = "by hand";
  layer.parameter = {"x1", min, max, 0};
  layer.statements = std::move(statements);
  result.layers.push_back(std::move(layer));
  return result;
}

std::string random_amount(Random& random) {
  static const std::array<const char*, 12> forms = {
      "x1",          "0.5*x1",      "-0.3*x1",     "x1^2",      "sin(x1)",        "sqrt(1+x1)-1",
      "atan2(x1,1)", "x1/(1+x1^2)", "tan(0.5*x1)", "1-cos(x1)", "sqrt(1-x1^2)-1", "atan2(sin(x1),1.2-cos(x1))-0.3*x1^3",
  };
  return forms[random.below(forms.size())];
}

Program random_program(const Shape& shape, Random& random) {
  std::vector<Statement> statements;
  const std::size_t count = 1 + random.below(6);
  std::vector<const Part*> parts;
  for (const Part& part : shape.parts) {
    if (part.is_virtual() || !part.group) parts.push_back(&part);
  }
  const std::array<Op, 6> ops = {Op::translate, Op::rotate, Op::scale_1d, Op::scale_2d, Op::scale_3d, Op::shear};
  for (std::size_t i = 0; i < count; ++i) {
    const Part& part = *parts[random.below(parts.size())];
    Statement s =
        statement(ops[random.below(ops.size())], part.id, random_direction(random), random_amount(random),
                  {random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)}, random_direction(random));
    if (random.below(3) == 0) s.feature = random_triple(random);
    if (s.origin && random.below(2) == 0) s.origin = PartPoint{part.id, random_triple(random)};
    if (s.direction && random.below(2) == 0) s.direction = PartAxis{part.id, static_cast<int>(random.below(3))};
    statements.push_back(std::move(s));
  }
  return program(shape, std::move(statements));
}

}  // namespace parsel::hand
