// Sliders as morph targets: what a viewer shows at weight 1 is what the program gives at the end of the slider.
#include "core/gallery/gallery.h"
#include "core/propagate/propagate.h"
#include "core/shape/abstraction.h"
#include "tests/core/morph_fixture.h"

using namespace parsel;
using namespace parsel::morph_fixture;

namespace {

/// A model of the gallery with some of its edits, a layer each: x1, x2, …
struct Edited {
  std::string file;
  Abstraction model;
  Program program;

  Edited(const char* id, const std::vector<std::string>& edits) {
    const auto asset = build(*find_gallery_model(id));
    REQUIRE(asset.ok());
    file = asset->glb;
    auto abstracted = abstract_shape(file, id);
    REQUIRE(abstracted.ok());
    model = std::move(abstracted).value();
    for (const std::string& name : edits) {
      const auto edit =
          std::find_if(asset->edits.begin(), asset->edits.end(), [&](const GalleryEdit& e) { return e.id == name; });
      REQUIRE(edit != asset->edits.end());
      PropagateOptions options;
      options.request = edit->request;
      options.parameter = "x" + std::to_string(program.layers.size() + 1);
      const auto found = propagate(model.shape, *edit_request_from_json(nlohmann::json::parse(edit->json)), options);
      REQUIRE(found.ok());
      program.shape_name = found->program.shape_name;
      program.shape_sha256 = found->program.shape_sha256;
      program.layers.push_back(found->program.layers[0]);
    }
    REQUIRE(validate(program, model.shape).ok());
  }
};

}  // namespace

TEST_CASE("sliders: a chair with two sliders shows at weight 1 what the program gives at the end of the range") {
  const Edited chair("chair", {"widen", "longer_legs"});
  for (const std::vector<double>& values : {std::vector<double>{0, 0}, std::vector<double>{0.1, -0.05}}) {
    const SlidersApplied out = morphed(chair.file, chair.model.shape, chair.program, values);
    const std::string& glb = out.applied.glb;
    CHECK(out.applied.warnings.empty());
    REQUIRE(out.sliders.size() == 2);
    CHECK(out.sliders[0].targets == std::vector<std::string>{"Widen the chair.", "Widen the chair. −"});
    CHECK(out.sliders[1].parameter == "x2");
    CHECK(furthest(displayed(glb, {}), displayed(applied(chair.file, chair.model.shape, chair.program, values), {})) <
          1e-9);
    for (std::size_t i = 0; i < 2; ++i) {
      const Slider& slider = out.sliders[i];
      CHECK(slider.linear);
      CHECK(slider.error < 1e-6);
      const Parameter& parameter = chair.program.layers[i].parameter;
      for (const double weight : {1.0, 0.35}) {
        for (const bool upwards : {true, false}) {
          std::vector<double> at = values;
          at[i] += weight * ((upwards ? parameter.max : parameter.min) - at[i]);
          const std::string truth = applied(chair.file, chair.model.shape, chair.program, at);
          const WeightsByName weights{{slider.targets[upwards ? 0 : 1], weight}};
          CHECK(furthest(displayed(glb, weights), displayed(truth, {})) < 1e-5);
          if (weight == 1) CHECK(furthest(displayed(glb, weights, true), displayed(truth, {}, true)) < 1e-5);
          // Of a linear slider, a negative weight does the same for viewers that allow it.
          const double other = -weight * ((upwards ? parameter.max : parameter.min) - values[i]) /
                               (values[i] - (upwards ? parameter.min : parameter.max));
          CHECK(furthest(displayed(glb, {{slider.targets[upwards ? 1 : 0], other}}), displayed(truth, {})) < 1e-5);
        }
      }
    }
    // Both at 1: no more is off than the result says.
    std::vector<double> at;
    for (const Layer& layer : chair.program.layers) at.push_back(layer.parameter.max);
    const double off = furthest(displayed(glb, {{out.sliders[0].targets[0], 1}, {out.sliders[1].targets[0], 1}}),
                                displayed(applied(chair.file, chair.model.shape, chair.program, at), {}));
    CHECK(off < out.together + 1e-5);
    CHECK(out.worst_pair.size() == 2);
  }
}

TEST_CASE("sliders: a slider that turns gets poses on the way, and its error is the one that is seen") {
  const Edited chair("chair", {"lean_back"});
  const SlidersApplied out = morphed(chair.file, chair.model.shape, chair.program, {0});
  const Slider& slider = out.sliders.at(0);
  CHECK_FALSE(slider.linear);
  const std::string name = "Lean the back of the chair backwards.";
  REQUIRE(slider.targets.size() > 2);
  CHECK(slider.targets[0] == name);
  std::vector<double> stops{0};
  std::vector<std::string> stop_names{""};
  for (const std::string& target : slider.targets) {
    if (target == name || target.find("−") != std::string::npos) continue;
    stops.push_back(std::stod(target.substr(name.size())) / 100);
    stop_names.push_back(target);
  }
  stops.push_back(1);
  stop_names.push_back(name);
  const double max = chair.program.layers[0].parameter.max;
  const auto off = [&](double x, const WeightsByName& weights) {
    return furthest(displayed(out.applied.glb, weights),
                    displayed(applied(chair.file, chair.model.shape, chair.program, {x * max}), {}));
  };
  double worst = 0, worst_straight = 0;
  for (std::size_t s = 0; s + 1 < stops.size(); ++s) {
    CHECK(off(stops[s + 1], {{stop_names[s + 1], 1}}) < 1e-5);
    for (const double t : {0.25, 0.5, 0.75}) {
      const double x = stops[s] + t * (stops[s + 1] - stops[s]);
      worst = std::max(worst, off(x, {{stop_names[s], 1 - t}, {stop_names[s + 1], t}}));
      worst_straight = std::max(worst_straight, off(x, {{name, x}}));
    }
  }
  MESSAGE("error " << worst << " m seen, " << slider.error << " m told; with the ends alone " << worst_straight
                   << " m seen, " << slider.straight << " m told");
  CHECK(worst < 1.1 * slider.error + 1e-6);
  CHECK(worst > 0.3 * slider.error);
  CHECK(worst_straight < 1.1 * slider.straight);
  CHECK(worst_straight > 0.5 * slider.straight);
  CHECK(slider.straight > 3 * slider.error);
}

TEST_CASE("sliders: edits of the gallery, at the ends of their sliders") {
  std::size_t sliders = 0;
  for (const char* id : {"cabinet", "windmill", "bookcase"}) {
    const auto asset = build(*find_gallery_model(id));
    for (const GalleryEdit& edit : asset->edits) {
      const Edited model(id, {edit.id});
      CAPTURE(id);
      CAPTURE(edit.id);
      const auto out = apply_sliders(model.file, model.model.shape, model.program, {0});
      if (!out.ok()) {
        CHECK(out.error().cause.find("how many instances") != std::string::npos);
        continue;
      }
      const Parameter& parameter = model.program.layers[0].parameter;
      for (const std::string& target : out->sliders.at(0).targets) {
        if (target.back() == '%') continue;
        const bool down = target.size() > 3 && target.substr(target.size() - 3) == "−";
        const double end = down ? parameter.min : parameter.max;
        CHECK(furthest(displayed(out->applied.glb, {{target, 1}}),
                       displayed(applied(model.file, model.model.shape, model.program, {end}), {})) < 1e-5);
        ++sliders;
      }
    }
  }
  CHECK(sliders > 10);
}

TEST_CASE("sliders: two sliders together are measured") {
  const Boxes model(1);
  const Program program = program_of(
      "layer \"wide\": x1 = 0 in [-0.3, 0.3]\n"
      "  scale_1d(\"part_0\", amount=x1, origin=(0, 0, 0), direction=(1, 0, 0))\n"
      "layer \"wider\": x2 = 0 in [-0.3, 0.2]\n"
      "  scale_1d(\"part_0\", amount=x2, origin=(0, 0, 0), direction=(1, 0, 0))\n",
      model.shape);
  const SlidersApplied out = morphed(model.glb.bytes(), model.shape, program, {0, 0});
  CHECK(out.together == doctest::Approx(0.3 * 0.2 * 0.3));  // half-width × the product of both
  CHECK(out.worst_pair == std::vector<std::string>{"wide", "wider"});
  REQUIRE(out.applied.warnings.size() == 1);
  CHECK(out.applied.warnings[0].text.find("0.018 m") != std::string::npos);
  const double off = furthest(displayed(out.applied.glb, {{"wide", 1}, {"wider", 1}}),
                              displayed(applied(model.glb.bytes(), model.shape, program, {0.3, 0.2}), {}));
  CHECK(off == doctest::Approx(out.together).epsilon(1e-4));
}

TEST_CASE("sliders: layers that change counts are left out by name, and refused when nothing else is left") {
  Boxes model(2);
  model.shape.relations.push_back({"t1",
                                   RelationKind::translation,
                                   {PartIndex(0), PartIndex(1)},
                                   Translation{PartIndex(2), Vec3::Zero(), Vec3(1, 0, 0), 0, 1}});
  Part parent;
  parent.id = "row";
  parent.members = {PartIndex(0), PartIndex(1)};
  parent.group = RelationIndex(0);
  parent.hexahedron.corners = box(model.low, model.high + Vec3(1, 0, 0));
  model.shape.parts.push_back(parent);
  model.shape.parts[PartIndex(0)].group = model.shape.parts[PartIndex(1)].group = RelationIndex(0);
  const std::string counts =
      "layer \"more of them\": x1 = 0 in [-0.3, 0.3]\n"
      "  change_count(\"t1\", amount=10*x1, anchor=start)\n";
  const std::string moves =
      "layer \"up\": x2 = 0 in [-0.3, 0.3]\n"
      "  translate(\"row\", amount=x2, direction=(0, 1, 0))\n";
  const Program both = program_of(moves + counts, model.shape);
  const SlidersApplied out = morphed(model.glb.bytes(), model.shape, both, {0, 0});
  REQUIRE(out.sliders.size() == 1);
  CHECK(out.sliders[0].targets[0] == "up");
  REQUIRE(out.applied.warnings.size() == 1);
  CHECK(out.applied.warnings[0].place == "layer 2 (more of them)");

  const auto refused = apply_sliders(model.glb.bytes(), model.shape, program_of(counts, model.shape), {0});
  REQUIRE_FALSE(refused.ok());
  CHECK(refused.error().place == "layer 1 (more of them)");
  CHECK(refused.error().cause.find("x1 changes how many instances there are") != std::string::npos);
  CHECK_FALSE(refused.error().fix.empty());

  // The count that is set stays, and what moves the new instances moves them by weight.
  const SlidersApplied more = morphed(model.glb.bytes(), model.shape, both, {0, 0.2});
  CHECK(furthest(displayed(more.applied.glb, {{"up", 1}}),
                 displayed(applied(model.glb.bytes(), model.shape, both, {0.3, 0.2}), {})) < 1e-6);
  CHECK(json_of(more.applied.glb)["nodes"].size() == 4);

  ApplyOptions options;
  options.poses.push_back({"more", Evaluator(both, model.shape)({0, 0.2})});
  const auto pose = apply_state(model.glb.bytes(), model.shape, Evaluator(both, model.shape)({0, 0}), options);
  REQUIRE_FALSE(pose.ok());
  CHECK(pose.error().place == "morph target more");
}

TEST_CASE("sliders: names are short, whole and unique; sliders without effect are named") {
  const Boxes model(1);
  const std::string lift = "  translate(\"part_0\", amount=";
  std::string text;
  const std::vector<std::string> requests = {
      "up", "up", "   ", "Make it ever so much higher than it has been so far, if you please", "ü\\u202eber", "still"};
  for (std::size_t i = 0; i < requests.size(); ++i) {
    const std::string x = "x" + std::to_string(i + 1);
    text += "layer \"" + requests[i] + "\": " + x + " = 0 in [0, 0.3]\n";
    if (requests[i] != "still") text += lift + x + ", direction=(0, 1, 0))\n";
  }
  text += "layer \"fixed\": y = 0 in [0, 0]\n" + lift + "y, direction=(0, 1, 0))\n";
  const Program program = program_of(text, model.shape);
  const SlidersApplied out = morphed(model.glb.bytes(), model.shape, program, std::vector<double>(7, 0.0));
  std::vector<std::string> names;
  for (const Slider& slider : out.sliders) names.insert(names.end(), slider.targets.begin(), slider.targets.end());
  CHECK(names == std::vector<std::string>{"up", "up 2", "x3", "Make it ever so much higher than it has…", "ü ber"});
  CHECK(json_of(out.applied.glb)["meshes"][0]["extras"]["targetNames"] == ordered_json(names));
  REQUIRE(out.applied.warnings.size() == 2);
  CHECK(out.applied.warnings[0].place == "layer 6 (still)");
  CHECK(out.applied.warnings[1].place == "layer 7 (fixed)");
  CHECK_FALSE(apply_sliders(model.glb.bytes(), model.shape, program, {0}).ok());

  // Nothing moves: the file as it was.
  const SlidersApplied none =
      morphed(model.glb.bytes(), model.shape, program_of("layer \"\": y = 0 in [0, 0]\n", model.shape), {0});
  CHECK(none.sliders.empty());
  CHECK(none.applied.glb == model.glb.bytes());
}
