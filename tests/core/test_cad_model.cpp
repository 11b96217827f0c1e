// Flattened programs as JSON, as text and as GLB.
#include "core/cad/model.h"

#include <doctest/doctest.h>

#include <Eigen/Geometry>

#include <nlohmann/json.hpp>
#include <string>

#include "core/base/random.h"
#include "core/cad/cad_mesh.h"
#include "core/cad/scad_flatten.h"
#include "core/shape/abstraction.h"
#include "tests/core/family_data.h"

using namespace parsel;
using namespace parsel::cad;

namespace {

/// Everything that a model may hold.
constexpr std::string_view everything = R"(
$fn = 60;
/* [Legs] */
leg_height = 45; // [20 : 1 : 90]
module leg() { translate([0, 0, leg_height / 2]) cube([4, 4.1, leg_height], center = true); }
for (x = [-1, 1], y = [-1, 1]) translate([x * 15, y * 15, 0]) leg();
// seat
color("peru") translate([-20, -20, leg_height]) cube([40, 40, 3]);
// hub
translate([0, 0, 20]) rotate([0, 90, 0]) cylinder(h = 30, r = 2, center = true);
// spoke
rotate([90, 0, 0]) scale([1, 2, 1]) cylinder(h = 3, d = 1.3);
// cone
for (a = [0, 90, 180, 270]) rotate([a, 0, 0]) translate([0, 0, 70]) cylinder(h = 5, r1 = 3, r2 = 1);
rotate([0, 90, 0]) translate([0, 0, 70]) cylinder(h = 5, r1 = 3, r2 = 0);
rotate([0, -90, 0]) translate([0, 0, 70]) scale([1, 0.5, 1]) cylinder(h = 5, r1 = 1, r2 = 2);
// nut
for (a = [0, 90, 180, 270]) rotate([a, 0, 0]) translate([9, 0, 90]) rotate([0, 0, a]) cylinder(h = 2, r = 3, $fn = 5);
difference() {
  scale([1, 2, 3]) sphere(d = 4);
  union() { cube(1); color([0, 0.5, 1, 0.25]) translate([1, 1, 1]) cube(1); }
  intersection() { cube(2); sphere(1); }
}
)";

Model model_of(std::string_view text) {
  Result<Model> model = read_scad(text, "test");
  REQUIRE_MESSAGE(model.ok(), (model.ok() ? "" : model.error().message()));
  return std::move(*model);
}

void check_same(const Model& a, const Model& b) {
  REQUIRE(a.parts.size() == b.parts.size());
  for (std::size_t i = 0; i < a.parts.size(); ++i) {
    CAPTURE(a.parts[i].id);
    const cad::Part &p = a.parts[i], &q = b.parts[i];
    CHECK(p.id == q.id);
    CHECK(p.label == q.label);
    CHECK(p.kind == q.kind);
    CHECK(p.centre == q.centre);
    CHECK(p.size == q.size);
    CHECK(p.top == q.top);
    CHECK(p.sides == q.sides);
    CHECK(p.role == q.role);
    CHECK(p.colour == q.colour);
    const bool is_round = p.kind == Kind::cylinder || p.kind == Kind::cone;
    if (is_round) CHECK(p.axis == q.axis);
    if (p.kind == Kind::cone) CHECK(p.towards == q.towards);
    CHECK((extent(p).low - extent(q).low).norm() < 1e-9);
    CHECK((extent(p).high - extent(q).high).norm() < 1e-9);
  }
}

}  // namespace

TEST_CASE("cad: text to JSON to text is byte-equal, and so is JSON to JSON") {
  const Model model = model_of(everything);
  CHECK(model.parts.size() == 22);
  const std::string text = to_scad(model);
  const Model again = model_of(text);
  check_same(model, again);
  CHECK(to_scad(again) == text);
  const std::string json = to_json(model).dump();
  const Result<Model> back = model_from_json(nlohmann::json::parse(json));
  REQUIRE_MESSAGE(back.ok(), (back.ok() ? "" : back.error().message()));
  CHECK(to_json(*back).dump() == json);
  CHECK(to_scad(*back) == text);
  check_same(model, *back);
}

TEST_CASE("cad: numbers are written as people write them") {
  const std::string text = to_scad(model_of("translate([410, 0.1, -1e-5]) cube([1500, 0.25, 1 / 3]);"));
  CHECK(text.find("translate([1160, 0.225, 0.166656666667]) cube([1500, 0.25, 0.333333333333], center = true);") !=
        std::string::npos);
}

TEST_CASE("cad: programs that are damaged at random are read or refused, and what is read can be written") {
  Random random(11);
  std::size_t read = 0;
  for (int k = 0; k < 3000; ++k) {
    std::string text(everything);
    for (std::uint64_t changes = 1 + random.below(4); changes > 0; --changes) {
      const std::size_t at = random.below(text.size()), length = random.below(12);
      const std::string other = text.substr(random.below(text.size()), random.below(20));
      switch (random.below(3)) {
        case 0:
          text.erase(at, length);
          break;
        case 1:
          text.insert(at, other);
          break;
        default:
          text[at] = static_cast<char>(random.below(256));
      }
    }
    const Result<Model> model = read_scad(text, "damaged");
    if (!model.ok()) {
      CHECK_FALSE(model.error().cause.empty());
      continue;
    }
    ++read;
    const Result<Model> again = model_from_json(to_json(*model));
    REQUIRE_MESSAGE(again.ok(), (again.ok() ? "" : again.error().message() + "\n" + text));
    const Result<Model> flat = read_scad(to_scad(*model), "flat");
    REQUIRE_MESSAGE(flat.ok(), (flat.ok() ? "" : flat.error().message() + "\n" + to_scad(*model)));
    CHECK(to_scad(*flat) == to_scad(*model));
  }
  CHECK(read > 50);
}

TEST_CASE("cad: ReparamCAD's programs go through text and JSON") {
  for (const test::FamilyCase& one : test::family_cases()) {
    CAPTURE(one.name);
    const Model read = model_of(to_scad(one.model));
    REQUIRE(read.parts.size() == one.model.parts.size());
    for (std::size_t i = 0; i < read.parts.size(); ++i) {
      CHECK((read.parts[i].centre - one.model.parts[i].centre).norm() < 1e-12);
      CHECK((read.parts[i].size - one.model.parts[i].size).norm() < 1e-12);
      CHECK(std::abs(read.parts[i].top - one.model.parts[i].top) < 1e-12);
      CHECK(read.parts[i].kind == one.model.parts[i].kind);
    }
  }
}

TEST_CASE("cad: the GLB opens as a shape with the same parts and boxes") {
  std::vector<Model> models;
  for (const test::FamilyCase& one : test::family_cases()) models.push_back(one.model);
  models.push_back(model_of(everything));
  models.back().unit = "cm";
  for (const Model& model : models) {
    CAPTURE(model.name);
    const Result<Abstraction> opened = abstract_shape(to_glb(model), model.name);
    REQUIRE_MESSAGE(opened.ok(), (opened.ok() ? "" : opened.error().message()));
    CHECK(opened->shape.warnings.empty());
    std::size_t drawn = 0;
    for (const cad::Part& part : model.parts) {
      if (part.role != Role::add) continue;
      CAPTURE(part.id);
      const auto index = opened->shape.find_part("node:" + std::to_string(drawn++));
      REQUIRE(index);
      const PartMesh& mesh = opened->meshes[*index];
      Vec3 low = Vec3::Constant(1e300), high = -low;
      for (const Vec3& p : mesh.positions) {
        low = low.cwiseMin(opened->shape.frame.to_model(p));
        high = high.cwiseMax(opened->shape.frame.to_model(p));
      }
      const Extent box = extent(part);
      CHECK((low - metres(model) * (part.centre + box.low)).cwiseAbs().maxCoeff() < 1e-6);
      CHECK((high - metres(model) * (part.centre + box.high)).cwiseAbs().maxCoeff() < 1e-6);
      if (part.sides > 0) continue;  // prisms may get boxes that lean with them
      const Corners& corners = opened->shape.parts[*index].hexahedron.corners;
      for (int k = 0; k < 8; ++k) {
        for (int i = 0; i < 3; ++i) {
          const double wanted = part.centre[i] + (corner_sign(k, i) < 0 ? box.low[i] : box.high[i]);
          CHECK(std::abs(opened->shape.frame.to_model(corners.row(k).transpose())[i] - metres(model) * wanted) < 1e-6);
        }
      }
    }
    CHECK(opened->meshes.size() == drawn);
  }
}

TEST_CASE("cad: solids are closed and point outwards") {
  const std::string glb = to_glb(model_of(everything));
  const Result<Abstraction> opened = abstract_shape(glb, "test");
  REQUIRE(opened.ok());
  for (const PartMesh& mesh : opened->meshes) {
    double volume = 0;
    for (const Triangle& t : mesh.triangles) {
      volume += mesh.positions[t[0]].dot(mesh.positions[t[1]].cross(mesh.positions[t[2]])) / 6;
    }
    CHECK(volume > 0);
  }
}

TEST_CASE("cad: JSON that is wrong is refused by place") {
  const nlohmann::json good = to_json(model_of(everything));
  const auto place = [&](const auto& change) {
    nlohmann::json bad = good;
    change(bad);
    const Result<Model> read = model_from_json(bad);
    CHECK_FALSE(read.ok());
    return read.ok() ? std::string() : read.error().place + " " + read.error().cause;
  };
  CHECK(place([](auto& j) { j = 3; }).starts_with(" it is no object"));
  CHECK(place([](auto& j) { j["format"] = "x"; }).starts_with("/format"));
  CHECK(place([](auto& j) { j["parts"][1]["size"][0] = "x"; }).starts_with("/parts/1/size"));
  CHECK(place([](auto& j) { j["parts"][1]["size"][0] = -1; }).find("its size is not between") != std::string::npos);
  CHECK(place([](auto& j) {
          j["parts"][1]["id"] = j["parts"][0]["id"];
          j.erase("tree");
        }).find("used twice") != std::string::npos);
  CHECK(place([](auto& j) { j["parts"][1]["kind"] = "ball"; }).starts_with("/parts/1/kind"));
  CHECK(place([](auto& j) { j["parts"][1].erase("centre"); }).starts_with("/parts/1/centre"));
  CHECK(place([](auto& j) { j["tree"][1] = "nobody"; }).starts_with("/tree/1"));
  CHECK(place([](auto& j) { j["tree"].erase(1); }).starts_with("/tree"));
}
