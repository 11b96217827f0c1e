// Vertex data after an edit, against positions, normals and tangents that are known in closed form.
#include <doctest/doctest.h>

#include <Eigen/Geometry>

#include "tests/core/apply_fixture.h"

using namespace parsel;
using namespace parsel::apply_fixture;

namespace {

const Vec3 low(-1, -0.5, 0), high(1, 0.5, 2);

/// One box with positions, normals and tangents in a node with a transform, under a frame that is not trivial.
struct OneBox {
  Glb glb;
  Shape shape;
  PartIndex part;
  Eigen::Affine3d world = Eigen::Affine3d::Identity();
  std::vector<Vec3> normals;

  OneBox() {
    shape.frame = {Vec3(0.25, -2, 1), 1.5};
    const Eigen::Quaterniond turn(Eigen::AngleAxisd(0.7, Vec3(1, 2, -1).normalized()));
    world.translate(Vec3(3, -1, 0.5)).rotate(turn).scale(Vec3(1, 2, 0.5));
    const std::vector<Vec3> points = grid(low, high);
    for (std::size_t i = 0; i < points.size(); ++i) {
      const auto d = static_cast<double>(i);
      normals.push_back(Vec3(std::sin(d), std::cos(3 * d), 0.3 * d - 4).normalized());
    }
    std::vector<float> tangents;
    for (const Vec3& n : normals) {
      const Vec3 t = n.unitOrthogonal();
      for (int c = 0; c < 3; ++c) tangents.push_back(static_cast<float>(t[c]));
      tangents.push_back(-1);
    }
    const std::size_t position = glb.vectors(points), normal = glb.vectors(normals, false);
    const std::size_t tangent = glb.json["accessors"].size();
    glb.json["accessors"].push_back(
        {{"bufferView", glb.view(tangents)}, {"componentType", 5126}, {"count", points.size()}, {"type", "VEC4"}});
    const std::size_t mesh =
        glb.mesh({{"attributes", {{"POSITION", position}, {"NORMAL", normal}, {"TANGENT", tangent}}}});
    const Eigen::Vector4d q = turn.coeffs();
    const std::size_t node = glb.node({{"mesh", mesh},
                                       {"translation", {3, -1, 0.5}},
                                       {"rotation", {q[0], q[1], q[2], q[3]}},
                                       {"scale", {1, 2, 0.5}}});
    part = add_part(shape, node,
                    mapped(box(low, high), [&](const Vec3& p) { return shape.frame.to_normalised(world * p); }));
  }

  /// The file after the part's corners went through an affine map of the normalised frame.
  std::string edited(const Eigen::Affine3d& edit) const {
    State state = resting(shape);
    state.parts[part] = mapped(state.parts[part], [&](const Vec3& p) { return Vec3(edit * p); });
    const auto out = apply_state(glb.bytes(), shape, state);
    REQUIRE(out.ok());
    CHECK(out->warnings.empty());
    return out->glb;
  }

  /// The same in the node's coordinates.
  Eigen::Affine3d local(const Eigen::Affine3d& edit) const {
    Eigen::Affine3d frame = Eigen::Affine3d::Identity();
    frame.translation() = shape.frame.centre;
    frame.linear() *= shape.frame.scale;
    return world.inverse() * frame * edit * frame.inverse() * world;
  }
};

void check_affine(const OneBox& model, const Eigen::Affine3d& edit) {
  const std::string glb = model.edited(edit);
  const Eigen::Affine3d map = model.local(edit);
  const Mat3 normal_map = map.linear().inverse().transpose();
  std::vector<Vec3> points = grid(low, high), normals = model.normals, tangents;
  for (Vec3& p : points) p = map * p;
  for (const Vec3& n : model.normals) tangents.push_back((map.linear() * n.unitOrthogonal()).normalized());
  for (Vec3& n : normals) n = (normal_map * n).normalized();
  CHECK(furthest(attribute(glb, 0, "POSITION"), points) < 1e-6);
  CHECK(furthest(attribute(glb, 0, "NORMAL"), normals) < 1e-6);
  CHECK(furthest(attribute(glb, 0, "TANGENT"), tangents) < 1e-6);
  CHECK(bounds_hold(glb));
  // In place: the file has the same size but for the digits of the bounds, and keeps all indices.
  CHECK(json_of(glb)["bufferViews"] == model.glb.json["bufferViews"]);
  CHECK(json_of(glb)["meshes"] == model.glb.json["meshes"]);
  const gltf::File file = read(glb);
  const auto values = gltf::read_accessor(file.original, 2);
  const double handedness = edit.linear().determinant() < 0 ? 1 : -1;
  for (std::size_t i = 3; i < values->size(); i += 4) CHECK((*values)[i] == handedness);
}

}  // namespace

TEST_CASE("apply: no edit gives back the file, byte for byte") {
  const OneBox model;
  State state = resting(model.shape);
  const auto out = apply_state(model.glb.bytes(), model.shape, state);
  REQUIRE(out.ok());
  CHECK(out->glb == model.glb.bytes());
  state.parts[model.part](3, 1) += 5e-13;
  CHECK(apply_state(model.glb.bytes(), model.shape, state)->glb == model.glb.bytes());
  state.parts[model.part](3, 1) += 1e-3;
  CHECK(apply_state(model.glb.bytes(), model.shape, state)->glb != model.glb.bytes());
}

TEST_CASE("apply: affine edits move positions, normals and tangents as they must") {
  const OneBox model;
  Eigen::Affine3d edit = Eigen::Affine3d::Identity();
  SUBCASE("translate") {
    edit.translate(Vec3(0.1, -0.2, 0.05));
  }
  SUBCASE("rotate") {
    edit.translate(Vec3(0.3, 0, 0)).rotate(Eigen::AngleAxisd(0.8, Vec3(0, 1, 1).normalized()));
  }
  SUBCASE("scale") {
    edit.scale(Vec3(1.4, 0.8, 1));
  }
  SUBCASE("shear") {
    edit.linear()(0, 1) = 0.6;
  }
  SUBCASE("mirror") {
    edit.scale(Vec3(-1, 1, 1));
  }
  check_affine(model, edit);
}

TEST_CASE("apply: a face that moves bends the inside as the cage does") {
  Glb glb;
  Shape shape;
  const std::vector<Vec3> points = grid(Vec3(-1, -1, -1), Vec3(1, 1, 1), 4);
  std::vector<Vec3> normals(points.size(), Vec3(0, 1, 0));
  const std::size_t position = glb.vectors(points), normal = glb.vectors(normals, false);
  const std::size_t node =
      glb.node({{"mesh", glb.mesh({{"attributes", {{"POSITION", position}, {"NORMAL", normal}}}})}});
  add_part(shape, node, box(Vec3(-1, -1, -1), Vec3(1, 1, 1)));
  State state = resting(shape);
  for (int k = 0; k < 8; ++k) {
    if (corner_sign(k, 0) > 0) state.parts[PartIndex(0)](k, 1) *= 1.5;  // taller on the right
  }
  const auto out = apply_state(glb.bytes(), shape, state);
  REQUIRE(out.ok());
  std::vector<Vec3> expected;
  for (const Vec3& p : points) expected.emplace_back(p[0], p[1] * (1 + (p[0] + 1) / 4), p[2]);
  CHECK(furthest(attribute(out->glb, 0, "POSITION"), expected) < 1e-6);
  for (std::size_t i = 0; i < points.size(); ++i) {
    // y' = y·(1 + (x + 1)/4): the surface y = const has the normal (-y/4, 1 …) there.
    const double grow = 1 + (points[i][0] + 1) / 4;
    normals[i] = Vec3(-points[i][1] / 4 / grow, 1 / grow, 0).normalized();
  }
  CHECK(furthest(attribute(out->glb, 0, "NORMAL"), normals) < 1e-6);
}

TEST_CASE("apply: an edit and its inverse give back the mesh") {
  OneBox model;
  Eigen::Affine3d edit = Eigen::Affine3d::Identity();
  edit.rotate(Eigen::AngleAxisd(0.4, Vec3::UnitZ())).scale(Vec3(1.2, 0.9, 1.1)).translate(Vec3(0.1, 0.2, 0.3));
  const std::string there = model.edited(edit);
  Shape moved = model.shape;
  moved.parts[model.part].hexahedron.corners =
      mapped(model.shape.parts[model.part].hexahedron.corners, [&](const Vec3& p) { return Vec3(edit * p); });
  const auto back = apply_state(there, moved, resting(model.shape));
  REQUIRE(back.ok());
  CHECK(furthest(attribute(back->glb, 0, "POSITION"), attribute(model.glb.bytes(), 0, "POSITION")) < 1e-6);
}

TEST_CASE("apply: every byte of the JSON that is not edited stays") {
  OneBox model;
  const std::string plain = model.glb.json.dump();
  std::string text = plain;
  text.replace(text.find("\"byteLength\":0}]"), 16, "\"byteLength\":" + std::to_string(model.glb.binary.size()) + "}]");
  text.replace(text.find("\"asset\":{"), 9,
               "\"extras\" : { \"n\":[1.0e-3, 0.10,12345678901234567890], \"\\u0061\":\"\\u00e9\" },\n \"asset\":{");
  text.insert(text.size() - 1, ",\"extensions\":{\"ACME_unknown\" :{ \"accessors\":[ 0 ]}}");
  const std::string file = glb_of(text, model.glb.binary);
  State state = resting(model.shape);
  state.parts[model.part].col(0).array() += 0.1;
  const auto out = apply_state(file, model.shape, state);
  REQUIRE(out.ok());
  std::string after = json_chunk(out->glb);
  // Only the bounds of accessor 0 differ.
  const std::string min_key = "\"min\":", stop = "]";
  for (std::string* json : {&text, &after}) {
    const std::size_t begin = json->find(min_key);
    const std::size_t end = json->find(stop, json->find("\"max\":")) + 1;
    json->erase(begin, end - begin);
    json->erase(json->find_last_not_of(' ') + 1);
  }
  CHECK(after == text);
}
