// The tracks of apply_sweep.h as samplers and channels of a glTF animation.
#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>

#include "core/export/apply_accessor.h"
#include "core/export/apply_sweep.h"

namespace parsel::apply {
namespace {

using gltf::File;
using gltf::JsonText;
using gltf::Placement;
using nlohmann::ordered_json;

/// Collects samplers and channels; equal times share an accessor.
class AnimationWriter {
 public:
  AnimationWriter(File& file, double seconds, std::size_t samples)
      : file_(file), seconds_(seconds), last_(samples - 1) {}

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
    file_.append("animations",
                 JsonText(ordered_json{{"name", name}, {"channels", channels_}, {"samplers", samplers_}}));
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
    const Placement rest = gltf::transform_of(file.item("nodes", track.node)).placement;
    if (!track.placements.empty()) write_placements(out, track, rest);
    if (!track.weights.empty()) write_weights(out, track);
    if (!track.visible.empty()) write_visibility(out, track, rest.scale);
  }
  out.finish(name);
}

}  // namespace parsel::apply
