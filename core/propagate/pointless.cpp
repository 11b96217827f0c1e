#include "core/propagate/pointless.h"

#include <Eigen/Dense>
#include <algorithm>

#include "core/base/tolerance.h"

namespace parsel {

namespace {

/// Two motions of the whole that differ by no more than this are the same rigid one.
constexpr double rigid_noise = 1e-5;

/// The rigid motion that takes `before` nearest to `after` (Kabsch 1976).
std::pair<Mat3, Vec3> rigid_motion(const Corners& before, const Corners& after) {
  const Vec3 a = before.colwise().mean().transpose(), b = after.colwise().mean().transpose();
  const Mat3 covariance = (before.rowwise() - a.transpose()).transpose() * (after.rowwise() - b.transpose());
  const Eigen::JacobiSVD<Mat3> svd(covariance, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Mat3 v = svd.matrixV();
  if ((v * svd.matrixU().transpose()).determinant() < 0) v.col(2) *= -1;
  const Mat3 rotation = v * svd.matrixU().transpose();
  return {rotation, b - rotation * a};
}

struct Question {
  const Graph& graph;
  const ResolvedRequest& request;
  const Edits& seeds;
  const Feet& feet;

  bool is_seed(PartIndex part) const { return seeds[part] != nullptr; }

  /// Whether all of a row do what was asked of one: who names one drawer does not mean all.
  bool moves_the_row(const Edits& edits) const {
    return std::any_of(request.dissolved.begin(), request.dissolved.end(), [&](RelationIndex group) {
      const std::vector<PartIndex>& row = graph.shape().relations[group].parts;
      const auto named = std::find_if(row.begin(), row.end(), [&](PartIndex part) { return is_seed(part); });
      if (named == row.end()) return false;
      const Motion& asked = seeds[*named]->motion;
      return std::all_of(row.begin(), row.end(), [&](PartIndex part) {
        if (part == *named) return true;
        if (is_seed(part) || request.hints.count(part) > 0 || !edits[part]) return false;
        const Motion& motion = edits[part]->motion;
        return std::max((motion.front() - asked.front()).cwiseAbs().maxCoeff(),
                        (motion.back() - asked.back()).cwiseAbs().maxCoeff()) <= exact;
      });
    });
  }

  /// Whether all that stands, or, where nothing does, all, moves by one rigid motion.
  bool moves_as_one(const Edits& edits) const {
    std::vector<PartIndex> body;
    for (const auto& [part, footing] : feet) body.push_back(part);
    if (feet.empty()) {
      for (const PartIndex part : graph.parts()) {
        if (!graph.relations(part).empty() || is_seed(part)) body.push_back(part);
      }
      if (body.size() < 2) return false;
    }
    const auto is_asked = [&](PartIndex part) { return is_seed(part) || request.hints.count(part) > 0; };
    if (body.empty()) return false;
    if (std::all_of(body.begin(), body.end(), is_asked)) return false;
    const auto moves = [&](PartIndex part) { return edits[part] && !edits[part]->steps.empty(); };
    if (!std::all_of(body.begin(), body.end(), moves)) return false;
    for (const std::size_t s : {std::size_t{0}, sample_count - 1}) {
      const Corners& rest = graph.shape().parts[body.front()].hexahedron.corners;
      const auto [rotation, shift] = rigid_motion(rest, rest + edits[body.front()]->motion[s]);
      for (const PartIndex part : body) {
        const Corners& before = graph.shape().parts[part].hexahedron.corners;
        const Corners moved = (before * rotation.transpose()).rowwise() + shift.transpose();
        if ((moved - before - edits[part]->motion[s]).cwiseAbs().maxCoeff() > rigid_noise) return false;
      }
    }
    return true;
  }
};

}  // namespace

bool is_pointless(const Graph& graph, const ResolvedRequest& request, const Edits& seeds, const Feet& feet,
                  const Edits& edits) {
  const Question question{graph, request, seeds, feet};
  return question.moves_as_one(edits) || question.moves_the_row(edits);
}

}  // namespace parsel
