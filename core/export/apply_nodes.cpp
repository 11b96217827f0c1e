#include "core/export/apply_nodes.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>

#include "core/base/text.h"

namespace parsel::apply {
namespace {

using gltf::File;
using gltf::JsonText;

/// Corners that differ by no more than this are at rest.
constexpr double at_rest = 1e-12;
/// Cages with corners further out have no place in a file of floats, which end at 3.4e38.
constexpr double largest_corner = 1e37;
/// A new instance is a moved copy when its corners are that of one to numerical noise.
constexpr double moved_copy = 1e-7;

Error refusal(std::string place, std::string cause) {
  return {"edit/apply_nodes", std::move(place), std::move(cause), "inspect the file again and use that shape"};
}

/// The instance that a part is, and of which group.
struct Membership {
  RelationIndex relation;
  std::size_t instance = 0;
};

class Planner {
 public:
  Planner(File& file, gltf::Scene& scene, const Shape& shape, const State& state, const ApplyOptions& options,
          std::vector<Warning>& warnings)
      : file_(file), scene_(scene), shape_(shape), state_(state), options_(options), warnings_(warnings) {
    for (const Pose& pose : options.poses) samples_.push_back(&pose.state);
    if (!options.sweep) return;
    for (const State& sample : options.sweep->samples) samples_.push_back(&sample);
  }

  Result<NodeEdits> run() {
    if (Status s = check_states(); !s.ok()) return s.error();
    find_members();
    find_selection();
    if (Status s = add_existing(); !s.ok()) return s.error();
    add_instances();
    NodeEdits out;
    for (auto& [node, edit] : edits_) {
      set_aside(edit);
      out.any = out.any || edit.added;
      for (const Slot& slot : edit.slots) {
        out.any = out.any || !slot.keep || slot.moves || slot.hidden;
      }
      out.nodes.push_back(std::move(edit));
    }
    return out;
  }

 private:
  std::vector<const State*> all_states() const {
    std::vector<const State*> all{&state_};
    all.insert(all.end(), samples_.begin(), samples_.end());
    return all;
  }

  /// Whether the cage fits the floats of a file, in model units.
  bool fits_floats(const Corners& corners) const {
    return corners.allFinite() && (corners * shape_.frame.scale).cwiseAbs().maxCoeff() <= largest_corner;
  }

  Status check_states() const {
    for (const State* state : all_states()) {
      if (state->parts.size() != shape_.parts.size() || state->groups.size() != shape_.relations.size()) {
        return refusal("state", "it does not belong to the shape");
      }
      for (const Corners& corners : state->parts) {
        if (!fits_floats(corners)) return refusal("state", "a corner is not a number that a file can hold");
      }
      for (const GroupState& group : state->groups) {
        for (const Corners& corners : group.instances) {
          if (!fits_floats(corners)) return refusal("state", "a corner is not a number that a file can hold");
        }
      }
    }
    for (const Pose& pose : options_.poses) {
      for (const RelationIndex r : shape_.relations.indices()) {
        if (pose.state.groups[r].instances.size() == state_.groups[r].instances.size()) continue;
        return Error{"edit/apply_nodes", "morph target " + printable(pose.name),
                     "group " + shape_.relations[r].id + " has another number of instances in it",
                     "leave it out: a morph target moves what is there"};
      }
    }
    return success();
  }

  void find_members() {
    members_ = PartData<std::optional<Membership>>(shape_.parts.size());
    for (const RelationIndex r : shape_.relations.indices()) {
      const Relation& relation = shape_.relations[r];
      if (!relation.is_group()) continue;
      for (std::size_t k = 0; k < relation.parts.size(); ++k) members_[relation.parts[k]] = Membership{r, k};
    }
  }

  void find_selection() {
    for (const PartIndex p : options_.only_parts) {
      selected_.insert(p);
      selected_.insert(shape_.parts[p].members.begin(), shape_.parts[p].members.end());
    }
  }

  bool selected(PartIndex p) const { return options_.only_parts.empty() || selected_.count(p) > 0; }

  /// Where the part is in a state; none when its group has fewer instances by then.
  std::optional<Corners> corners_in(const State& state, PartIndex p) const {
    if (const auto& member = members_[p]) {
      const GroupState& group = state.groups[member->relation];
      if (group.count_changed) return instance_in(group, member->instance);
    }
    return state.parts[p];
  }

  static std::optional<Corners> instance_in(const GroupState& group, std::size_t k) {
    return k < group.instances.size() ? std::optional(group.instances[k]) : std::nullopt;
  }

  /// A slot with what the states say, `corners` telling where the thing is in a state.
  template <class CornersIn>
  Slot slot_of(const std::string& part, const Corners& rest, const CornersIn& corners) const {
    Slot slot;
    slot.is_part = true;
    slot.part = part;
    slot.rest = rest;
    const std::optional<Corners> now = corners(state_);
    std::optional<Corners> first;
    for (const State* sample : samples_) {
      slot.samples.push_back(corners(*sample));
      if (!first) first = slot.samples.back();
    }
    slot.hidden = !now && first;
    slot.keep = now || first;
    slot.shown = now ? *now : first ? *first : rest;
    slot.moves = slot.keep && !((slot.shown - rest).cwiseAbs().maxCoeff() <= at_rest);
    return slot;
  }

  Status add_existing() {
    // Everything in the scene with a mesh, when only some parts are to stay.
    for (std::size_t n = 0; n < scene_.size() && !options_.only_parts.empty(); ++n) {
      if (!scene_.shown[n] || !file_.item("nodes", n).has("mesh")) continue;
      if (NodeEdit* edit = edit_of(n)) {
        for (Slot& slot : edit->slots) slot.keep = false;
      }
    }
    for (const PartIndex p : shape_.parts.indices()) {
      const Part& part = shape_.parts[p];
      if (part.is_virtual()) continue;
      if (part.node < 0 || part.primitive < 0) return refusal("part " + part.id, "it has no node");
      NodeEdit* edit = edit_of(static_cast<std::size_t>(part.node));
      const auto primitive = static_cast<std::size_t>(part.primitive);
      if (edit == nullptr || primitive >= edit->slots.size()) {
        return refusal("part " + part.id, "the file has no such node or primitive");
      }
      Slot slot = slot_of(part.id, part.hexahedron.corners, [&](const State& s) { return corners_in(s, p); });
      if (!selected(p)) slot.keep = slot.moves = slot.hidden = false;
      edit->slots[primitive] = std::move(slot);
    }
    return success();
  }

  /// The edit of a node with a mesh, made at the first call; null when the file has no such thing.
  NodeEdit* edit_of(std::size_t node) {
    const auto known = edits_.find(node);
    if (known != edits_.end()) return &known->second;
    const auto mesh = file_.item("nodes", node).get("mesh").index();
    if (!mesh || node >= scene_.size()) return nullptr;
    NodeEdit edit;
    edit.node = node;
    edit.mesh = *mesh;
    edit.rest_world = scene_.world[node];
    edit.slots.resize(file_.item("meshes", *mesh).get("primitives").size());
    return &edits_.emplace(node, std::move(edit)).first->second;
  }

  /// New nodes for the instances that the file has no node for.
  void add_instances() {
    for (const RelationIndex r : shape_.relations.indices()) {
      const Relation& relation = shape_.relations[r];
      if (!relation.is_group() || relation.parts.empty()) continue;
      std::size_t most = relation.parts.size();
      for (const State* state : all_states()) {
        if (state->groups[r].count_changed) most = std::max(most, state->groups[r].instances.size());
      }
      for (std::size_t k = relation.parts.size(); k < most; ++k) add_instance(r, k);
    }
  }

  /// The member that new instances of the group are copies of.
  std::size_t copied_member(RelationIndex r) const {
    for (const State* state : all_states()) {
      const GroupState& group = state->groups[r];
      if (group.count_changed && group.source >= 0 &&
          static_cast<std::size_t>(group.source) < shape_.relations[r].parts.size()) {
        return static_cast<std::size_t>(group.source);
      }
    }
    return 0;
  }

  void add_instance(RelationIndex r, std::size_t k) {
    const PartIndex copied = shape_.relations[r].parts[copied_member(r)];
    const Part& part = shape_.parts[copied];
    const auto source = static_cast<std::size_t>(part.node);
    const auto primitive = static_cast<std::size_t>(part.primitive);
    const NodeEdit& template_edit = edits_.at(source);
    const Slot& template_slot = template_edit.slots[primitive];
    Slot slot = slot_of(part.id, part.hexahedron.corners, [&](const State& s) -> std::optional<Corners> {
      if (!s.groups[r].count_changed) return std::nullopt;
      return instance_in(s.groups[r], k);
    });
    if (!selected(copied) || !slot.keep || !template_slot.keep) return;
    if (const std::string fixed = gltf::why_fixed(file_.original, scene_, source); !fixed.empty()) {
      warnings_.push_back({"part " + part.id, "it gets no new instances: " + fixed});
      return;
    }

    NodeEdit edit;
    edit.mesh = template_edit.mesh;
    edit.rest_world = template_edit.rest_world;
    edit.added = true;
    edit.slots.resize(template_edit.slots.size());
    for (Slot& other : edit.slots) other.keep = false;

    JsonText node = file_.item("nodes", source);
    for (const char* key : {"children", "camera", "skin"}) node.erase(key);
    if (const auto name = node.get("name").string()) {
      node.set("name", JsonText(nlohmann::ordered_json(gltf::numbered_name(file_, *name))));
    }
    if (const auto placed = placed_like(template_slot, slot, source); placed && set_local_transform(node, *placed)) {
      slot.moves = template_slot.moves;  // in its own coordinates it looks like the template
    }
    edit.slots[primitive] = std::move(slot);
    edit.node = gltf::add_beside(file_, scene_, source, std::move(node));
    edits_.emplace(edit.node, std::move(edit));
  }

  /// The local transform that shows the template's mesh as the instance, if a rotation and translation can.
  std::optional<Eigen::Affine3d> placed_like(const Slot& from, const Slot& to, std::size_t source) const {
    const auto motion = affine_motion({from.shown}, {to.shown}, moved_copy);
    if (!motion) return std::nullopt;
    const Mat3& turn = motion->linear();
    if ((turn.transpose() * turn - Mat3::Identity()).cwiseAbs().maxCoeff() > moved_copy || turn.determinant() < 0) {
      return std::nullopt;
    }
    const Eigen::Affine3d parent = scene_.parent_world(source);
    if (!(std::abs(parent.linear().determinant()) > 1e-150)) return std::nullopt;
    Eigen::Affine3d model = Eigen::Affine3d::Identity();  // the motion in model coordinates
    model.linear() = shape_.frame.axes.transpose() * turn * shape_.frame.axes;
    model.translation() = shape_.frame.to_model(motion->translation()) - model.linear() * shape_.frame.centre;
    return parent.inverse(Eigen::Affine) * model * scene_.world[source];
  }

  /// What cannot show an edit stays as it was, and is named as it was when the file was opened.
  void set_aside(NodeEdit& edit) {
    const std::string fixed = edit.added ? "" : gltf::why_fixed(file_.original, scene_, edit.node);
    for (Slot& slot : edit.slots) {
      if (!slot.is_part || !slot.keep) continue;
      const auto differs = [&](const auto& sample) {
        return !sample || !((*sample - slot.shown).cwiseAbs().maxCoeff() <= at_rest);
      };
      const bool edited = slot.moves || std::any_of(slot.samples.begin(), slot.samples.end(), differs);
      if (!edited) {
        slot.samples.clear();
        continue;
      }
      const auto map =
          make_cage_map(shape_.frame, slot.rest, edit.rest_world, slot.shown, scene_.world[edit.node], slot.moves);
      const bool possible = map && map->corners.cwiseAbs().maxCoeff() <= largest_corner;
      if (possible && fixed.empty()) continue;
      warnings_.push_back({"part " + slot.part, "it stays as it is when it is edited: " +
                                                    (fixed.empty() ? "its new place is too flat, or too far" : fixed)});
      slot.moves = slot.hidden = false;
      slot.samples.clear();
    }
  }

  File& file_;
  gltf::Scene& scene_;
  const Shape& shape_;
  const State& state_;
  const ApplyOptions& options_;
  std::vector<Warning>& warnings_;
  std::vector<const State*> samples_;  ///< further states that the file is to show: poses, or along the sweep
  PartData<std::optional<Membership>> members_;
  std::set<PartIndex> selected_;           ///< of only_parts, members of virtual parts included
  std::map<std::size_t, NodeEdit> edits_;  ///< by node
};

}  // namespace

Result<NodeEdits> plan_nodes(File& file, gltf::Scene& scene, const Shape& shape, const State& state,
                             const ApplyOptions& options, std::vector<Warning>& warnings) {
  return Planner(file, scene, shape, state, options, warnings).run();
}

void remove_nodes(File& file, gltf::Scene& scene, const std::vector<NodeEdit>& edits, std::vector<Warning>& warnings) {
  std::set<std::size_t> emptied;
  for (const NodeEdit& edit : edits) {
    if (std::none_of(edit.slots.begin(), edit.slots.end(), [](const Slot& s) { return s.keep; })) {
      emptied.insert(edit.node);
    }
  }
  // From the leaves up: a node goes when it shows nothing itself and all its children go.
  std::vector<std::size_t> order;
  for (std::size_t n = 0; n < scene.size(); ++n) {
    if (!scene.parent[n]) order.push_back(n);
  }
  for (std::size_t i = 0; i < order.size(); ++i) {
    order.insert(order.end(), scene.children[order[i]].begin(), scene.children[order[i]].end());
  }
  std::set<std::size_t> going;
  for (std::size_t i = order.size(); i-- > 0;) {
    const std::size_t n = order[i];
    const std::vector<std::size_t>& children = scene.children[n];
    const bool children_go =
        std::all_of(children.begin(), children.end(), [&](std::size_t c) { return going.count(c) > 0; });
    if (emptied.count(n) > 0) {
      if (children_go) {
        going.insert(n);
        continue;
      }
      JsonText& node = *file.find_item("nodes", n);
      for (const char* key : {"mesh", "skin", "weights"}) node.erase(key);
      warnings.push_back({"node " + std::to_string(n), "its mesh is gone, but the node stays for its children"});
    } else if (!children.empty() && children_go) {
      const JsonText& node = file.item("nodes", n);
      if (!node.has("mesh") && !node.has("camera") && !node.has("extensions")) going.insert(n);
    }
  }
  // Only the topmost need detaching.
  std::set<std::size_t> top;
  for (const std::size_t n : going) {
    if (!scene.parent[n] || going.count(*scene.parent[n]) == 0) top.insert(n);
  }
  gltf::detach(file, scene, top);
}

}  // namespace parsel::apply
