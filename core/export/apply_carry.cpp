#include "core/export/apply_carry.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "core/base/text.h"
#include "core/export/apply_channels.h"
#include "core/export/apply_levels.h"

namespace parsel::apply {
namespace {

using gltf::File;

/// Corners that agree to this are moved as one; below it is numerical noise of the evaluation.
constexpr double rigid_error = 1e-7;
/// Motions whose numbers agree to this are the same.
constexpr double same_motion = 1e-9;
/// A transform with a smaller determinant cannot be undone.
constexpr double smallest_determinant = 1e-150;

class Carrier {
 public:
  Carrier(File& file, gltf::Scene& scene, const Frame& frame, std::vector<NodeEdit>& edits,
          std::vector<Warning>& warnings)
      : file_(file), scene_(scene), frame_(frame), warnings_(warnings), channels_(file), rest_(scene.world) {
    for (NodeEdit& edit : edits) edits_[edit.node] = &edit;
  }

  /// The nodes whose lower levels of detail are to follow.
  std::vector<CarriedLevels> run() {
    find_own();
    find_common();
    find_hanging();
    given_.assign(scene_.size(), at_rest);
    for (const std::size_t n : scene_.order) place(n);
    for (const std::size_t n : scene_.order) warn_of_animations(n);
    return std::move(levels_);
  }

 private:
  using Motion = std::size_t;  ///< index into motions_
  static constexpr Motion at_rest = 0;
  static constexpr Motion none = SIZE_MAX;         ///< there is no part
  static constexpr Motion several = SIZE_MAX - 1;  ///< parts that move apart, or change their form

  static bool is_one(Motion m) { return m < several; }

  Motion known(const Eigen::Affine3d& by) {
    const auto same = [&](const Eigen::Affine3d& m) {
      return (m.matrix() - by.matrix()).cwiseAbs().maxCoeff() <= same_motion;
    };
    const auto found = std::find_if(motions_.begin(), motions_.end(), same);
    if (found != motions_.end()) return static_cast<Motion>(found - motions_.begin());
    motions_.push_back(by);
    return motions_.size() - 1;
  }

  /// A motion of the normalised frame in model coordinates.
  Eigen::Affine3d in_model(const Eigen::Affine3d& by) const {
    Eigen::Affine3d out = by;
    out.translation() = frame_.scale * by.translation() + frame_.centre - by.linear() * frame_.centre;
    return out;
  }

  static bool is_shown_part(const Slot& slot) { return slot.is_part && slot.keep; }

  Motion motion_of(const Slot& slot) {
    if (!slot.moves) return at_rest;
    const auto rigid = rigid_motion(slot.rest, slot.shown);
    return rigid ? known(*rigid) : several;
  }

  void find_own() {
    own_.assign(scene_.size(), none);
    for (const auto& [node, edit] : edits_) {
      for (const Slot& slot : edit->slots) {
        if (!is_shown_part(slot)) continue;
        const Motion m = motion_of(slot);
        own_[node] = own_[node] == none || own_[node] == m ? m : several;
      }
    }
  }

  /// From the leaves up: the one motion of all parts in a node and below it.
  void find_common() {
    common_ = own_;
    for (const auto& [node, edit] : edits_) {
      if (edit->added && own_[node] != none) common_[node] = several;  // it was nowhere before
    }
    for (std::size_t i = scene_.order.size(); i-- > 0;) {
      const std::size_t n = scene_.order[i];
      if (!scene_.parent[n]) continue;
      Motion& above = common_[*scene_.parent[n]];
      if (above == none) {
        above = common_[n];
      } else if (common_[n] != none && common_[n] != above) {
        above = several;
      }
    }
  }

  /// Which nodes take something along that has no mesh of its own to move: nodes below without parts, an animation, a
  /// camera, a light or another extension, levels of detail.
  void find_hanging() {
    hangs_.assign(scene_.size(), false);
    for (std::size_t i = scene_.order.size(); i-- > 0;) {
      const std::size_t n = scene_.order[i];
      const gltf::JsonText& node = file_.item("nodes", n);
      hangs_[n] = hangs_[n] || channels_.moves(n) || node.has("camera") || node.has("extensions");
      if (scene_.parent[n] && (common_[n] == none || (own_[n] == none && hangs_[n]))) hangs_[*scene_.parent[n]] = true;
    }
  }

  Motion above(std::size_t n) const { return scene_.parent[n] ? given_[*scene_.parent[n]] : at_rest; }

  /// The edit of the node right above, when that is a part which changes its form.
  const NodeEdit* changing_parent(std::size_t n) const {
    const auto parent = scene_.parent[n];
    if (!parent || own_[*parent] != several) return nullptr;
    return edits_.at(*parent);
  }

  Motion wanted(std::size_t n) {
    // Under a node that moves, every place has to be said anew; else only that of a pivot, or of a part on which
    // something hangs.
    const bool placed = hangs_[n] || above(n) != at_rest;
    if (is_one(own_[n])) return placed ? own_[n] : at_rest;
    if (own_[n] == several) return channels_.turns(n) ? with_form(*edits_.at(n), n, false) : above(n);
    if (is_one(common_[n])) return common_[n];
    const NodeEdit* parent = changing_parent(n);
    return parent != nullptr && common_[n] == none ? with_form(*parent, n, true) : above(n);
  }

  /// The motion of the place where node n is, in a part that changes its form.
  Motion with_form(const NodeEdit& edit, std::size_t n, bool turning) {
    const Vec3 origin = frame_.to_normalised(rest_[n].translation());
    for (const Slot& slot : edit.slots) {
      if (!is_shown_part(slot)) continue;
      const auto map =
          make_cage_map(Frame{}, slot.rest, Eigen::Affine3d::Identity(), slot.shown, Eigen::Affine3d::Identity(), true);
      if (!map) continue;
      // Outside of the cage its map is continued as it is at the nearest point.
      const Mat3 to_local = map->to_local;
      const Vec3 inside = (to_local * origin + map->offset).cwiseMax(-1.0).cwiseMin(1.0);
      const Vec3 nearest = to_local.inverse() * (inside - map->offset);
      const Mat3 jacobian = map->jacobian(nearest, map->corners);
      Eigen::Affine3d by = Eigen::Affine3d::Identity();
      const Vec3 to = map->point(nearest, map->corners) + jacobian * (origin - nearest);
      if (turning && jacobian.determinant() > 0) {
        Eigen::Affine3d local = Eigen::Affine3d::Identity();
        local.linear() = jacobian;
        const Mat3 turn = local.rotation();  // of the polar decomposition
        if (!((turn - Mat3::Identity()).cwiseAbs().maxCoeff() <= same_motion)) by.linear() = turn;
      }
      by.translation() = to - by.linear() * origin;
      if (by.matrix().allFinite()) return known(by);
    }
    return above(n);
  }

  void place(std::size_t n) {
    const Motion motion = wanted(n), inherited = above(n);
    const auto edit = edits_.find(n);
    const bool added = edit != edits_.end() && edit->second->added;
    given_[n] = inherited;
    const Eigen::Affine3d local = gltf::transform_of(file_.item("nodes", n)).affine();
    if (added) {
      place_added(*edit->second, local);
      return;
    }
    if (motion != inherited && move_to(n, local, in_model(motions_[motion]) * rest_[n])) {
      given_[n] = motion;
    } else {
      scene_.world[n] = scene_.parent_world(n) * local;
      if (motion != inherited && own_[n] == none) {
        warnings_.push_back({name_of(n),
                             "it stays where it was beside the part that it belongs to: its transform cannot "
                             "say the new place"});
      }
    }
    if (edit != edits_.end()) settle(*edit->second);
    if (!file_.original.nodes[n].levels.empty()) place_levels(n, local);
  }

  /// A new instance has its place already; under a node that moves it is said anew.
  void place_added(NodeEdit& edit, const Eigen::Affine3d& local) {
    const std::size_t n = edit.node;
    const bool carried = is_one(own_[n]) && changes_form(edit);
    scene_.world[n] = scene_.parent_world(n) * local;
    if (above(n) == at_rest) return;
    const bool placed = move_to(n, local, carried ? in_model(motions_[own_[n]]) * edit.rest_world : rest_[n]);
    if (placed && !carried) return;
    for (Slot& slot : edit.slots) slot.moves = is_shown_part(slot) && !placed;
  }

  /// Gives the node a new world transform. False, and nothing changed, when glTF or its animations cannot say it.
  bool move_to(std::size_t n, const Eigen::Affine3d& local, const Eigen::Affine3d& world) {
    const Eigen::Affine3d parent = scene_.parent_world(n);
    if (!(std::abs(parent.linear().determinant()) > smallest_determinant)) return false;
    const Eigen::Affine3d to = parent.inverse(Eigen::Affine) * world;
    gltf::JsonText node = file_.item("nodes", n);
    if (!to.matrix().allFinite() || !set_local_transform(node, to)) return false;
    if (channels_.moves(n)) {
      if (!(std::abs(local.linear().determinant()) > smallest_determinant)) return false;
      if (!channels_.move(n, to * local.inverse(Eigen::Affine))) return false;
    }
    *file_.find_item("nodes", n) = std::move(node);
    scene_.world[n] = parent * to;
    return true;
  }

  /// What the node's place says, its vertices need not.
  void settle(NodeEdit& edit) {
    for (Slot& slot : edit.slots) {
      if (!is_shown_part(slot)) continue;
      const bool moves = motion_of(slot) != given_[edit.node];
      if (moves && !slot.moves && !can_rewrite(edit, slot)) {
        warnings_.push_back(
            {"part " + slot.part, "it goes along with the node above it, as it cannot be edited itself"});
        continue;
      }
      slot.moves = moves;
    }
  }

  bool can_rewrite(const NodeEdit& edit, const Slot& slot) const {
    const bool rigged = file_.original.nodes[edit.node].skinned || file_.original.nodes[edit.node].instanced;
    return !rigged && make_cage_map(frame_, slot.rest, edit.rest_world, slot.shown, scene_.world[edit.node], true);
  }

  void place_levels(std::size_t n, const Eigen::Affine3d& local) {
    const auto edit = edits_.find(n);
    if (own_[n] == none && common_[n] == several) {
      warnings_.push_back({name_of(n), "its lower levels of detail stay as they were, as parts below it move apart"});
      return;
    }
    const Eigen::Affine3d now = gltf::transform_of(file_.item("nodes", n)).affine();
    const bool placed = now.matrix() != local.matrix();
    if (!placed && !(edit != edits_.end() && changes_form(*edit->second))) return;
    const auto parent = scene_.parent[n];
    levels_.push_back({n, parent ? rest_[*parent] : Eigen::Affine3d::Identity(),
                       placed ? Eigen::Affine3d(now * local.inverse(Eigen::Affine)) : Eigen::Affine3d::Identity()});
  }

  static bool changes_form(const NodeEdit& edit) {
    return std::any_of(edit.slots.begin(), edit.slots.end(), [](const Slot& s) { return s.moves; });
  }

  std::string name_of(std::size_t n) const {
    const std::string& name = n < file_.original.nodes.size() ? file_.original.nodes[n].name : std::string();
    return "node " + std::to_string(n) + (name.empty() ? "" : " (" + printable(name) + ")");
  }

  void warn_of_animations(std::size_t n) {
    const auto edit = edits_.find(n);
    if (edit == edits_.end() || own_[n] == none || own_[n] == at_rest) return;
    // An animation went along when the place of its node did; one above that did not goes on in the old place, unless
    // all that it moves went along.
    const bool changes = own_[n] == several, followed = changes ? given_[n] != above(n) : given_[n] == own_[n];
    bool moved = channels_.moves(n) && !followed;
    for (auto at = scene_.parent[n]; at && !moved; at = scene_.parent[*at]) {
      moved = channels_.moves(*at) && given_[*at] == above(*at) && (changes || given_[*at] != own_[n]);
    }
    if (!moved) return;
    warnings_.push_back({"node " + std::to_string(n),
                         "the file's own animations go on moving it; the edit was made in the pose at rest"});
  }

  File& file_;
  gltf::Scene& scene_;
  const Frame& frame_;
  std::vector<Warning>& warnings_;
  Channels channels_;
  const std::vector<Eigen::Affine3d> rest_;  ///< world transforms before
  std::map<std::size_t, NodeEdit*> edits_;
  std::vector<Eigen::Affine3d> motions_{Eigen::Affine3d::Identity()};  ///< of the normalised frame
  std::vector<Motion> own_;                                            ///< of the parts that a node shows
  std::vector<Motion> common_;                                         ///< of those and all below
  std::vector<Motion> given_;                                          ///< to the node
  std::vector<bool> hangs_;
  std::vector<CarriedLevels> levels_;
};

}  // namespace

std::optional<Eigen::Affine3d> rigid_motion(const Corners& from, const Corners& to) {
  auto motion = affine_motion({from}, {to}, rigid_error);
  if (!motion) return std::nullopt;
  const Mat3 turn = motion->linear();
  if ((turn.transpose() * turn - Mat3::Identity()).cwiseAbs().maxCoeff() > rigid_error || turn.determinant() < 0) {
    return std::nullopt;
  }
  motion->linear() = Eigen::Quaterniond(turn).normalized().toRotationMatrix();
  motion->translation() = to.colwise().mean().transpose() - motion->linear() * Vec3(from.colwise().mean().transpose());
  if (!((((from * motion->linear().transpose()).rowwise() + motion->translation().transpose()) - to)
            .cwiseAbs()
            .maxCoeff() <= 2 * rigid_error))
    return std::nullopt;
  return motion;
}

void carry_nodes(File& file, gltf::Scene& scene, const Frame& frame, std::vector<NodeEdit>& edits,
                 std::vector<Warning>& warnings) {
  const std::vector<CarriedLevels> levels = Carrier(file, scene, frame, edits, warnings).run();
  add_levels(file, scene, frame, levels, edits, warnings);
}

}  // namespace parsel::apply
