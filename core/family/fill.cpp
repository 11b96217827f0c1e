#include "core/family/fill.h"

#include <cmath>
#include <map>

namespace parsel::family {

namespace {

/// Σ coefficient · unknown = right, solved one equation at a time; what contradicts those before is passed over.
class Equations {
 public:
  void add(std::map<std::size_t, double> row, double right) {
    const std::map<std::size_t, double> given = row;
    for (const auto& [column, coefficient] : given) {
      const auto found = solved_.find(column);
      if (found != solved_.end()) subtract(row, right, found->second, coefficient);
    }
    if (row.empty()) return;  // fulfilled, or contradicted
    const auto [pivot, scale] = *row.begin();
    for (auto& entry : row) entry.second /= scale;
    Equation made{std::move(row), right / scale};
    for (auto& [other, equation] : solved_) {
      if (const auto found = equation.row.find(pivot); found != equation.row.end()) {
        subtract(equation.row, equation.right, made, found->second);
      }
    }
    solved_.emplace(pivot, std::move(made));
  }

  void write_into(Values& values) const {
    for (const auto& [pivot, equation] : solved_) {
      double value = equation.right;
      for (const auto& [column, coefficient] : equation.row) {
        if (column != pivot) value -= coefficient * values[static_cast<Eigen::Index>(column)];
      }
      values[static_cast<Eigen::Index>(pivot)] = value;
    }
  }

 private:
  struct Equation {
    std::map<std::size_t, double> row;
    double right = 0;
  };

  static void subtract(std::map<std::size_t, double>& row, double& right, const Equation& equation, double factor) {
    for (const auto& [column, coefficient] : equation.row) {
      double& entry = row[column];
      entry -= factor * coefficient;
      if (std::abs(entry) < 1e-9) row.erase(column);
    }
    right -= factor * equation.right;
  }

  std::map<std::size_t, Equation> solved_;
};

}  // namespace

Values filled(const Layout& layout, const std::vector<Constraint>& constraints, const std::vector<Evidence>& evidence,
              const Variation& variation, const Values& base, double tolerance) {
  Values values = variation.values;
  const auto is_open = [&](std::size_t parameter) { return !variation.has(layout.parameters[parameter].part); };
  for (std::size_t i = 0; i < layout.size(); ++i) {
    if (is_open(i)) values[static_cast<Eigen::Index>(i)] = base[static_cast<Eigen::Index>(i)];
  }
  Equations equations;
  for (const bool kept : {true, false}) {
    for (std::size_t i = 0; i < constraints.size(); ++i) {
      const bool is_touched = !variation.has(constraints[i].a.part) || !variation.has(constraints[i].b.part);
      if (evidence[i].is_kept != kept || !is_touched) continue;
      for (const SparseRow& given : constraints[i].rows()) {
        std::map<std::size_t, double> row;
        double right = 0;
        for (const auto& [column, coefficient] : given) {
          if (is_open(column)) {
            row[column] = coefficient.value();
          } else {
            right -= coefficient.value() * values[static_cast<Eigen::Index>(column)];
          }
        }
        equations.add(std::move(row), right);
      }
    }
  }
  equations.write_into(values);
  for (std::size_t i = 0; i < layout.size(); ++i) {
    const bool is_size = layout.parameters[i].quantity != Quantity::centre;
    double& value = values[static_cast<Eigen::Index>(i)];
    if (is_size && is_open(i) && !(value > tolerance)) value = base[static_cast<Eigen::Index>(i)];
  }
  return values;
}

Eigen::VectorXd projected(const Layout& layout, const Basis& basis, const Pins& pins, const Eigen::Vector3d& at,
                          const Values& filled) {
  return basis.free_values(pinned_to(layout, pins, at, filled));
}

Eigen::VectorXd mixed(const Eigen::VectorXd& base, const std::vector<Eigen::VectorXd>& variations,
                      const std::vector<double>& weights) {
  PARSEL_ASSERT(weights.size() == variations.size(), "one weight a variation");
  double sum = 0;
  Eigen::VectorXd made = Eigen::VectorXd::Zero(base.size());
  for (std::size_t v = 0; v < weights.size(); ++v) {
    PARSEL_ASSERT(weights[v] >= 0, "a weight is not negative");
    sum += weights[v];
    made += weights[v] * variations[v];
  }
  made += std::max(0.0, 1 - sum) * base;
  return made / std::max(1.0, sum);
}

}  // namespace parsel::family
