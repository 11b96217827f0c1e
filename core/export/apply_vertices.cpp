#include "core/export/apply_vertices.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <iterator>
#include <limits>
#include <nlohmann/json.hpp>
#include <set>

#include "core/export/apply_accessor.h"
#include "core/export/apply_change.h"
#include "core/export/apply_extension.h"
#include "core/gltf/primitive.h"
#include "core/gltf/sections.h"

namespace parsel::apply {
namespace {

using gltf::File;
using gltf::JsonText;
using nlohmann::ordered_json;

constexpr double largest_float = std::numeric_limits<float>::max();

std::string place_of(const PrimitiveKey& key) {
  return "mesh " + std::to_string(key.first) + ", primitive " + std::to_string(key.second);
}

/// One place in the file that names an accessor: `attribute` of a primitive, or of its morph target `target`.
struct Use {
  Change change;
  PrimitiveKey primitive;
  std::optional<std::size_t> target;
  std::string attribute;
  std::optional<std::size_t> indices;  ///< accessor that selects the vertices; all of them without
};

class Writer {
 public:
  Writer(File& file, const MeshEdits& edits, std::vector<Warning>& warnings)
      : file_(file), edits_(edits), warnings_(warnings), storage_(file.original), source_(file.original) {}

  Status run() {
    find_lost();
    if (Status s = collect_uses(); !s.ok()) return s;
    if (Status s = prepare_targets(); !s.ok()) return s;
    for (const auto& [accessor, uses] : uses_) {
      bool any = false;
      for (const Use& use : uses) any = any || use.change.role != Role::untouched;
      if (!any) continue;
      if (Status s = rewrite(accessor, uses); !s.ok()) return s;
    }
    return append_targets();
  }

 private:
  const CageMap* map_of(const PrimitiveKey& key) const {
    const auto found = edits_.maps.find(key);
    return found == edits_.maps.end() ? nullptr : &found->second;
  }

  /// What cannot follow stays, and a compressed copy of what changes goes.
  void find_lost() {
    std::set<PrimitiveKey> keys;
    for (const auto& [key, map] : edits_.maps) keys.insert(key);
    for (const auto& [mesh, count] : edits_.new_targets) {
      for (std::size_t p = 0; p < file_.item("meshes", mesh).get("primitives").size(); ++p) keys.insert({mesh, p});
    }
    for (const PrimitiveKey& key : keys) {
      const auto now = gltf::read_primitive(nlohmann::json::parse(primitive(key).text()), place_of(key));
      PARSEL_ASSERT(now.ok(), "it was read before");
      for (const gltf::LostAttribute& lost : gltf::lost_attributes(file_.original, *now)) {
        lost_[key].insert(lost.key);
        warnings_.push_back({place_of(key), lost.why});
      }
      if (!now->has_draco) continue;
      gltf::erase_extension(*find_primitive(key), gltf::draco);
      gltf::forget_unused_extension(file_, gltf::draco);
    }
  }

  bool is_lost(const PrimitiveKey& key, const std::optional<std::size_t>& target, const std::string& name) const {
    const auto found = lost_.find(key);
    return found != lost_.end() && found->second.count({target, name}) > 0;
  }

  const JsonText& primitive(const PrimitiveKey& key) const {
    return file_.item("meshes", key.first).get("primitives").item(key.second);
  }

  Status add(std::size_t accessor, Use use) {
    if (use.change.role != Role::untouched) {
      const auto& change = use.change;
      const std::initializer_list<std::optional<std::size_t>> all = {accessor, change.position, change.base,
                                                                     change.target_position};
      for (const auto& other : all) {
        if (!other) continue;
        if (Status s = source_.load(*other); !s.ok()) return s;
      }
      for (const auto& other : all) {
        PARSEL_ASSERT(!other || source_.count(*other) == source_.count(accessor), "others are lost attributes");
      }
    }
    uses_[accessor].push_back(std::move(use));
    return success();
  }

  /// The attributes of a primitive (`target` none) or of one of its morph targets.
  Status collect_attributes(const PrimitiveKey& key, std::optional<std::size_t> target) {
    const JsonText& json = primitive(key);
    const JsonText& base = json.get("attributes");
    const JsonText& attributes = target ? json.get("targets").item(*target) : base;
    const CageMap* map = map_of(key);
    const bool moves = map != nullptr && map->moves;
    for (std::size_t i = 0; i < attributes.size(); ++i) {
      const std::string name = attributes.key(i);
      const auto accessor = attributes.value(i).index();
      if (!accessor) continue;
      Use use{{}, key, target, name, json.get("indices").index()};
      use.change = {Role::untouched, map, base.get("POSITION").index(), std::nullopt, std::nullopt};
      if (moves && is_lost(key, target, name)) {
        use.change.role = Role::untouched;
      } else if (moves && !target) {
        if (name == "POSITION") use.change.role = Role::position;
        if (name == "NORMAL") use.change.role = Role::normal;
        if (name == "TANGENT") use.change.role = Role::tangent;
      } else if (moves && (name == "POSITION" || base.get(name).index())) {
        if (!is_lost(key, target, "POSITION")) use.change.target_position = attributes.get("POSITION").index();
        if (name == "POSITION") use.change.role = Role::target_position;
        if (name == "NORMAL") use.change.role = Role::target_normal;
        if (name == "TANGENT") use.change.role = Role::target_tangent;
        if (name != "POSITION") use.change.base = base.get(name).index();
      }
      if (Status s = add(*accessor, std::move(use)); !s.ok()) return s;
    }
    return success();
  }

  Status collect_uses() {
    for (std::size_t m = 0; m < file_.size("meshes"); ++m) {
      const JsonText& primitives = file_.item("meshes", m).get("primitives");
      for (std::size_t p = 0; p < primitives.size(); ++p) {
        const PrimitiveKey key{m, p};
        if (Status s = collect_attributes(key, std::nullopt); !s.ok()) return s;
        for (std::size_t t = 0; t < primitive(key).get("targets").size(); ++t) {
          if (Status s = collect_attributes(key, t); !s.ok()) return s;
        }
      }
    }
    // Whoever else names an accessor needs it as it is.
    const auto foreign = [&](const JsonText& json) {
      if (const auto accessor = json.index()) uses_[*accessor].push_back(Use{});
    };
    for (std::size_t i = 0; i < file_.size("animations"); ++i) {
      const JsonText& samplers = file_.item("animations", i).get("samplers");
      for (std::size_t s = 0; s < samplers.size(); ++s) {
        foreign(samplers.item(s).get("input"));
        foreign(samplers.item(s).get("output"));
      }
    }
    for (std::size_t i = 0; i < file_.size("skins"); ++i) foreign(file_.item("skins", i).get("inverseBindMatrices"));
    for (std::size_t i = 0; i < file_.size("nodes"); ++i) {
      const JsonText& instancing = file_.item("nodes", i).get("extensions").get("EXT_mesh_gpu_instancing");
      const JsonText& attributes = instancing.get("attributes");
      for (std::size_t a = 0; a < attributes.size(); ++a) foreign(attributes.value(a));
    }
    return success();
  }

  /// Reads what new morph targets need, before anything is rewritten.
  Status prepare_targets() {
    for (const auto& [mesh, count] : edits_.new_targets) {
      for (std::size_t p = 0; p < file_.item("meshes", mesh).get("primitives").size(); ++p) {
        const JsonText& attributes = primitive({mesh, p}).get("attributes");
        Originals originals{attributes.get("POSITION").index().value(), std::nullopt, std::nullopt};
        if (!is_lost({mesh, p}, std::nullopt, "NORMAL")) originals.normal = attributes.get("NORMAL").index();
        if (!is_lost({mesh, p}, std::nullopt, "TANGENT")) originals.tangent = attributes.get("TANGENT").index();
        for (const auto& accessor : {std::optional(originals.position), originals.normal, originals.tangent}) {
          if (!accessor) continue;
          if (Status s = source_.load(*accessor); !s.ok()) return s;
        }
        originals_.emplace(PrimitiveKey{mesh, p}, originals);
      }
    }
    return success();
  }

  /// The vertices that a use needs; null means all, as for indices that cannot be read (of a mesh that nobody sees).
  const std::vector<std::uint32_t>* vertices(const Use& use, std::size_t count) {
    if (!use.indices) return nullptr;
    auto found = indices_.find(*use.indices);
    if (found == indices_.end()) {
      auto read = gltf::read_indices(file_.original, *use.indices);
      found = indices_.emplace(*use.indices, read.ok() ? std::optional(std::move(read).value()) : std::nullopt).first;
    }
    if (!found->second) return nullptr;
    const auto out_of_range = [&](std::uint32_t i) { return i >= count; };
    return std::any_of(found->second->begin(), found->second->end(), out_of_range) ? nullptr : &*found->second;
  }

  /// A version of an accessor: for every vertex which change (index into `changes`, 0 is untouched) it gets.
  struct Copy {
    std::vector<std::uint32_t> change;  ///< per vertex; UINT32_MAX while nobody needs it
    std::vector<const Use*> uses;
  };
  static constexpr std::uint32_t unclaimed = UINT32_MAX;

  static bool claim(Copy& copy, const std::vector<std::uint32_t>* vertices, std::uint32_t change) {
    const auto fits = [&](std::size_t i) { return copy.change[i] == unclaimed || copy.change[i] == change; };
    const std::size_t count = copy.change.size();
    if (vertices == nullptr) {
      for (std::size_t i = 0; i < count; ++i) {
        if (!fits(i)) return false;
      }
      copy.change.assign(count, change);
      return true;
    }
    for (const std::uint32_t i : *vertices) {
      if (!fits(i)) return false;
    }
    for (const std::uint32_t i : *vertices) copy.change[i] = change;
    return true;
  }

  Status rewrite(std::size_t accessor, const std::vector<Use>& uses) {
    const std::size_t count = source_.count(accessor);
    std::vector<Change> changes{Change{}};
    std::vector<std::uint32_t> change_of(uses.size());
    for (std::size_t u = 0; u < uses.size(); ++u) {
      std::uint32_t c = 0;
      while (c < changes.size() && !changes[c].agrees(uses[u].change)) ++c;
      if (c == changes.size()) changes.push_back(uses[u].change);
      change_of[u] = c;
    }
    std::vector<Copy> copies;
    if (changes.size() == 2 && std::count(change_of.begin(), change_of.end(), 1U) == std::ssize(change_of)) {
      copies.push_back({std::vector<std::uint32_t>(count, 1), {}});  // all agree: no need to look at indices
    } else {
      // The untouched come first, so that they keep the accessor they have.
      for (const bool touched : {false, true}) {
        for (std::size_t u = 0; u < uses.size(); ++u) {
          if ((change_of[u] != 0) != touched) continue;
          const std::vector<std::uint32_t>* needed = vertices(uses[u], count);
          std::size_t c = 0;
          while (c < copies.size() && !claim(copies[c], needed, change_of[u])) ++c;
          if (c == copies.size()) {
            copies.push_back({std::vector<std::uint32_t>(count, unclaimed), {}});
            claim(copies[c], needed, change_of[u]);
          }
          copies[c].uses.push_back(&uses[u]);
        }
      }
    }
    for (std::size_t c = 0; c < copies.size(); ++c) {
      if (Status s = write_copy(accessor, copies[c], changes, c == 0); !s.ok()) return s;
    }
    return success();
  }

  Status write_copy(std::size_t accessor, const Copy& copy, const std::vector<Change>& changes, bool original) {
    const std::size_t n = source_.components(accessor), count = copy.change.size();
    std::vector<float> values(count * n);
    bool any = false, positions = false;
    for (std::size_t i = 0; i < count; ++i) {
      const bool touched = copy.change[i] != unclaimed && copy.change[i] != 0;
      const Change& change = changes[touched ? copy.change[i] : 0];
      any = any || touched;
      positions = positions || change.role == Role::position || change.role == Role::target_position;
      const Vec4 value = changed(source_, change, accessor, i);
      // The corners of all cages fit floats (plan_nodes), so only a vertex far outside, which no triangle shows, can be
      // beyond them; it stays.
      const bool fits = !touched || value.head(static_cast<Eigen::Index>(n)).cwiseAbs().maxCoeff() <= largest_float;
      const Vec4 kept = fits ? value : source_.element(accessor, i);
      for (std::size_t c = 0; c < n; ++c) {
        values[i * n + c] = static_cast<float>(kept[static_cast<Eigen::Index>(c)]);
      }
    }
    if (!any) return success();
    const gltf::NewData data{values, n, positions, true};
    if (!original) {
      const std::size_t index = gltf::append_accessor(file_, data, accessor);
      for (const Use* use : copy.uses) point_at(*use, index);
    } else if (storage_.can_patch_in_place(accessor)) {
      const auto where = gltf::layout(file_.original, accessor);
      for (std::size_t i = 0; i < count; ++i) {
        if (copy.change[i] != unclaimed && copy.change[i] != 0) gltf::patch_element(file_, *where, i, &values[i * n]);
      }
      JsonText& json = *file_.find_item("accessors", accessor);
      if (positions || json.has("min") || json.has("max")) gltf::set_bounds(json, values, n);
    } else {
      gltf::replace_data(file_, storage_, accessor, data);
    }
    return success();
  }

  void point_at(const Use& use, std::size_t accessor) {
    JsonText* json = find_primitive(use.primitive);
    json = use.target ? json->find("targets")->find_item(*use.target) : json->find("attributes");
    json->set(use.attribute, JsonText(accessor));
  }

  JsonText* find_primitive(const PrimitiveKey& key) {
    return file_.find_item("meshes", key.first)->find("primitives")->find_item(key.second);
  }

  struct Originals {
    std::size_t position;
    std::optional<std::size_t> normal, tangent;
  };

  Status append_targets() {
    for (const auto& [mesh, count] : edits_.new_targets) {
      for (std::size_t p = 0; p < file_.item("meshes", mesh).get("primitives").size(); ++p) {
        const PrimitiveKey key{mesh, p};
        JsonText targets = primitive(key).get("targets");  // those that it has stay in front
        if (!targets.is_array()) targets = JsonText(ordered_json::array());
        for (std::size_t t = 0; t < count; ++t) {
          auto target = new_target(originals_.at(key), map_of(key), t);
          if (!target) return target.error();
          targets.push_back(std::move(target).value());
        }
        find_primitive(key)->set("targets", std::move(targets));
      }
    }
    return success();
  }

  /// Displacements of positions, and of normals and tangents as they are at weight 1. Without a map: zeros.
  Result<JsonText> new_target(const Originals& from, const CageMap* map, std::size_t t) {
    const std::size_t count = source_.count(from.position);
    const Corners before = map == nullptr ? Corners(Corners::Zero()) : map->corners;
    // A part that stands still beside others of its mesh has no displacements of its own.
    const bool moves = map != nullptr && t < map->targets.size();
    const Corners step = moves ? map->targets[t] : Corners(Corners::Zero());
    const Corners after = before + step;
    ordered_json target;
    for (const char* name : {"POSITION", "NORMAL", "TANGENT"}) {
      const bool is_position = std::strcmp(name, "POSITION") == 0, is_normal = std::strcmp(name, "NORMAL") == 0;
      const auto accessor = is_position ? std::optional(from.position) : is_normal ? from.normal : from.tangent;
      if (!accessor || (!is_position && !moves)) continue;
      std::vector<float> values;
      values.reserve(count * 3);
      for (std::size_t i = 0; i < count; ++i) {
        Vec3 delta = Vec3::Zero();
        const Vec3 p = source_.element(from.position, i).head<3>(), v = source_.element(*accessor, i).head<3>();
        if (moves && is_position) {
          delta = map->point(p, step);
        } else if (moves) {
          const Mat3 j0 = map->jacobian(p, before), j1 = map->jacobian(p, after);
          delta = is_normal ? Vec3(transform_normal(j1, v) - transform_normal(j0, v))
                            : Vec3(transform_tangent(j1, v) - transform_tangent(j0, v));
        }
        for (int c = 0; c < 3; ++c) values.push_back(static_cast<float>(delta[c]));
        if (!delta.allFinite()) values[values.size() - 1] = values[values.size() - 2] = values[values.size() - 3] = 0;
      }
      target[name] = gltf::append_accessor(file_, {values, 3, is_position, true});
    }
    return JsonText(target);
  }

  File& file_;
  const MeshEdits& edits_;
  std::vector<Warning>& warnings_;
  const gltf::Storage storage_;
  Source source_;
  std::map<std::size_t, std::vector<Use>> uses_;                              ///< of every accessor
  std::map<std::size_t, std::optional<std::vector<std::uint32_t>>> indices_;  ///< none: cannot be read
  std::map<PrimitiveKey, Originals> originals_;
  std::map<PrimitiveKey, std::set<gltf::AttributeKey>> lost_;
};

}  // namespace

Status write_vertices(File& file, const MeshEdits& edits, std::vector<Warning>& warnings) {
  if (edits.maps.empty()) return success();
  return Writer(file, edits, warnings).run();
}

}  // namespace parsel::apply
