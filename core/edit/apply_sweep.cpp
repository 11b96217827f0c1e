#include "core/edit/apply_sweep.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "core/edit/apply_accessor.h"

namespace parsel::apply {
namespace {

using gltf::File;
using gltf::JsonText;
using gltf::Placement;
using nlohmann::ordered_json;

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

/// The node's placement at every sample, when its motion is one that a placement can say.
std::vector<Placement> placements_along(const File& file, const gltf::Scene& scene, const Frame& frame,
                                        const NodeEdit& edit, const Path& path) {
  const JsonText& json = file.item("nodes", edit.node);
  if (json.has("matrix") || !scene.children[edit.node].empty()) return {};
  for (const Slot& slot : edit.slots) {
    if (slot.keep && !slot.is_part) return {};
  }
  const Eigen::Affine3d parent = scene.parent_world(edit.node);
  if (std::abs(parent.linear().determinant()) < 1e-150) return {};
  const Placement before = gltf::placement(json);
  Eigen::Affine3d to_model = Eigen::Affine3d::Identity();
  to_model.linear() *= frame.scale;
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

bool has_targets(const File& file, std::size_t mesh) {
  const JsonText& primitives = file.item("meshes", mesh).get("primitives");
  for (std::size_t p = 0; p < primitives.size(); ++p) {
    if (primitives.item(p).has("targets")) return true;
  }
  return false;
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
      const Vec3 scale = gltf::placement(file.item("nodes", edit.node)).scale;
      const bool scales = std::any_of(track.placements.begin(), track.placements.end(),
                                      [&](const Placement& p) { return !p.scale.isApprox(scale, 1e-9); });
      // Coming and going needs the scale track for itself.
      if (scales && !track.visible.empty()) track.placements.clear();
      if (!track.placements.empty()) {
        track.keys = placement_keys(scene, frame, edit, *path, track.placements);
      } else if (has_targets(file, edit.mesh)) {
        warnings.push_back({place, "its motion is not in the animation, as its mesh has morph targets of its own"});
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

namespace {

/// Collects samplers and channels; equal times share an accessor.
class AnimationWriter {
 public:
  AnimationWriter(File& file, double seconds, std::size_t samples) : file_(file), seconds_(seconds), last_(samples - 1) {}

  /// `frames` are positions on the way there and back, 0 … 2·last, ascending; `values` their values in this order.
  void channel(std::size_t node, const char* path, const char* interpolation, const std::vector<std::size_t>& frames,
               const std::vector<double>& values, std::size_t components) {
    std::vector<float> floats;
    for (const double value : values) floats.push_back(static_cast<float>(value));
    const std::size_t output = gltf::append_accessor(file_, {floats, components, false, false});
    samplers_.push_back({{"input", times(frames)}, {"interpolation", interpolation}, {"output", output}});
    channels_.push_back({{"sampler", samplers_.size() - 1}, {"target", {{"node", node}, {"path", path}}}});
  }

  /// The keys on the way there and, mirrored, on the way back.
  std::vector<std::size_t> there_and_back(const std::vector<std::size_t>& keys) const {
    std::vector<std::size_t> frames = keys;
    for (std::size_t i = keys.size(); i-- > 0;) {
      if (keys[i] != last_) frames.push_back(2 * last_ - keys[i]);
    }
    return frames;
  }
  std::size_t sample_of(std::size_t frame) const { return frame <= last_ ? frame : 2 * last_ - frame; }
  std::size_t frames() const { return 2 * last_ + 1; }

  void finish(const std::string& name) {
    if (channels_.empty()) return;
    file_.append("animations", JsonText(ordered_json{{"name", name}, {"channels", channels_}, {"samplers", samplers_}}));
  }

 private:
  std::size_t times(const std::vector<std::size_t>& frames) {
    const auto known = times_.find(frames);
    if (known != times_.end()) return known->second;
    std::vector<float> floats;
    for (const std::size_t frame : frames) {
      floats.push_back(static_cast<float>(seconds_ * static_cast<double>(frame) / static_cast<double>(last_)));
    }
    return times_[frames] = gltf::append_accessor(file_, {floats, 1, true, false});
  }

  File& file_;
  double seconds_;
  std::size_t last_;
  std::map<std::vector<std::size_t>, std::size_t> times_;
  ordered_json samplers_ = ordered_json::array(), channels_ = ordered_json::array();
};

void write_placements(AnimationWriter& out, const Track& track, const Placement& rest) {
  const std::vector<std::size_t> frames = out.there_and_back(track.keys);
  std::vector<double> translations, rotations, scales;
  bool translates = false, rotates = false, scaled = false;
  for (const std::size_t frame : frames) {
    const Placement& at = track.placements[out.sample_of(frame)];
    translates = translates || !((at.translation - rest.translation).norm() <= 1e-9);
    rotates = rotates || !(std::abs(at.rotation.dot(rest.rotation)) >= 1 - 1e-12);
    scaled = scaled || !at.scale.isApprox(rest.scale, 1e-9);
    for (int c = 0; c < 3; ++c) translations.push_back(at.translation[c]);
    for (int c = 0; c < 4; ++c) rotations.push_back(at.rotation.coeffs()[c]);
    for (int c = 0; c < 3; ++c) scales.push_back(at.scale[c]);
  }
  if (translates) out.channel(track.node, "translation", "LINEAR", frames, translations, 3);
  if (rotates) out.channel(track.node, "rotation", "LINEAR", frames, rotations, 4);
  if (scaled) out.channel(track.node, "scale", "LINEAR", frames, scales, 3);
}

void write_weights(AnimationWriter& out, const Track& track) {
  const std::vector<std::size_t> frames = out.there_and_back(track.keys);
  std::vector<double> values;
  for (const std::size_t frame : frames) {
    const std::vector<double>& weights = track.weights[out.sample_of(frame)];
    values.insert(values.end(), weights.begin(), weights.end());
  }
  out.channel(track.node, "weights", "LINEAR", frames, values, 1);
}

void write_visibility(AnimationWriter& out, const Track& track, const Vec3& scale) {
  std::vector<std::size_t> frames;
  std::vector<double> values;
  for (std::size_t frame = 0; frame < out.frames(); ++frame) {
    const bool visible = track.visible[out.sample_of(frame)];
    if (frame > 0 && visible == track.visible[out.sample_of(frame - 1)]) continue;
    frames.push_back(frame);
    for (int c = 0; c < 3; ++c) values.push_back(visible ? scale[c] : 0.0);
  }
  out.channel(track.node, "scale", "STEP", frames, values, 3);
}

}  // namespace

void write_animation(File& file, const std::string& name, double seconds, const std::vector<Track>& tracks) {
  if (tracks.empty()) return;
  const Track& any = tracks[0];
  const std::size_t samples = std::max({any.placements.size(), any.weights.size(), any.visible.size()});
  AnimationWriter out(file, seconds, samples);
  for (const Track& track : tracks) {
    const Placement rest = gltf::placement(file.item("nodes", track.node));
    if (!track.placements.empty()) write_placements(out, track, rest);
    if (!track.weights.empty()) write_weights(out, track);
    if (!track.visible.empty()) write_visibility(out, track, rest.scale);
  }
  out.finish(name);
}

}  // namespace parsel::apply
