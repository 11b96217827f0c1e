// What two gallery edits of a model keep together: shared by the test of composed layers and by tests/eval/pairs.cpp.
#pragma once

#include <set>
#include <string>
#include <vector>

#include "core/edit/evaluate.h"
#include "core/gallery/gallery.h"
#include "core/propagate/compose.h"
#include "core/propagate/propagate.h"
#include "core/prove/deviation.h"
#include "core/prove/scope.h"
#include "core/shape/abstraction.h"

namespace parsel::test {

/// Of the relations that each of two layers keeps alone, at every state that is looked at: both ends, the middle and the
/// quarters of both ranges.
struct Kept {
  int together = 0, of = 0, inverted = 0;
  void operator+=(const Kept& other) {
    together += other.together;
    of += other.of;
    inverted += other.inverted;
  }
};

struct GalleryLayers {
  std::string model;
  Shape shape;
  std::vector<Program> edits;  ///< one layer each
  std::vector<std::string> ids;
};

/// What its edits become, each alone.
inline GalleryLayers gallery_layers(const GalleryModel& model) {
  const auto asset = build(model);
  PARSEL_ASSERT(asset.ok(), "the gallery's models can be built");
  auto abstraction = abstract_shape(asset->glb, model.id);
  PARSEL_ASSERT(abstraction.ok(), "the gallery's models can be read");
  GalleryLayers layers{model.id, std::move(abstraction->shape), {}, {}};
  for (const GalleryEdit& edit : asset->edits) {
    const auto request = edit_request_from_json(nlohmann::json::parse(edit.json));
    PARSEL_ASSERT(request.ok(), "the gallery's edits can be read");
    PropagateOptions options;
    options.request = edit.request;
    auto found = propagate(layers.shape, *request, options);
    PARSEL_ASSERT(found.ok(), "the gallery's edits can be propagated");
    layers.edits.push_back(std::move(found->program));
    layers.ids.push_back(edit.id);
  }
  return layers;
}

/// The two as they are alone, one after the other, under parameters x1 and x2.
inline Program side_by_side(const Program& first, const Program& second) {
  Program both = first;
  Layer layer = second.layers[0];
  const GiNaC::exmap by = {{parameter_symbol(layer.parameter.name), parameter_symbol("x2")}};
  for (Statement& statement : layer.statements) statement.amount = Amount(statement.amount.expression().subs(by));
  layer.parameter.name = "x2";
  both.layers.push_back(std::move(layer));
  return both;
}

/// `program` has two layers; `alone` the programs of each by itself.
inline Kept kept_together(const Shape& shape, const Program& program, std::string* worst = nullptr) {
  std::set<std::string> not_kept, disabled;
  for (const Layer& layer : program.layers) {
    for (const RelationReport& report : layer.relations) {
      if (report.status == RelationStatus::disabled) disabled.insert(report.id);
      if (report.status != RelationStatus::held) not_kept.insert(report.id);
    }
  }
  const Scope scope = scope_of(shape, program, 1, disabled);
  std::vector<std::pair<Constraint, double>> judged;
  for (const RelationIndex r : scope.relations) {
    if (not_kept.count(shape.relations[r].id) == 0)
      judged.emplace_back(make_constraint(shape, r), tolerance_of(shape.relations[r], scope));
  }
  const Evaluator evaluate(program, shape);
  Kept kept;
  std::vector<int> lost(judged.size());
  const auto at = [](const Parameter& p, int quarter) { return p.min + (p.max - p.min) * quarter / 4; };
  for (int i = 0; i <= 4; ++i) {
    for (int j = 0; j <= 4; ++j) {
      const State state = evaluate({at(program.layers[0].parameter, i), at(program.layers[1].parameter, j)});
      for (std::size_t k = 0; k < judged.size(); ++k) {
        ++kept.of;
        if (deviation(judged[k].first, state) <= judged[k].second) {
          ++kept.together;
        } else {
          ++lost[k];
        }
      }
      for (const PartIndex p : scope.edited) {
        if (!is_active(shape, p, scope.dissolved) && !shape.parts[p].group) continue;
        if (shape.parts[p].is_virtual() && !is_active(shape, p, scope.dissolved)) continue;
        kept.inverted += relative_jacobians(state.parts[p], shape.parts[p].hexahedron.corners).minCoeff() < 0;
      }
    }
  }
  for (std::size_t k = 0; worst != nullptr && k < judged.size(); ++k) {
    if (lost[k] == 0) continue;
    const Relation& relation = *judged[k].first.relation;
    *worst += " " + relation.id + "(" + std::string(to_string(relation.kind));
    for (const PartIndex p : relation.parts) {
      if (!relation.is_group()) *worst += " " + shape.parts[p].id;
    }
    *worst += "):" + std::to_string(lost[k]);
  }
  return kept;
}

}  // namespace parsel::test
