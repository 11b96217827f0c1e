#include "core/family/ranking.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "core/base/tolerance.h"
#include "core/family/volume.h"

namespace parsel::family {

namespace {

using Matrix = Eigen::MatrixXd;

/// Weight of a part that is absent, relative to the lightest that is there.
constexpr double free_weight = 1e-4;

Matrix dense(const std::vector<SparseRow>& rows, std::size_t columns) {
  Matrix made = Matrix::Zero(static_cast<Eigen::Index>(rows.size()), static_cast<Eigen::Index>(columns));
  for (std::size_t r = 0; r < rows.size(); ++r) {
    for (const auto& [column, coefficient] : rows[r]) {
      made(static_cast<Eigen::Index>(r), static_cast<Eigen::Index>(column)) = coefficient.value();
    }
  }
  return made;
}

double solid_share(const cad::Part& part) {
  if (part.kind == cad::Kind::sphere) return pi / 6;
  return part.kind == cad::Kind::cylinder || part.kind == cad::Kind::cone ? pi / 4 : 1;
}

/// A variation on its way.
class Moving {
 public:
  Moving(const cad::Model& model, const Layout& layout, const Values& values, std::vector<bool> present,
         int gauss_points)
      : model_(model),
        layout_(layout),
        present_(std::move(present)),
        gauss_points_(gauss_points),
        original_(values),
        now_(values) {}

  /// Prepares for candidates on top of `chosen`, on which it lies.
  void prepare(const Matrix& chosen) {
    weigh();
    chosen_ = chosen;
    spread_ = chosen * mobility_.asDiagonal();
    if (chosen.rows() > 0) factor_.compute(spread_ * chosen.transpose());
  }

  /// Where the rows of one more constraint would take it; nothing to do gives the same values.
  Values moved(const Matrix& rows) const {
    const Eigen::VectorXd residual = rows * now_;
    if (residual.cwiseAbs().maxCoeff() < 1e-13) return now_;
    Matrix tilted = rows * mobility_.asDiagonal();
    if (chosen_.rows() > 0) tilted -= (factor_.solve(spread_ * rows.transpose())).transpose() * spread_;
    const Eigen::SelfAdjointEigenSolver<Matrix> gram(tilted * rows.transpose());
    const double largest = gram.eigenvalues().cwiseAbs().maxCoeff();
    Eigen::VectorXd multipliers = gram.eigenvectors().transpose() * residual;
    for (Eigen::Index i = 0; i < multipliers.size(); ++i) {
      const double value = gram.eigenvalues()[i];
      multipliers[i] = value > 1e-9 * largest ? multipliers[i] / value : 0;
    }
    return now_ - tilted.transpose() * (gram.eigenvectors() * multipliers);
  }

  double similarity(const Values& a, const Values& b) const {
    if (a == b) return 1;
    const cad::Model at_a = with_values(layout_, model_, a), at_b = with_values(layout_, model_, b);
    for (std::size_t p = 0; p < present_.size(); ++p) {
      if (present_[p] && (at_a.parts[p].size.minCoeff() <= 0 || at_b.parts[p].size.minCoeff() <= 0)) return 0;
    }
    return overlap(at_a.parts, at_b.parts, present_, gauss_points_).iou();
  }
  double step_similarity(const Values& next) const { return similarity(now_, next); }
  double loss() const { return 1 - similarity(original_, now_); }
  void go(const Values& next) { now_ = next; }

 private:
  void weigh() {
    const std::size_t parts = present_.size();
    std::vector<Vec3> weights(parts);
    double least = 1e300;
    for (std::size_t p = 0; p < parts; ++p) {
      for (int axis = 0; axis < 3; ++axis) {
        const double area = size(p, (axis + 1) % 3) * size(p, (axis + 2) % 3);
        weights[p][axis] = std::abs(area) * solid_share(model_.parts[p]);
        if (present_[p]) least = std::min(least, weights[p][axis]);
      }
    }
    mobility_ = Eigen::VectorXd::Ones(now_.size());
    for (std::size_t p = 0; p < parts; ++p) {
      for (int axis = 0; axis < 3; ++axis) {
        const double w = present_[p] ? std::max(weights[p][axis], 1e-12) : free_weight * least;
        mobility_[static_cast<Eigen::Index>(layout_.centre(p, axis))] = 1 / (2 * w * w);
        mobility_[static_cast<Eigen::Index>(layout_.extent(p, axis))] = 2 / (w * w);
      }
    }
    mobility_ /= mobility_.maxCoeff();
  }
  double size(std::size_t part, int axis) const { return now_[static_cast<Eigen::Index>(layout_.extent(part, axis))]; }

  const cad::Model& model_;
  const Layout& layout_;
  std::vector<bool> present_;
  int gauss_points_;
  Values original_, now_;
  Eigen::VectorXd mobility_;
  Matrix chosen_, spread_;
  Eigen::LDLT<Matrix> factor_;
};

/// Where one change of the mean leaves the least squares: the first index of the second half. Either half has two values
/// or more, as change point detection has it: one value is no level.
std::size_t change_of_mean(const std::vector<double>& values) {
  constexpr std::size_t shortest = 2;
  const auto squares = [&](std::size_t begin, std::size_t end) {
    double sum = 0, square = 0;
    for (std::size_t i = begin; i < end; ++i) sum += values[i];
    const double mean = sum / static_cast<double>(end - begin);
    for (std::size_t i = begin; i < end; ++i) square += (values[i] - mean) * (values[i] - mean);
    return square;
  };
  std::size_t best = values.size();
  double least = 1e300;
  for (std::size_t i = shortest; i + shortest <= values.size(); ++i) {
    const double cost = squares(0, i) + squares(i, values.size());
    if (cost < least) {
      least = cost;
      best = i;
    }
  }
  return best;
}

}  // namespace

Ranking rank_constraints(const cad::Model& model, const Layout& layout, const Values& base,
                         const std::vector<Constraint>& constraints, const std::vector<Variation>& variations,
                         int gauss_points) {
  std::vector<Moving> moving;
  for (const Variation& variation : variations) {
    std::vector<bool> present(model.parts.size());
    for (std::size_t p = 0; p < present.size(); ++p) present[p] = variation.has(p);
    moving.emplace_back(model, layout, variation.values, std::move(present), gauss_points);
  }
  if (moving.empty())
    moving.emplace_back(model, layout, base, std::vector<bool>(model.parts.size(), true), gauss_points);

  std::vector<std::vector<SparseRow>> rows;
  std::vector<Matrix> matrices;
  std::vector<std::size_t> left;
  for (std::size_t i = 0; i < constraints.size(); ++i) {
    rows.push_back(constraints[i].rows());
    matrices.push_back(dense(rows.back(), layout.size()));
    left.push_back(i);
  }
  Elimination chosen(layout.size());
  std::vector<SparseRow> chosen_rows;
  Ranking ranking;
  for (;;) {
    std::erase_if(left, [&](std::size_t i) {
      return std::none_of(rows[i].begin(), rows[i].end(),
                          [&](const SparseRow& row) { return chosen.raises_rank(row); });
    });
    if (left.empty()) return ranking;
    const Matrix now = dense(chosen_rows, layout.size());
    for (Moving& one : moving) one.prepare(now);
    std::size_t best = left.front();
    double best_score = -1;
    for (const std::size_t i : left) {
      double score = 1;
      for (const Moving& one : moving) {
        if (score <= best_score) break;
        score *= one.step_similarity(one.moved(matrices[i]));
      }
      if (score > best_score) {
        best_score = score;
        best = i;
      }
    }
    double loss = 0;
    for (Moving& one : moving) {
      one.go(one.moved(matrices[best]));
      loss += one.loss() / static_cast<double>(moving.size());
    }
    ranking.order.push_back(best);
    ranking.losses.push_back(loss);
    for (const SparseRow& row : rows[best]) {
      if (chosen.add(row)) chosen_rows.push_back(row);
    }
    std::erase(left, best);
  }
}

std::size_t cutoff_by_mean(const std::vector<double>& losses) {
  return change_of_mean(losses);
}

std::size_t cutoff_by_derivative(const std::vector<double>& losses) {
  std::vector<double> slopes;  // one-sided at both ends
  for (std::size_t i = 0; i < losses.size(); ++i) {
    const std::size_t before = i == 0 ? 0 : i - 1, after = std::min(i + 1, losses.size() - 1);
    slopes.push_back((losses[after] - losses[before]) / std::max(1.0, static_cast<double>(after - before)));
  }
  return change_of_mean(slopes);
}

}  // namespace parsel::family
