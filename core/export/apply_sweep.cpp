#include "core/export/apply_sweep.h"

#include <algorithm>
#include <cmath>

#include "core/gltf/primitive.h"

namespace parsel::apply {
namespace {

using gltf::File;
using gltf::JsonText;
using gltf::Placement;

/// Most of the error bound is for straight lines between keys; morph targets stop far below.
constexpr double key_error = 0.9 * sweep_error;
constexpr double target_error = 1e-5;
/// A motion counts as affine when it is so to numerical noise.
constexpr double affine_error = 1e-7;

/// The corners of all parts of one node at every sample; where it is absent, those of the last time it was there.
struct Path {
  std::vector<Corners> shown;                 ///< per part
  std::vector<std::vector<Corners>> samples;  ///< [sample][part]
  std::vector<bool> visible;
};

std::optional<Path> path_of(const NodeEdit& edit) {
  Path path;
  std::vector<const Slot*> parts;
  for (const Slot& slot : edit.slots) {
    if (!slot.keep || !slot.is_part || slot.samples.empty()) continue;
    parts.push_back(&slot);
    path.shown.push_back(slot.shown);
  }
  if (parts.empty()) return std::nullopt;
  const std::size_t count = parts[0]->samples.size();
  path.samples.assign(count, path.shown);
  path.visible.assign(count, false);
  for (std::size_t s = 0; s < count; ++s) {
    for (std::size_t i = 0; i < parts.size(); ++i) {
      const auto& sample = parts[i]->samples[s];
      if (sample) path.visible[s] = true;
      path.samples[s][i] = sample ? *sample : path.samples[s == 0 ? 0 : s - 1][i];
    }
  }
  return path;
}

double distance(const std::vector<Corners>& a, const std::vector<Corners>& b) {
  double worst = 0;
  for (std::size_t i = 0; i < a.size(); ++i) worst = std::max(worst, (a[i] - b[i]).rowwise().norm().maxCoeff());
  return worst;
}

/// Whether meshes hang below the node, which its motion would take along. Whatever else does is to go along.
bool shows_more_below(const File& file, const gltf::Scene& scene, std::size_t node) {
  std::vector<std::size_t> pending = scene.children[node];
  while (!pending.empty()) {
    const std::size_t n = pending.back();
    pending.pop_back();
    if (file.item("nodes", n).has("mesh")) return true;
    pending.insert(pending.end(), scene.children[n].begin(), scene.children[n].end());
  }
  return false;
}

/// The node's placement at every sample, when its motion is one that a placement can say.
std::vector<Placement> placements_along(const File& file, const gltf::Scene& scene, const Frame& frame,
                                        const NodeEdit& edit, const Path& path) {
  const JsonText& json = file.item("nodes", edit.node);
  if (json.has("matrix") || shows_more_below(file, scene, edit.node)) return {};
  for (const Slot& slot : edit.slots) {
    if (slot.keep && !slot.is_part) return {};
  }
  const Eigen::Affine3d parent = scene.parent_world(edit.node);
  if (std::abs(parent.linear().determinant()) < 1e-150) return {};
  const Placement before = gltf::transform_of(json).placement;
  Eigen::Affine3d to_model = Eigen::Affine3d::Identity();
  to_model.linear() = frame.scale * frame.axes.transpose();
  to_model.translation() = frame.centre;
  const Eigen::Affine3d back = parent.inverse(Eigen::Affine) * to_model;
  const Eigen::Affine3d forth = to_model.inverse(Eigen::Affine) * scene.world[edit.node];
  std::vector<Placement> out;
  for (const std::vector<Corners>& sample : path.samples) {
    const auto motion = affine_motion(path.shown, sample, affine_error);
    if (!motion) return {};
    auto local = gltf::decompose(back * *motion * forth, before.scale);
    if (!local) return {};
    const Eigen::Quaterniond& last = out.empty() ? before.rotation : out.back().rotation;
    if (last.dot(local->rotation) < 0) local->rotation.coeffs() *= -1;
    out.push_back(*local);
  }
  return out;
}

/// Keys between which interpolated placements keep every corner within the bound.
std::vector<std::size_t> placement_keys(const gltf::Scene& scene, const Frame& frame, const NodeEdit& edit,
                                        const Path& path, const std::vector<Placement>& placements) {
  const Eigen::Affine3d parent = scene.parent_world(edit.node);
  const Eigen::Affine3d inverse = scene.world[edit.node].inverse(Eigen::Affine);
  return select_keys(placements.size(), key_error, [&](std::size_t a, std::size_t b, std::size_t s) {
    const double t = static_cast<double>(s - a) / static_cast<double>(b - a);
    Placement between;
    between.translation = placements[a].translation + t * (placements[b].translation - placements[a].translation);
    between.scale = placements[a].scale + t * (placements[b].scale - placements[a].scale);
    between.rotation = placements[a].rotation.slerp(t, placements[b].rotation);
    const Eigen::Affine3d moved = parent * between.matrix() * inverse;
    double worst = 0;
    for (std::size_t i = 0; i < path.shown.size(); ++i) {
      for (int k = 0; k < 8; ++k) {
        const Vec3 at = frame.to_normalised(moved * frame.to_model(path.shown[i].row(k).transpose()));
        worst = std::max(worst, (at - path.samples[s][i].row(k).transpose()).norm());
      }
    }
    return worst;
  });
}

/// Spans the path by few displacements: again and again the pose that is furthest from what is spanned so far becomes
/// a target (pivoted Gram-Schmidt), until nothing is further than target_error. Returns weights[sample][target].
std::vector<std::vector<double>> span_path(const Path& path, std::vector<std::vector<Corners>>& targets) {
  std::vector<std::vector<Corners>> rest = path.samples;
  for (auto& sample : rest) {
    for (std::size_t i = 0; i < sample.size(); ++i) sample[i] -= path.shown[i];
  }
  std::vector<std::vector<double>> weights(rest.size());
  const std::vector<Corners> zero(path.shown.size(), Corners::Zero());
  const auto dot = [](const std::vector<Corners>& a, const std::vector<Corners>& b) {
    double sum = 0;
    for (std::size_t i = 0; i < a.size(); ++i) sum += a[i].cwiseProduct(b[i]).sum();
    return sum;
  };
  for (std::size_t limit = 24 * path.shown.size(); targets.size() < limit;) {
    std::size_t worst = 0;
    double most = 0;
    for (std::size_t s = 0; s < rest.size(); ++s) {
      const double here = distance(rest[s], zero);
      // The margin keeps the choice from hanging on rounding errors between equally far ends.
      if (here > most * (1 + 1e-9)) {
        most = here;
        worst = s;
      }
    }
    if (!(most > target_error)) break;
    const std::vector<Corners> target = rest[worst];
    const double norm = dot(target, target);
    for (std::size_t s = 0; s < rest.size(); ++s) {
      const double weight = s == worst ? 1.0 : dot(rest[s], target) / norm;
      weights[s].push_back(weight);
      for (std::size_t i = 0; i < target.size(); ++i) rest[s][i] -= weight * target[i];
    }
    targets.push_back(target);
  }
  return weights;
}

std::vector<std::size_t> weight_keys(const std::vector<std::vector<Corners>>& targets,
                                     const std::vector<std::vector<double>>& weights) {
  return select_keys(weights.size(), key_error, [&](std::size_t a, std::size_t b, std::size_t s) {
    const double t = static_cast<double>(s - a) / static_cast<double>(b - a);
    double worst = 0;
    for (std::size_t i = 0; i < targets[0].size(); ++i) {
      Corners off = Corners::Zero();
      for (std::size_t j = 0; j < targets.size(); ++j) {
        off += (weights[a][j] + t * (weights[b][j] - weights[a][j]) - weights[s][j]) * targets[j][i];
      }
      worst = std::max(worst, off.rowwise().norm().maxCoeff());
    }
    return worst;
  });
}

/// Whether a node may come and go by its scale.
bool can_hide(const File& file, const gltf::Scene& scene, const NodeEdit& edit) {
  return !file.item("nodes", edit.node).has("matrix") && scene.children[edit.node].empty();
}

}  // namespace

std::vector<Track> plan_tracks(const File& file, const gltf::Scene& scene, const Frame& frame,
                               std::vector<NodeEdit>& edits, std::vector<Warning>& warnings) {
  std::vector<Track> tracks;
  for (NodeEdit& edit : edits) {
    const auto path = path_of(edit);
    if (!path) continue;
    const std::string place = "node " + std::to_string(edit.node);
    Track track;
    track.node = edit.node;
    if (std::find(path->visible.begin(), path->visible.end(), false) != path->visible.end()) {
      if (can_hide(file, scene, edit)) {
        track.visible = path->visible;
      } else {
        warnings.push_back({place, "it stays visible in the animation, as it has a matrix or children"});
      }
    }
    double moved = 0;
    for (const auto& sample : path->samples) moved = std::max(moved, distance(sample, path->shown));
    if (moved > target_error) {
      track.placements = placements_along(file, scene, frame, edit, *path);
      const Vec3 scale = gltf::transform_of(file.item("nodes", edit.node)).placement.scale;
      const bool scales = std::any_of(track.placements.begin(), track.placements.end(),
                                      [&](const Placement& p) { return !p.scale.isApprox(scale, 1e-9); });
      // Coming and going needs the scale track for itself.
      if (scales && !track.visible.empty()) track.placements.clear();
      if (!track.placements.empty()) {
        track.keys = placement_keys(scene, frame, edit, *path, track.placements);
      } else if (!gltf::can_morph(file.original, file.original.meshes[edit.mesh])) {
        warnings.push_back(
            {place,
             "its motion is not in the animation, as its mesh has morph targets of its own or a primitive "
             "that cannot be read"});
      } else {
        std::vector<std::vector<Corners>> targets;
        track.weights = span_path(*path, targets);
        track.keys = weight_keys(targets, track.weights);
        std::size_t i = 0;
        for (Slot& slot : edit.slots) {
          if (!slot.keep || !slot.is_part || slot.samples.empty()) continue;
          for (const auto& target : targets) slot.targets.push_back(target[i]);
          ++i;
        }
      }
    }
    if (!track.keys.empty() || !track.visible.empty()) tracks.push_back(std::move(track));
  }
  return tracks;
}

}  // namespace parsel::apply
