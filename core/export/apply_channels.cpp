#include "core/export/apply_channels.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "core/export/apply_accessor.h"

namespace parsel::apply {
namespace {

using gltf::File;
using gltf::JsonText;

/// A linear part that differs from a rotation by more than this scales or shears.
constexpr double rigid_error = 1e-6;
/// A rotation by less than this is rounding noise, and keys stay as they are.
constexpr double no_turn = 1e-12;

bool is_rigid(const Mat3& m) {
  return (m.transpose() * m - Mat3::Identity()).cwiseAbs().maxCoeff() <= rigid_error && m.determinant() > 0;
}

}  // namespace

Channels::Channels(File& file) : file_(file) {
  for (std::size_t a = 0; a < file.size("animations"); ++a) {
    const JsonText& channels = file.item("animations", a).get("channels");
    for (std::size_t c = 0; c < channels.size(); ++c) {
      const JsonText& target = channels.item(c).get("target");
      const auto node = target.get("node").index();
      const auto sampler = channels.item(c).get("sampler").index();
      const std::string path = target.get("path").string().value_or("");
      if (!node || !sampler || (path != "translation" && path != "rotation" && path != "scale")) continue;
      channels_[*node].push_back({a, c, *sampler, path});
    }
  }
}

bool Channels::turns(std::size_t node) const {
  const auto found = channels_.find(node);
  return found != channels_.end() && std::any_of(found->second.begin(), found->second.end(),
                                                 [](const Channel& c) { return c.path != "translation"; });
}

std::optional<std::vector<float>> Channels::moved_keys(const Channel& channel, const Eigen::Affine3d& by) const {
  const JsonText& sampler = file_.item("animations", channel.animation).get("samplers").item(channel.sampler);
  const auto output = sampler.get("output").index();
  if (!output) return std::nullopt;
  const auto keys = gltf::read_accessor(file_.original, *output);
  const bool turn = channel.path == "rotation";
  const std::size_t components = turn ? 4 : 3;
  if (!keys.ok() || file_.original.accessors[*output].components != components) return std::nullopt;
  // A cubic spline has a tangent before and after every key; tangents turn, but do not move.
  const bool cubic = sampler.get("interpolation").string() == "CUBICSPLINE";
  const Eigen::Quaterniond rotation(by.linear());
  std::vector<float> moved;
  for (std::size_t i = 0; i < keys->size(); i += components) {
    const double* k = keys->data() + i;
    if (turn) {
      const Eigen::Quaterniond q = rotation * Eigen::Quaterniond(k[3], k[0], k[1], k[2]);
      for (int c = 0; c < 4; ++c) moved.push_back(static_cast<float>(q.coeffs()[c]));
    } else {
      const bool tangent = cubic && i / components % 3 != 1;
      const Vec3 v(k[0], k[1], k[2]);
      const Vec3 to = by.linear() * v + (tangent ? Vec3(Vec3::Zero()) : Vec3(by.translation()));
      for (int c = 0; c < 3; ++c) moved.push_back(static_cast<float>(to[c]));
    }
  }
  return moved;
}

bool Channels::move(std::size_t node, const Eigen::Affine3d& by) {
  const auto found = channels_.find(node);
  if (found == channels_.end()) return true;
  if (!is_rigid(by.linear())) return false;
  const bool turns = !((by.linear() - Mat3::Identity()).cwiseAbs().maxCoeff() <= no_turn);
  std::vector<std::pair<const Channel*, std::vector<float>>> all;
  for (const Channel& channel : found->second) {
    if (channel.path == "scale" || (channel.path == "rotation" && !turns)) continue;
    auto moved = moved_keys(channel, by);
    if (!moved) return false;
    all.emplace_back(&channel, std::move(*moved));
  }
  for (const auto& [channel, values] : all) {
    const std::size_t components = channel->path == "rotation" ? 4 : 3;
    const std::size_t output = gltf::append_accessor(file_, {values, components, false, false});
    JsonText* animation = file_.find_item("animations", channel->animation);
    JsonText* samplers = animation->find("samplers");
    JsonText sampler = samplers->item(channel->sampler);
    sampler.set("output", JsonText(output));
    samplers->push_back(std::move(sampler));  // others may use the old one
    const std::size_t index = samplers->size() - 1;
    animation->find("channels")->find_item(channel->channel)->set("sampler", JsonText(index));
  }
  return true;
}

}  // namespace parsel::apply
