#include "core/shape/abstraction.h"

#include <algorithm>
#include <map>
#include <set>
#include <utility>

#include "core/base/sha256.h"
#include "core/base/text.h"
#include "core/shape/alike.h"
#include "core/shape/attachment.h"
#include "core/shape/contact_points.h"
#include "core/shape/contacts.h"
#include "core/shape/frame.h"
#include "core/shape/gltf_import.h"
#include "core/shape/ground.h"
#include "core/shape/group.h"
#include "core/shape/label.h"
#include "core/shape/oriented_box.h"
#include "core/shape/symmetry.h"

namespace parsel {
namespace {

/// +y of the normalised frame.
constexpr int up_axis = 1;

/// Whether a box touches the same box moved by `delta`: no axis parts them by more than a joint may gape.
bool touch_each_other(const Hexahedron& box, const Vec3& delta) {
  const Vec3 apart = (box.axes * delta).cwiseAbs() - 2 * box.half_extents();
  return apart.maxCoeff() <= contact_distance;
}

/// Builds the graph from meshes, aligned boxes and symmetries.
class Builder {
 public:
  Builder(Shape& shape, const PartData<PartMesh>& meshes, Symmetries symmetries, const std::vector<Declared>& declared)
      : shape_(shape), meshes_(meshes), symmetries_(std::move(symmetries)), declared_(declared) {}

  void run(const PartData<Hexahedron>& boxes) {
    add_parts(boxes);
    add_reflections();
    add_groups();
    add_attachments();
    add_ground();
  }

 private:
  void add_parts(const PartData<Hexahedron>& boxes) {
    for (const PartIndex p : meshes_.indices()) {
      Part part;
      part.label = meshes_[p].label;
      part.node = meshes_[p].node;
      part.primitive = meshes_[p].primitive;
      part.hexahedron = boxes[p];
      shape_.parts.push_back(std::move(part));
    }
    for (const SymmetryGroup& group : symmetries_.groups) {
      Part parent;
      // Instances of one group may carry directions in their labels: then what they share names the group.
      parent.label = meshes_[group.parts.front()].label;
      const bool one_label = std::all_of(group.parts.begin(), group.parts.end(),
                                         [&](PartIndex p) { return meshes_[p].label == parent.label; });
      if (!one_label) parent.label = grouping_key(parent.label);
      parent.label += " group";
      parent.members = group.parts;
      parent.hexahedron = group_box(group, boxes);
      parents_.push_back(shape_.parts.push_back(std::move(parent)));
      for (const PartIndex p : group.parts) parent_of_[p] = parents_.back();
    }
    align_parents();

    std::vector<std::string> labels, given;
    std::vector<Vec3> centres;
    for (const PartMesh& mesh : meshes_) given.push_back(mesh.name);
    given.resize(shape_.parts.size());
    for (const Part& part : shape_.parts) {
      labels.push_back(part.label);
      centres.push_back(part.hexahedron.point(Vec3::Zero()));
    }
    const std::vector<PartName> names = name_parts(labels, centres, given);
    for (const PartIndex p : shape_.parts.indices()) {
      shape_.parts[p].id = names[p.value()].id;
      shape_.parts[p].name = names[p.value()].name;
    }
  }

  /// Parents of mirrored groups become exact images, like their instances.
  void align_parents() {
    const auto& groups = symmetries_.groups;
    std::vector<bool> placed(groups.size(), false);
    for (std::size_t g = 0; g < groups.size(); ++g) {
      placed[g] = true;
      for (std::size_t h = g + 1; h < groups.size(); ++h) {
        const auto plane = mirrors_between(groups[g], groups[h], symmetries_.mirrors);
        if (!plane) continue;
        parent_mirrors_.push_back({parents_[g], parents_[h], plane->axis, plane->offset});
        if (placed[h]) continue;
        placed[h] = true;
        shape_.parts[parents_[h]].hexahedron =
            mirrored(shape_.parts[parents_[g]].hexahedron, plane->axis, plane->offset);
      }
    }
  }

  RelationIndex add(char letter, RelationKind kind, std::vector<PartIndex> parts, decltype(Relation::detail) detail) {
    const std::string id = letter + std::to_string(++count_[letter]);
    return shape_.relations.push_back({id, kind, std::move(parts), std::move(detail)});
  }

  void add_reflections() {
    std::vector<MirrorPair> all = symmetries_.mirrors;
    all.insert(all.end(), parent_mirrors_.begin(), parent_mirrors_.end());
    std::stable_sort(all.begin(), all.end(), [](const MirrorPair& m, const MirrorPair& n) {
      return std::pair(m.a, m.b) < std::pair(n.a, n.b);
    });
    for (const MirrorPair& m : all) {
      Reflection reflection;
      reflection.normal = Vec3::Unit(m.axis);
      reflection.origin = m.offset * reflection.normal;
      reflection.stacked = m.axis == up_axis;
      // Boxes tied along several ways (four legs: two planes) agree up to rounding; what does not agree is no relation.
      const Corners& to = shape_.parts[m.b].hexahedron.corners;
      const Corners image = mirrored(shape_.parts[m.a].hexahedron, m.axis, m.offset).corners;
      if ((image - to).cwiseAbs().maxCoeff() > 1e-6) continue;
      for (int k = 0; k < 8; ++k) reflection.corner_map[static_cast<std::size_t>(k)] = k ^ (1 << m.axis);
      add('r', RelationKind::reflection, {m.a, m.b}, reflection);
    }
  }

  void add_groups() {
    for (std::size_t g = 0; g < symmetries_.groups.size(); ++g) {
      const SymmetryGroup& group = symmetries_.groups[g];
      const PartIndex parent = parents_[g];
      const Hexahedron& box = shape_.parts[parent].hexahedron;
      const auto centre = [&](PartIndex p) { return shape_.parts[p].hexahedron.point(Vec3::Zero()); };
      RelationIndex relation;
      if (group.kind == SymmetryGroup::Kind::translation) {
        Translation t{parent, centre(group.parts.front()), centre(group.parts.back()), 0, 1};
        const Vec3 along = box.axes * (t.end - t.start);
        along.cwiseAbs().maxCoeff(&t.axis);
        t.direction = along[t.axis] > 0 ? 1 : -1;
        t.touching = touch_each_other(shape_.parts[group.parts[0]].hexahedron, group.delta);
        relation = add('t', RelationKind::translation, group.parts, t);
      } else {
        Rotation r{parent, group.centre, group.axis, 0, 0};
        const Vec3 first = centre(group.parts.front()) - group.centre;
        r.centre += group.axis.dot(first) * group.axis;
        r.radius = (first - group.axis.dot(first) * group.axis).norm();
        (box.axes * group.axis).cwiseAbs().maxCoeff(&r.parent_axis);
        relation = add('o', RelationKind::rotation, group.parts, r);
      }
      shape_.parts[parent].group = relation;
      for (const PartIndex p : group.parts) shape_.parts[p].group = relation;
    }
  }

  /// Where real parts meet, and what was declared of it.
  std::pair<Contacts, CorrectedContacts> real_contacts() const {
    PartData<Hexahedron> boxes;
    MeasuredAxes axes;
    for (const PartIndex p : meshes_.indices()) {
      boxes.push_back(shape_.parts[p].hexahedron);
      axes.push_back({shape_.parts[p].hexahedron.axes});
      if (const auto parent = parent_of(p)) axes[p].push_back(shape_.parts[*parent].hexahedron.axes);
    }
    Contacts contacts = find_contacts(meshes_, boxes, axes);
    make_alike(contacts, meshes_, boxes, axes, symmetries_);
    drop_covered(contacts, boxes);
    CorrectedContacts corrected = correct_contacts(contacts, meshes_, boxes, axes, symmetries_, declared_);
    return {std::move(contacts), std::move(corrected)};
  }

  /// Between real parts first; a virtual part then inherits the regions of its instances.
  void add_attachments() {
    const auto at = [](PartIndex a, PartIndex b) { return std::pair(std::min(a, b), std::max(a, b)); };
    auto [regions, corrected] = real_contacts();
    const auto nodes = [&](PartIndex p) {
      std::vector<PartIndex> out = {p};
      if (const auto parent = parent_of(p)) out.push_back(*parent);
      return out;
    };
    Contacts inherited;
    std::set<PartPair> firm;
    for (const auto& [pair, region] : regions) {
      const bool is_loose = corrected.loose.count(pair) > 0, is_gaping = corrected.gaping.count(pair) > 0;
      for (const PartIndex a : nodes(pair.first)) {
        for (const PartIndex b : nodes(pair.second)) {
          const bool own = a == pair.first && b == pair.second;
          // Instances of one group need no attachment to their own parent: the group relation ties them.
          if (own || a == b || parent_of(pair.first) == parent_of(pair.second)) continue;
          inherited[at(a, b)].add(region);
          (is_loose ? corrected.loose : firm).insert(at(a, b));
          if (is_gaping) corrected.gaping.insert(at(a, b));
        }
      }
    }
    regions.merge(inherited);
    PartData<Hexahedron> boxes;
    for (const PartIndex p : meshes_.indices()) boxes.push_back(shape_.parts[p].hexahedron);
    ContactPointFinder contact_points(meshes_, boxes);
    for (const auto& [pair, region] : regions) {
      const auto [a, b] = pair;
      const Hexahedron &ha = shape_.parts[a].hexahedron, &hb = shape_.parts[b].hexahedron;
      // A group's box is mostly empty: what stands inside it is not contained in it.
      const bool a_in_b = contains(hb, ha) && !shape_.parts[b].is_virtual();
      const bool b_in_a = contains(ha, hb) && !shape_.parts[a].is_virtual();
      if (region.empty() && !a_in_b && !b_in_a) continue;
      FoundAttachment found = attach(ha, hb, region, a_in_b, b_in_a);
      if (corrected.gaping.count(pair) > 0) found.attachment.patch.reset();
      if (corrected.loose.count(pair) > 0 && firm.count(pair) == 0) found = loosened(found, ha, hb);
      if (a.value() < meshes_.size() && b.value() < meshes_.size())
        found.attachment.contact_points = contact_points(a, b);
      add('a', attachment_kind(found.order), {a, b}, std::move(found.attachment));
    }
  }

  /// Of every real part that stands on the floor, and of the groups that have one.
  void add_ground() {
    const PartData<Footprint> prints = footprints(meshes_);
    for (const PartIndex p : shape_.parts.indices()) {
      std::vector<Footprint> own;
      for (const PartIndex member : shape_.parts[p].members) own.push_back(prints[member]);
      if (!shape_.parts[p].is_virtual()) own.push_back(prints[p]);
      if (std::all_of(own.begin(), own.end(), [](const Footprint& print) { return print.empty(); })) continue;
      add('g', RelationKind::ground, {p}, ground_contact(shape_.parts[p].hexahedron, own));
    }
  }

  std::optional<PartIndex> parent_of(PartIndex p) const {
    const auto found = parent_of_.find(p);
    return found == parent_of_.end() ? std::nullopt : std::optional(found->second);
  }

  Shape& shape_;
  const PartData<PartMesh>& meshes_;
  Symmetries symmetries_;
  const std::vector<Declared>& declared_;
  std::vector<PartIndex> parents_;  ///< one a group
  std::map<PartIndex, PartIndex> parent_of_;
  std::vector<MirrorPair> parent_mirrors_;
  std::map<char, int> count_;
};

Status relabel(PartData<PartMesh>& meshes, const Labels& labels) {
  std::set<std::string, std::less<>> unused;
  for (const auto& [key, label] : labels) unused.insert(key);
  for (PartMesh& mesh : meshes) {
    const std::string node = "node:" + std::to_string(mesh.node);
    for (const std::string& key : {node, node + "/" + std::to_string(mesh.primitive)}) {
      const auto found = labels.find(key);
      if (found == labels.end()) continue;
      mesh.name = found->second;
      mesh.label = clean_label(mesh.name);
      unused.erase(key);
    }
  }
  if (unused.empty()) return success();
  return Error{"shape/label", printable(*unused.begin()), "a label is given for a part that the file does not have",
               "name parts as node:<index> or node:<index>/<primitive>"};
}

/// Declared mirror images that did not fit what else ties their boxes, so that they are none.
void add_lost_mirrors(const Shape& shape, const std::vector<Declared>& declared, std::vector<Undone>& undone) {
  for (const auto& [kind, pair] : declared) {
    const bool is_told =
        std::any_of(undone.begin(), undone.end(), [&, pair = pair](const Undone& other) { return other.pair == pair; });
    if (kind != CorrectionKind::mirrored || is_told) continue;
    const auto is_it = [&, pair = pair](const Relation& relation) {
      return relation.kind == RelationKind::reflection &&
             PartPair(std::minmax(relation.parts[0], relation.parts[1])) == pair;
    };
    if (std::none_of(shape.relations.begin(), shape.relations.end(), is_it))
      undone.push_back({pair, "they do not agree with what else they mirror or stand in a row with"});
  }
}

}  // namespace

std::vector<std::string> external_buffer_uris(std::string_view bytes) {
  return gltf::external_uris(bytes);
}

Result<Abstraction> abstract_shape(std::string_view bytes, std::string_view name, const ExternalBuffers& buffers,
                                   const Labels& labels, const Corrections& corrections) {
  Result<ImportedModel> imported = import_gltf(bytes, buffers);
  if (!imported.ok()) return imported.error();
  Abstraction result;
  result.shape.name = printable(name, 128);
  result.shape.sha256 = sha256_hex(bytes);
  result.shape.frame = imported->frame;
  result.shape.warnings = std::move(imported->warnings);
  result.meshes = std::move(imported->meshes);
  if (Status status = relabel(result.meshes, labels); !status.ok()) return status.error();
  const Result<std::vector<Declared>> given = declared(corrections, result.meshes);
  if (!given.ok()) return given.error();

  turn_into(own_axes(result.meshes), result.meshes, result.shape.frame);

  PartData<Hexahedron> boxes;
  PartData<std::string> keys;
  for (const PartMesh& mesh : result.meshes) {
    boxes.push_back(oriented_box(mesh));
    keys.push_back(grouping_key(mesh.label));
  }
  Symmetries symmetries = find_symmetries(result.meshes, boxes, keys);
  std::vector<Undone> undone = correct_mirrors(symmetries, boxes, *given);
  const PartData<Hexahedron> aligned = align_boxes(boxes, symmetries);
  Builder(result.shape, result.meshes, std::move(symmetries), *given).run(aligned);
  add_lost_mirrors(result.shape, *given, undone);
  for (const auto& [pair, why] : undone) {
    const auto& parts = result.shape.parts;
    result.shape.warnings.push_back({parts[pair.first].name + " and " + parts[pair.second].name, why});
  }
  return result;
}

}  // namespace parsel
