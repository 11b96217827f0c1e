// Whole families: sliders, replay as editing programs, OpenSCAD with a Customizer, bad input.
#include "core/family/family.h"

#include <doctest/doctest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <set>

#include "core/base/random.h"
#include "core/cad/cad_mesh.h"
#include "core/cad/scad_flatten.h"
#include "core/edit/evaluate.h"
#include "core/family/family_program.h"
#include "core/family/family_scad.h"
#include "core/gallery/programs.h"
#include "core/shape/abstraction.h"
#include "tests/core/family_data.h"
#include "tests/core/hand_shapes.h"

using namespace parsel;
using family::Family;
using family::make_family;
using family::Vocabulary;

namespace {

Family family_of(const test::FamilyCase& one, family::Options options = {}) {
  std::vector<family::Variation> variations = test::variations_of(one);
  if (options.vocabulary == Vocabulary::extended) {
    const family::Layout layout = family::layout_of(one.model, Vocabulary::extended);
    for (std::size_t i = 0; i < layout.size(); ++i) {
      const family::Parameter& p = layout.parameters[i];
      if (p.quantity != family::Quantity::top) continue;
      for (family::Variation& v : variations) {  // a share as a length
        v.values[static_cast<Eigen::Index>(i)] *=
            2 * v.values[static_cast<Eigen::Index>(layout.extent(p.part, p.axis))];
      }
    }
  }
  Result<Family> made = make_family(one.model, std::move(variations), options);
  REQUIRE_MESSAGE(made.ok(), (made.ok() ? "" : made.error().message()));
  return std::move(*made);
}

/// A random setting inside the hulls and the stops, one slider after the other.
Eigen::VectorXd random_setting(const Family& family, Random& random) {
  Eigen::VectorXd setting = family.base_setting;
  for (std::size_t k = 0; k < family.sliders.size(); ++k) {
    const family::Interval stops = family::interval(family.bounds, setting, k);
    const double low = std::max(family.sliders[k].min, stops.low), high = std::min(family.sliders[k].max, stops.high);
    if (low < high) setting[static_cast<Eigen::Index>(k)] = random.uniform(low, high);
  }
  return setting;
}

std::set<std::string> names_of(const Family& family) {
  std::set<std::string> names;
  for (const family::Slider& slider : family.sliders) names.insert(slider.name);
  return names;
}

}  // namespace

TEST_CASE("family: the numbers of ReparamCAD's programs, all at once") {
  for (const test::FamilyCase& one : test::family_cases()) {
    CAPTURE(one.name);
    const nlohmann::json json = to_json(family_of(one));
    const nlohmann::json& exact = one.expected["votes"][0]["exact"];
    CHECK(json["counts"]["parameters"] == one.expected["table1"]["parameters"]);
    CHECK(json["counts"]["candidates"] == one.expected["candidates"]["all"]);
    CHECK(json["counts"]["holding"] == one.expected["table1"]["base_constraints"]);
    CHECK(json["counts"]["rank"] == one.expected["holding"]["rank"]);
    CHECK(json["counts"]["common"] == exact["common"]);
    CHECK(json["counts"]["independent"] == exact["independent"]);
    CHECK(json["counts"]["dimensions"] == exact["dimensions"]);
    CHECK(json["counts"]["sliders"] == one.expected["sliders_with_three_translations_pinned"]);
    CHECK(json["constraints"].size() == one.expected["table1"]["base_constraints"]);
    CHECK(json["warnings"].empty());
  }
}

TEST_CASE("family: the paper's selection and its two ablations") {
  for (const test::FamilyCase& one : test::family_cases()) {
    CAPTURE(one.name);
    const nlohmann::json& wanted = one.expected["votes"][0]["greedy_constraints_and_dimensions"];
    const auto dimensions = [&](family::Selection selection) {
      return family_of(one, {Vocabulary::paper, selection, 1e-6, {}}).dimensions();
    };
    CHECK(dimensions(family::Selection::ranking) == wanted["mean_shift_of_loss"][1]);
    CHECK(dimensions(family::Selection::ranking_by_derivative) == wanted["mean_shift_of_derivative"][1]);
    CHECK(dimensions(family::Selection::none) == one.expected["table1"]["parameters"]);
    const Result<Family> base_alone = make_family(one.model, {});
    REQUIRE(base_alone.ok());
    CHECK(base_alone->dimensions() == one.expected["holding"]["null_space"]);
    CHECK_FALSE(base_alone->warnings.empty());
  }
}

TEST_CASE("family: sliders are sizes that people name") {
  for (const test::FamilyCase& one : test::family_cases()) {
    const std::set<std::string> names = names_of(family_of(one));
    CHECK(names.size() == family_of(one).sliders.size());
    std::string all;
    for (const std::string& name : names) all += name + "; ";
    MESSAGE(one.name, ": ", all);
    if (one.name == "chair") {
      for (const char* wanted : {"leg height", "leg section", "seat width", "seat depth", "seat thickness",
                                 "back height", "back thickness", "arm width", "arm height", "arm depth"}) {
        CAPTURE(wanted);
        CHECK(names.count(wanted) == 1);
      }
    }
  }
}

TEST_CASE("family: replayed as an editing program to 1e-9") {
  for (const test::FamilyCase& one : test::family_cases()) {
    for (const Vocabulary vocabulary : {Vocabulary::paper, Vocabulary::extended}) {
      CAPTURE(one.name);
      const Family family = family_of(one, {vocabulary, family::Selection::agreement, 1e-6, {}});
      const Frame frame = family::drawn_frame(one.model);
      Shape shape;
      shape.name = one.name;
      for (std::size_t p = 0; p < one.model.parts.size(); ++p) {
        const cad::Part& part = one.model.parts[p];
        hand::add_box(shape, part.id, frame.to_normalised(part.centre), part.size / (2 * frame.scale));
        shape.parts[PartIndex(p)].node = static_cast<int>(p);
      }
      const Result<Program> program = family::family_program(family, shape.name, shape.sha256);
      REQUIRE(program.ok());
      const Status valid = validate(*program, shape);
      REQUIRE_MESSAGE(valid.ok(), (valid.ok() ? "" : valid.error().message()));
      if (vocabulary == Vocabulary::paper) {
        std::size_t statements = 0;
        for (const Layer& layer : program->layers) statements += layer.statements.size();
        MESSAGE(one.name, ": ", program->layers.size(), " layers, ", statements, " statements");
      }
      const Evaluator evaluate(*program, shape);
      Random random(3);
      double worst = 0;
      for (int k = 0; k < 250; ++k) {
        Eigen::VectorXd setting = random_setting(family, random);
        for (std::size_t s = 0; s < family.sliders.size(); ++s) {  // a share of a top is no linear edit
          const family::Parameter& p = family.layout.parameters[family.sliders[s].parameter];
          const auto at = static_cast<Eigen::Index>(s);
          if (p.quantity == family::Quantity::top && vocabulary == Vocabulary::paper)
            setting[at] = family.base_setting[at];
        }
        const State state = evaluate(family::program_values(family, setting));
        const cad::Model moved = family.at(setting);
        for (std::size_t p = 0; p < moved.parts.size(); ++p) {
          const cad::Part &now = moved.parts[p], &rest = one.model.parts[p];
          for (int c = 0; c < 8; ++c) {
            for (int axis = 0; axis < 3; ++axis) {
              double half = now.size[axis] / 2;
              if (rest.kind == cad::Kind::cone && axis != rest.axis && corner_sign(c, rest.axis) == rest.towards &&
                  vocabulary == Vocabulary::extended) {
                half = rest.size[axis] / 2 * now.top / rest.top;  // the box's edges shrink as the top does
              }
              const double wanted = (now.centre[axis] + corner_sign(c, axis) * half - frame.centre[axis]) / frame.scale;
              worst = std::max(worst, std::abs(state.parts[PartIndex(p)](c, axis) - wanted));
            }
          }
        }
      }
      CHECK(worst < 1e-9);
    }
  }
}

TEST_CASE("family: the layers fit the shape that comes of the GLB") {
  for (const GalleryProgram& entry : gallery_programs()) {
    CAPTURE(entry.id);
    const Result<cad::Model> model = cad::read_scad(entry.scad, entry.id);
    REQUIRE_MESSAGE(model.ok(), (model.ok() ? "" : model.error().message()));
    const family::Layout layout = family::layout_of(*model, Vocabulary::extended);
    auto variations = family::variations_from_json(nlohmann::json::parse(entry.variations), layout, *model);
    REQUIRE_MESSAGE(variations.ok(), (variations.ok() ? "" : variations.error().message()));
    const Result<Family> family = make_family(*model, *variations, {Vocabulary::extended, {}, 1e-6, {}});
    REQUIRE_MESSAGE(family.ok(), (family.ok() ? "" : family.error().message()));
    const Result<Abstraction> opened = abstract_shape(cad::to_glb(*model), entry.id);
    REQUIRE(opened.ok());
    const Result<Program> program = family::family_program(*family, opened->shape.name, opened->shape.sha256);
    REQUIRE(program.ok());
    const Status valid = validate(*program, opened->shape);
    CHECK_MESSAGE(valid.ok(), (valid.ok() ? "" : valid.error().message()));
    std::string names;
    for (const family::Slider& slider : family->sliders) names += slider.name + "; ";
    MESSAGE(entry.id, ": ", to_json(*family)["counts"].dump(), " ", names);
    CHECK(family->warnings.empty());
    CHECK(family->sliders.size() < family->layout.size() / 2 + 1);
    // Every variation lies within the stops.
    for (std::size_t v = 0; v < family->settings.size(); ++v) {
      std::vector<bool> present = family->variations[v].absent;
      present.flip();
      for (const family::Bound& bound : family->bounds) {
        if (bound.counts(present)) CHECK(bound.form.dot(family->settings[v]) + bound.constant > -1e-6);
      }
      // What it has stands where it stood, but for the whole's place.
      const family::Values placed =
          family::pinned_to(layout, family->pins, family->pinned, family->variations[v].values);
      const family::Values back = family->basis.values(family->settings[v], family->pinned);
      for (std::size_t i = 0; i < layout.size(); ++i) {
        if (!present[layout.parameters[i].part]) continue;
        CHECK(std::abs(back[static_cast<Eigen::Index>(i)] - placed[static_cast<Eigen::Index>(i)]) < 1e-6);
      }
    }
  }
}

TEST_CASE("family: exported as OpenSCAD it reads back as the base, and its variables move what the sliders move") {
  for (const test::FamilyCase& one : test::family_cases()) {
    for (const Vocabulary vocabulary : {Vocabulary::paper, Vocabulary::extended}) {
      CAPTURE(one.name);
      const Family family = family_of(one, {vocabulary, family::Selection::agreement, 1e-6, {}});
      const std::string text = family::family_scad(family);
      const auto difference = [](const cad::Model& a, const cad::Model& b) {
        double worst = a.parts.size() == b.parts.size() ? 0 : 1e9;
        for (std::size_t p = 0; p < a.parts.size() && worst < 1e9; ++p) {
          worst = std::max({worst, (a.parts[p].centre - b.parts[p].centre).norm(),
                            (a.parts[p].size - b.parts[p].size).norm(), std::abs(a.parts[p].top - b.parts[p].top)});
        }
        return worst;
      };
      const Result<cad::Model> base = cad::read_scad(text, one.name);
      REQUIRE_MESSAGE(base.ok(), (base.ok() ? "" : base.error().message() + "\n" + text));
      CHECK(difference(*base, one.model) < 1e-10);
      CHECK(base->ranges.size() == family.sliders.size());
      Random random(5);
      for (int k = 0; k < 5; ++k) {
        const Eigen::VectorXd setting = random_setting(family, random);
        std::string changed = text;  // the last assignment of a variable counts
        for (std::size_t s = 0; s < family.sliders.size(); ++s) {
          changed += family.sliders[s].variable + " = " + std::to_string(setting[static_cast<Eigen::Index>(s)]) + ";\n";
        }
        const Result<cad::Model> moved = cad::read_scad(changed, one.name);
        REQUIRE(moved.ok());
        CHECK(difference(*moved, family.at(setting)) < 1e-5);  // six decimals
      }
      for (const family::OptionalGroup& group : family.optional) {
        const std::string without = text + family::group_variable(family, group) + " = false;\n";
        const Result<cad::Model> less = cad::read_scad(without, one.name);
        REQUIRE(less.ok());
        CHECK(less->parts.size() == one.model.parts.size() - group.parts.size());
      }
      const nlohmann::json sets = family::parameter_sets(family);
      CHECK(sets["parameterSets"].size() == family.variations.size());
    }
  }
}

TEST_CASE("family: constraints can be forced and switched off by name") {
  cad::Model model;
  model.unit = "m";
  for (const char* id : {"a", "b"}) {
    cad::Part part;
    part.id = part.label = part.name = id;
    part.centre.x() = model.parts.empty() ? 0 : 1;
    model.tree.children.push_back({cad::Node::Op::leaf, model.parts.size(), {}});
    model.parts.push_back(part);
  }
  const std::size_t all = make_family(model, {})->sliders.size();
  const Result<Family> less =
      make_family(model, {}, {Vocabulary::paper, {}, 1e-6, {{"equal(a.sx,a.sy)", family::Choice::off}}});
  REQUIRE(less.ok());
  CHECK(less->sliders.size() == all);  // the other equalities still imply it
  family::Choices off;
  for (const family::Constraint& constraint : less->constraints) off[constraint.id()] = family::Choice::off;
  const Result<Family> none = make_family(model, {}, {Vocabulary::paper, {}, 1e-6, off});
  REQUIRE(none.ok());
  CHECK(none->sliders.size() == 12 - 3);
  CHECK(none->warnings.size() == 2);
  const Result<Family> unknown =
      make_family(model, {}, {Vocabulary::paper, {}, 1e-6, {{"equal(a.sx,c.sx)", family::Choice::off}}});
  REQUIRE_FALSE(unknown.ok());
  CHECK(unknown.error().place == "equal(a.sx,c.sx)");
}

TEST_CASE("family: one part, variations that share nothing, hostile names") {
  const Result<cad::Model> one = cad::read_scad("// \"]*/ x\ncube([1, 2, 3]);", "one");
  REQUIRE(one.ok());
  const Result<Family> single = make_family(*one, {});
  REQUIRE(single.ok());
  CHECK(single->sliders.size() == 3);
  CHECK_FALSE(single->warnings.empty());

  const Result<cad::Model> two = cad::read_scad("cube(1); translate([1, 0, 0]) cube(1);", "two");
  REQUIRE(two.ok());
  const family::Layout layout = family::layout_of(*two, Vocabulary::paper);
  family::Variation wild;
  wild.name = "wild";
  wild.values = family::values_of(layout, *two);
  wild.absent = {false, false};
  Random random(1);
  for (double& value : wild.values) value += random.uniform(0.1, 0.2);
  const Result<Family> nothing = make_family(*two, {wild});
  REQUIRE(nothing.ok());
  CHECK(nothing->independent.empty());
  CHECK(nothing->warnings.back().find("share none") != std::string::npos);

  cad::Model hostile = *two;
  hostile.parts[0].label = hostile.parts[0].name = "a*/ cube(9); /*\"]";
  const Result<Family> made = make_family(hostile, {});
  REQUIRE(made.ok());
  const Result<cad::Model> back = cad::read_scad(family::family_scad(*made), "back");
  REQUIRE_MESSAGE(back.ok(), (back.ok() ? "" : back.error().message()));
  CHECK(back->parts.size() == 2);

  cad::Model many;
  many.parts.resize(family::FamilyLimits::parts + 1);
  const Result<Family> refused = make_family(many, {});
  REQUIRE_FALSE(refused.ok());
  CHECK(refused.error().cause.find("more than 64 parts") != std::string::npos);
}

TEST_CASE("variations: JSON both ways, and what is wrong with it by place") {
  const Result<cad::Model> model =
      cad::read_scad("// seat\ncube([4, 4, 1]);\n// back\ntranslate([0, 3, 1]) cube([4, 1, 5]);", "seat");
  REQUIRE(model.ok());
  const family::Layout layout = family::layout_of(*model, Vocabulary::paper);
  const nlohmann::json good = nlohmann::json::parse(R"({"format": "parsel/variations", "version": 1, "variations": [
      {"name": "stool", "absent": ["back"], "bounds": {"seat": [[0, 6], [0, 1], [-6, 0]]}},
      {"name": "throne", "source": "model", "votes": 5, "values": {"back.sy": 9, "back.cy": 5.5}}]})");
  const auto read = family::variations_from_json(good, layout, *model);
  REQUIRE_MESSAGE(read.ok(), (read.ok() ? "" : read.error().message()));
  REQUIRE(read->size() == 2);
  CHECK((*read)[0].values[static_cast<Eigen::Index>(layout.find("seat.sx"))] == 6);
  CHECK((*read)[0].values[static_cast<Eigen::Index>(layout.find("seat.cz"))] == -3);
  CHECK_FALSE((*read)[0].has(1));
  CHECK((*read)[1].votes == 5);
  const nlohmann::json again = family::to_json(*read, layout, *model);
  const auto reread = family::variations_from_json(again, layout, *model);
  REQUIRE(reread.ok());
  CHECK(family::to_json(*reread, layout, *model) == again);

  const auto place = [&](const char* pointer, const nlohmann::json& value) {
    nlohmann::json bad = good;
    bad[nlohmann::json::json_pointer(pointer)] = value;
    const auto refused = family::variations_from_json(bad, layout, *model);
    CHECK_FALSE(refused.ok());
    return refused.ok() ? std::string() : refused.error().place;
  };
  CHECK(place("/format", "x") == "/format");
  CHECK(place("/variations", 3) == "/variations");
  CHECK(place("/variations/0/name", "throne") == "/variations/1/name");
  CHECK(place("/variations/0/name", " ") == "/variations/0/name");
  CHECK(place("/variations/0/colour", 1) == "/variations/0/colour");
  CHECK(place("/variations/0/absent/0", "leg") == "/variations/0/absent");
  CHECK(place("/variations/0/absent/1", "seat") == "/variations/0/absent");
  CHECK(place("/variations/0/bounds/leg", 1) == "/variations/0/bounds/leg");
  CHECK(place("/variations/0/bounds/seat/0", {6, 0}) == "/variations/0/bounds/seat");
  CHECK(place("/variations/1/values/back.sy", -1) == "/variations/1/values/back.sy");
  CHECK(place("/variations/1/values/back.sq", 1) == "/variations/1/values/back.sq");
  CHECK(place("/variations/1/votes", 0) == "/variations/1/votes");
  CHECK(place("/variations/1/source", "nobody") == "/variations/1/source");
}
