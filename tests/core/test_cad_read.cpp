// OpenSCAD programs down to their parts, and what is refused.
#include "core/cad/scad_flatten.h"

#include <doctest/doctest.h>

#include <ctime>
#include <string>

using namespace parsel;
using namespace parsel::cad;

namespace {

Model read(std::string_view text) {
  Result<Model> model = read_scad(text, "test");
  REQUIRE_MESSAGE(model.ok(), (model.ok() ? "" : model.error().message()));
  return std::move(*model);
}

/// The only part of a program, in OpenSCAD's axes: centre and size.
struct Box {
  Vec3 centre, size;
};
Box only_box(std::string_view text) {
  const Model model = read(text);
  REQUIRE(model.parts.size() == 1);
  const Vec3 &c = model.parts[0].centre, &s = model.parts[0].size;
  return {{c.x(), -c.z(), c.y()}, {s.x(), s.z(), s.y()}};
}
void check_box(std::string_view text, const Vec3& centre, const Vec3& size) {
  CAPTURE(text);
  const Box box = only_box(text);
  CHECK((box.centre - centre).norm() < 1e-9);
  CHECK((box.size - size).norm() < 1e-9);
}

std::string refused(std::string_view text) {
  const std::clock_t start = std::clock();  // processor time: the machine may be busy
  const Result<Model> model = read_scad(text, "test");
  const double seconds = double(std::clock() - start) / CLOCKS_PER_SEC;
  CAPTURE(text.substr(0, 80));
#ifdef __SANITIZE_ADDRESS__
  CHECK(seconds < 10);
#else
  CHECK(seconds < 1);
#endif
  CHECK_FALSE(model.ok());
  return model.ok() ? "" : model.error().message();
}
bool has(const std::string& text, std::string_view part) {
  return text.find(part) != std::string::npos;
}

}  // namespace

TEST_CASE("cad: solids and transformations along the axes") {
  check_box("cube([2, 3, 4]);", {1, 1.5, 2}, {2, 3, 4});
  check_box("cube(2, true);", {0, 0, 0}, {2, 2, 2});
  check_box("translate([1, 2, 3]) cube([2, 3, 4], center = true);", {1, 2, 3}, {2, 3, 4});
  check_box("scale([2, 1, 0.5]) translate([1, 0, 0]) cube(2, center = true);", {2, 0, 0}, {4, 2, 1});
  check_box("rotate([0, 0, 90]) cube([2, 3, 4]);", {-1.5, 1, 2}, {3, 2, 4});
  check_box("rotate(a = -90, v = [1, 0, 0]) cube([2, 3, 4]);", {1, 2, -1.5}, {2, 4, 3});
  check_box("rotate([90, 90, 0]) cube([2, 3, 4]);", {1.5, -2, -1}, {3, 4, 2});
  check_box("rotate(90, [0, 0, 0]) cube([2, 3, 4]);", {1, 1.5, 2}, {2, 3, 4});
  check_box("mirror([1, 0, 0]) cube([2, 3, 4]);", {-1, 1.5, 2}, {2, 3, 4});
  check_box("multmatrix([[1, 0, 0, 5], [0, 2, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]) cube(1);", {5.5, 1, 0.5}, {1, 2, 1});
  check_box("cylinder(h = 4, r = 1);", {0, 0, 2}, {2, 2, 4});
  check_box("rotate([0, 90, 45]) cylinder(h = 4, d = 3, center = true);", {0, 0, 0},
            {4.949747468306, 4.949747468306, 3});
  check_box("rotate([0, 0, 37]) cylinder(h = 4, d = 3, center = true);", {0, 0, 0}, {3, 3, 4});
  check_box("rotate([0, 90, 0]) cylinder(h = 4, d = 3, center = true);", {0, 0, 0}, {4, 3, 3});
  check_box("rotate([10, 20, 30]) sphere(d = 3);", {0, 0, 0}, {3, 3, 3});
  check_box("linear_extrude(height = 5) translate([1, 1]) square([2, 4]);", {2, 3, 2.5}, {2, 4, 5});
  check_box("linear_extrude(5, center = true) circle(d = 2);", {0, 0, 0}, {2, 2, 5});
  check_box("hull() { cube(1); translate([3, 0, 0]) cube([1, 2, 1]); }", {2, 1, 0.5}, {4, 2, 1});
  check_box("polyhedron(points = [[0, 0, 0], [2, 0, 0], [0, 3, 0], [0, 0, 4]], faces = []);", {1, 1.5, 2}, {2, 3, 4});
}

TEST_CASE("cad: kinds, axes and tops") {
  const Model model = read(
      "cylinder(h = 2, r1 = 3, r2 = 1); rotate([90, 0, 0]) cylinder(h = 2, r1 = 0, r2 = 2);"
      "cylinder(h = 1, r = 5, $fn = 6); rotate([0, 0, 45]) cube(1, center = true);");
  REQUIRE(model.parts.size() == 4);
  CHECK(model.parts[0].kind == Kind::cone);
  CHECK(model.parts[0].axis == 1);
  CHECK(model.parts[0].towards == 1);
  CHECK(model.parts[0].size == Vec3(6, 2, 6));
  CHECK(model.parts[0].top == 2);
  // Its tip was at OpenSCAD's origin and its base at y = -2, which is our z = 2: the top lies towards -z.
  CHECK(model.parts[1].axis == 2);
  CHECK(model.parts[1].towards == -1);
  CHECK(model.parts[1].size == Vec3(4, 4, 2));
  CHECK(model.parts[1].top == 0);
  CHECK(model.parts[2].sides == 6);
  CHECK(extent(model.parts[2]).high.x() == doctest::Approx(5));
  CHECK(extent(model.parts[2]).high.z() == doctest::Approx(5 * std::sqrt(3) / 2));
  CHECK(model.parts[3].kind == Kind::opaque);
  CHECK(model.parts[3].size.x() == doctest::Approx(std::sqrt(2)));
  REQUIRE(model.warnings.size() == 1);
  CHECK(has(model.warnings[0].text, "cube does not lie along the axes"));
}

TEST_CASE("cad: variables, functions, modules, loops, conditions and children") {
  check_box("a = 2; b = a * 3 - 1; cube([a, b, a ^ 2]);", {1, 2.5, 2}, {2, 5, 4});
  check_box("a = 1; cube(a); a = 3;", {1.5, 1.5, 1.5}, {3, 3, 3});  // the last assignment counts everywhere
  check_box("function f(n) = n <= 1 ? 1 : n * f(n - 1); cube(f(4));", {12, 12, 12}, {24, 24, 24});
  check_box("function f(a, b = 2) = [a, b, a + b]; cube(f(b = 3, a = 1));", {0.5, 1.5, 2}, {1, 3, 4});
  check_box("module m(h = 3) { cube([1, 1, h]); } m(h = 5);", {0.5, 0.5, 2.5}, {1, 1, 5});
  check_box("module up() { translate([0, 0, 10]) children(); } up() cube(2);", {1, 1, 11}, {2, 2, 2});
  check_box("module second() children(1); second() { cube(1); cube(4); cube(2); }", {2, 2, 2}, {4, 4, 4});
  check_box("if (1 > 2) cube(1); else { cube(2); }", {1, 1, 1}, {2, 2, 2});
  check_box("v = [for (i = [1 : 3]) i * 2]; cube(v);", {1, 2, 3}, {2, 4, 6});
  check_box("v = [each [1, 2], if (false) 9, for (i = [3]) if (i > 2) i]; cube(v);", {0.5, 1, 1.5}, {1, 2, 3});
  check_box("let (a = 2, b = a + 1) cube([a, b, 1]);", {1, 1.5, 0.5}, {2, 3, 1});
  check_box("cube([max(1, 2), min([4, 3]), abs(-5) + floor(1.9)]);", {1, 1.5, 3}, {2, 3, 6});
  check_box("cube(norm([3, 4]) * [1, 1, 1] - [1, 2, 3]);", {2, 1.5, 1}, {4, 3, 2});
  check_box("x = is_undef(nothing) ? 2 : 1; cube(x);", {1, 1, 1}, {2, 2, 2});
  check_box("m = [[2, 0], [0, 3]]; v = m * [1, 1]; cube([v.x, v.y, len(v)]);", {1, 1.5, 1}, {2, 3, 2});
  CHECK(read("for (x = [0 : 2 : 6], y = [1, 5]) translate([x, y, 0]) cube(1);").parts.size() == 8);
  CHECK(read("for (i = [3 : -1 : 1]) translate([i * 9, 0, 0]) cube(i);").parts.size() == 3);
  CHECK(read("for (i = [0 : 0.1 : 1]) translate([i * 30, 0, 0]) cube(1);").parts.size() == 11);
  CHECK(read("*cube(1); %cube(2); #cube(3);").parts.size() == 1);
  CHECK(read("cube(1); !translate([5, 0, 0]) cube(2); cube(3);").parts[0].size.x() == 2);
  check_box("module 2legs() cube(3); 2legs();", {1.5, 1.5, 1.5}, {3, 3, 3});
  check_box("cube(1e0 + version()[1]);", {1, 1, 1}, {2, 2, 2});
  const Model model = read("/* long\n story */ echo(a = 1 + 1, \"b\", [1, [2]]); cube(1); // end");
  REQUIRE(model.echoes.size() == 1);
  CHECK(model.echoes[0].text == "a = 2, b, [1, [2]]");
}

TEST_CASE("cad: what OpenSCAD writes as .csg") {
  const Model model = read(
      "group() {\n\tmultmatrix([[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 20], [0, 0, 0, 1]]) {\n"
      "\t\tcube(size = [40, 40, 3], center = true);\n\t}\n"
      "\tcolor([1, 0, 0, 0.5]) {\n\t\tcylinder($fn = 0, $fa = 12, $fs = 2, h = 18.5, r1 = 2, r2 = 2, center = "
      "false);\n\t}\n"
      "\tgroup();\n\tdifference() {\n\t\tsphere($fn = 0, $fa = 12, $fs = 2, r = 5);\n\t\tcube(size = [1, 1, "
      "1]);\n\t}\n}\n");
  REQUIRE(model.parts.size() == 4);
  CHECK(model.parts[0].centre == Vec3(0, 20, 0));
  CHECK(model.parts[1].kind == Kind::cylinder);
  CHECK(model.parts[1].colour[3] == 0.5);
  CHECK(model.parts[2].role == Role::add);
  CHECK(model.parts[3].role == Role::cut);
  CHECK_FALSE(model.is_plain_union());
}

TEST_CASE("cad: each literal remembers its place") {
  const Model model = read("h = 45;\ntranslate([1, 2,\n    h / 3]) cube([4, h, 6 * 2]);");
  REQUIRE(model.parts.size() == 1);
  const cad::Part& part = model.parts[0];
  CHECK(part.place == Place{3, 13});
  CHECK(part.size_places[0] == Place{3, 19});  // 4
  CHECK(part.size_places[2] == Place{1, 5});   // OpenSCAD's y, through the variable
  CHECK(part.size_places[1] == Place{});       // computed
  CHECK(part.centre_places[0] == Place{2, 12});
  CHECK(part.centre_places[2] == Place{2, 15});
  CHECK(part.centre_places[1] == Place{});
}

TEST_CASE("cad: names come from comments, modules or the shape") {
  const Model model = read(
      "// A table for two people, with legs.\n// Second line\n"
      "module leg() cube([1, 1, 9]);\n"
      "for (x = [0, 10], y = [0, 10]) translate([x, y, 0]) leg();\n"
      "// top\ntranslate([0, 0, 9]) cube([11, 11, 1]);\n"
      "// this = not; a(name)\nsphere(1);\n"
      "/* [Section] */\ncylinder(h = 1, r = 1);\n");
  REQUIRE(model.parts.size() == 7);
  CHECK(model.parts[0].label == "leg");
  CHECK(model.find("leg_front_left") != nullptr);
  CHECK(model.find("leg_back_right") != nullptr);
  CHECK(model.find("top") != nullptr);
  CHECK(model.find("sphere") != nullptr);
  CHECK(model.find("cylinder") != nullptr);
}

TEST_CASE("cad: Customizer ranges and sections") {
  const Model model = read(
      "/* [Legs] */\nh = 45; // [20 : 5 : 90]\nw = 3; // [1:9]\nn = 2; // how many\n/* [Hidden] */\nq = 1; // "
      "[0:2]\ncube([w, w, h]);");
  REQUIRE(model.ranges.size() == 2);
  CHECK(model.ranges[0].name == "h");
  CHECK(model.ranges[0].section == "Legs");
  CHECK(model.ranges[0].step == 5);
  CHECK(model.ranges[0].max == 90);
  CHECK(model.ranges[1].min == 1);
  CHECK(model.ranges[1].step == 0);
}

TEST_CASE("cad: what is not read is refused by name and line") {
  CHECK(has(refused("cube(1);\n\n  minkowski() { cube(1); sphere(1); }"), "line 3, column 3: minkowski is not read"));
  CHECK(has(refused("linear_extrude(2) text(\"hi\");"), "line 1, column 19: text is not read"));
  CHECK(has(refused("import(\"a.stl\");"), "import is not read"));
  CHECK(has(refused("use <lib.scad>\ncube(1);"), "line 1, column 1: use names another file"));
  CHECK(has(refused("cube(1);\nfoo();"), "line 2, column 1: no module is called 'foo'"));
  CHECK(has(refused("cube(a);"), "line 1, column 6: nothing is called 'a'"));
  CHECK(has(refused("cube(f(1));"), "there is no function 'f'"));
  CHECK(has(refused("a = 1;\ncube(a / 0);"), "line 2, column 8: it divides by zero"));
  CHECK(has(refused("cube([1, 2, 5 % 0]);"), "divides by zero"));
  CHECK(has(refused("square(1);"), "a flat shape is no solid"));
  CHECK(has(refused("cube(\"a\");"), "cube: its size is a string that does not fit"));
  CHECK(has(refused("cube(1e9);"), "larger than a million"));
  CHECK(has(refused("cube(1"), "',' is missing before the end of the file"));
  CHECK(has(refused("cube(1) }"), "';' is missing"));
  CHECK(has(refused("module m() { cube(1);"), "'}' is missing at the end"));
  CHECK(has(refused("x = ;"), "stands where a value is needed"));
  CHECK(has(refused("\"abc"), "a string has no end"));
  CHECK(has(refused("/* abc"), "a comment has no end"));
  CHECK(has(refused("cube(1); \x01"), "is no sign of OpenSCAD"));
  CHECK(has(refused(""), "the program makes no solid"));
  CHECK(has(refused("assert(1 > 2); cube(1);"), "an assert of the program fails"));
  CHECK(has(refused("f = function(x) x; cube(1);"), "a function without a name"));
}

TEST_CASE("cad: endless programs are refused within a second") {
  CHECK(has(refused("module m() m(); m();"), "calls are nested deeper"));
  CHECK(has(refused("function f(x) = f(x + 1); cube(f(1));"), "nested deeper"));
  CHECK(has(refused("function f(x) = f(x - 1) + f(x - 2); cube(f(1));"), "nested deeper"));
  CHECK(has(refused("function f(x) = x < 1 ? 1 : f(x - 1) + f(x - 1); cube(f(40));"), "steps"));
  CHECK(has(refused("for (i = [0 : 1e12]) cube(1);"), "steps"));
  CHECK(has(refused("for (i = [0 : 1000], j = [0 : 1000]) cube(1);"), "more than 2000 parts"));
  CHECK(has(refused("for (i = [0 : 1000], j = [0 : 1000], k = [0 : 1000]) { }\ncube(1);"), "steps"));
  CHECK(has(refused("for (i = [0 : 0 : 1]) cube(1);"), "a step of zero"));
  std::string doubling = "a0 = [1, 1];\n";
  for (int i = 1; i < 40; ++i) {
    const std::string last = "a" + std::to_string(i - 1);
    doubling += "a" + std::to_string(i) + " = [" + last + ", " + last + "];\n";
  }
  CHECK(has(refused(doubling + "cube(a39 == a38 ? 1 : 0 / 0);"), "divides by zero"));
  CHECK(has(
      refused(
          "a = [for (i = [0 : 999]) i]; b = [for (i = [0 : 999]) a]; c = [for (i = [0 : 999]) b]; d = c + c; cube(1);"),
      "the vectors are too large"));
  CHECK(has(
      refused("s0 = \"0123456789\"; function f(s, n) = n == 0 ? s : f(str(s, s), n - 1); echo(f(s0, 60)); cube(1);"),
      "longer than 10,000 bytes"));
  CHECK(has(refused("x = " + std::string(100'000, '(')), "nested deeper"));
  CHECK(has(refused("x = " + std::string(100'000, '-') + "1;"), "nested deeper"));
  CHECK(has(refused("x = " + std::string(100'000, '[') + "1;"), "nested deeper"));
  CHECK(has(refused(std::string(100'000, '{')), "nested deeper"));
  std::string sum = "x = 1";
  for (int i = 0; i < 100'000; ++i) sum += " + 1";
  CHECK(has(refused(sum + ";"), "the expression is too long"));
  CHECK(has(refused(std::string(std::size_t{10} << 20, ' ')), "longer than 1 MiB"));
  std::string cubes;
  while (cubes.size() < (std::size_t{1} << 20) - 100) cubes += "cube(1);\n";
  CHECK(has(refused(cubes), "more than 2000 parts"));
}
