#include "core/family/candidates.h"

#include <algorithm>
#include <cmath>

namespace parsel::family {

namespace {

constexpr std::string_view axis_names = "xyz";

std::string signed_axis(int axis, int side) {
  return {axis_names[static_cast<std::size_t>(axis)], side < 0 ? '-' : '+'};
}

bool is_round(const cad::Part& part) {
  return part.kind == cad::Kind::cylinder || part.kind == cad::Kind::cone;
}

bool has_plane(const cad::Part& part, int axis, Vocabulary vocabulary) {
  if (part.kind == cad::Kind::sphere) return vocabulary == Vocabulary::extended;
  if (!is_round(part) || part.axis == axis) return true;
  return vocabulary == Vocabulary::extended && part.kind == cad::Kind::cylinder;
}

class Finder {
 public:
  Finder(const Layout& layout, const cad::Model& model, const Values& values, double tolerance)
      : layout_(layout), model_(model), values_(values), tolerance_(tolerance) {}

  Candidates find() {
    for (int axis = 0; axis < 3; ++axis) pair_up(ConstraintKind::coplanar, planes(axis), true);
    for (int axis = 0; axis < 3; ++axis) pair_up(ConstraintKind::coaxial, axes(axis), false);
    pair_up(ConstraintKind::coincident, points(), true);
    pair_up(ConstraintKind::equal, sizes(), true);
    return std::move(found_);
  }

 private:
  Form centre(std::size_t part, int axis) const { return {{layout_.centre(part, axis), 2}}; }

  std::vector<Feature> planes(int axis) const {
    std::vector<Feature> features;
    for (std::size_t p = 0; p < model_.parts.size(); ++p) {
      if (!has_plane(model_.parts[p], axis, layout_.vocabulary)) continue;
      for (const int side : {-1, 1}) {
        features.push_back(
            {p, model_.parts[p].id + "." + signed_axis(axis, side), {plane_form(layout_, p, axis, side)}});
      }
    }
    return features;
  }

  std::vector<Feature> axes(int axis) const {
    std::vector<Feature> features;
    for (std::size_t p = 0; p < model_.parts.size(); ++p) {
      const cad::Part& part = model_.parts[p];
      if (part.kind == cad::Kind::sphere || (is_round(part) && part.axis != axis)) continue;
      Feature feature{p, part.id + "." + axis_names[static_cast<std::size_t>(axis)], {}};
      for (int other = 0; other < 3; ++other) {
        if (other != axis) feature.forms.push_back(centre(p, other));
      }
      features.push_back(std::move(feature));
    }
    return features;
  }

  Feature point(std::size_t p, const LocalTriple& at) const {
    Feature feature{p, model_.parts[p].id + ".", {}};
    for (int axis = 0; axis < 3; ++axis) {
      const int side = at[static_cast<std::size_t>(axis)];
      if (side != 0) feature.name += signed_axis(axis, side);
      feature.forms.push_back(side == 0 ? centre(p, axis) : plane_form(layout_, p, axis, side));
    }
    if (feature.name.ends_with('.')) feature.name += "centre";
    return feature;
  }

  std::vector<Feature> points() const {
    std::vector<Feature> features;
    for (std::size_t p = 0; p < model_.parts.size(); ++p) {
      const cad::Part& part = model_.parts[p];
      if (part.kind == cad::Kind::sphere) {
        features.push_back(point(p, {0, 0, 0}));
      } else if (is_round(part)) {
        for (const int side : {-1, 1}) {
          LocalTriple at{0, 0, 0};
          at[static_cast<std::size_t>(part.axis)] = side;
          features.push_back(point(p, at));
        }
      } else {
        for (const int x : {-1, 1}) {
          for (const int y : {-1, 1}) {
            for (const int z : {-1, 1}) features.push_back(point(p, {x, y, z}));
          }
        }
      }
    }
    return features;
  }

  std::vector<Feature> sizes() const {
    std::vector<Feature> features;
    for (std::size_t i = 0; i < layout_.size(); ++i) {
      const Parameter& parameter = layout_.parameters[i];
      const bool is_length = parameter.quantity == Quantity::size ||
                             (parameter.quantity == Quantity::top && layout_.vocabulary == Vocabulary::extended);
      if (is_length) features.push_back({parameter.part, parameter.name, {{{i, 2}}}});
    }
    return features;
  }

  void pair_up(ConstraintKind kind, const std::vector<Feature>& features, bool within_parts) {
    // The features' values once: most pairs differ, and only what holds is built.
    std::vector<std::vector<double>> at;
    for (const Feature& feature : features) {
      std::vector<double>& values = at.emplace_back();
      for (const Form& form : feature.forms) values.push_back(value_of(form, values_));
    }
    std::size_t& count = found_.count.by_kind[static_cast<std::size_t>(kind)];
    for (std::size_t i = 0; i < features.size(); ++i) {
      for (std::size_t j = i + 1; j < features.size(); ++j) {
        if (!within_parts && features[i].part == features[j].part) continue;
        ++count;
        const bool holds = std::equal(at[i].begin(), at[i].end(), at[j].begin(),
                                      [&](double a, double b) { return std::abs(a - b) <= tolerance_; });
        if (holds) found_.holding.push_back({kind, features[i], features[j]});
      }
    }
  }

  const Layout& layout_;
  const cad::Model& model_;
  const Values& values_;
  double tolerance_;
  Candidates found_;
};

}  // namespace

std::string_view to_string(ConstraintKind kind) {
  constexpr std::string_view words[] = {"coplanar", "coaxial", "coincident", "equal"};
  return words[static_cast<std::size_t>(kind)];
}

std::string Constraint::id() const {
  return std::string(to_string(kind)) + "(" + a.name + "," + b.name + ")";
}

std::vector<SparseRow> Constraint::rows() const {
  std::vector<SparseRow> rows;
  for (std::size_t i = 0; i < a.forms.size(); ++i) {
    SparseRow& row = rows.emplace_back();
    for (const Term& term : a.forms[i]) row[term.parameter] = row[term.parameter] + Rational(term.halves, 2);
    for (const Term& term : b.forms[i]) row[term.parameter] = row[term.parameter] - Rational(term.halves, 2);
    std::erase_if(row, [](const auto& entry) { return entry.second.is_zero(); });
  }
  return rows;
}

double Constraint::residual(const Values& values) const {
  double worst = 0;
  for (std::size_t i = 0; i < a.forms.size(); ++i) {
    worst = std::max(worst, std::abs(value_of(a.forms[i], values) - value_of(b.forms[i], values)));
  }
  return worst;
}

double value_of(const Form& form, const Values& values) {
  double sum = 0;
  for (const Term& term : form) sum += term.halves * values[static_cast<Eigen::Index>(term.parameter)];
  return sum / 2;
}

Form plane_form(const Layout& layout, std::size_t part, int axis, int side) {
  return {{layout.centre(part, axis), 2}, {layout.extent(part, axis), side}};
}

Candidates find_candidates(const Layout& layout, const cad::Model& model, const Values& values, double tolerance) {
  return Finder(layout, model, values, tolerance).find();
}

}  // namespace parsel::family
