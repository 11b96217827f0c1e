#include "core/split/write.h"

#include <algorithm>
#include <cstring>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <utility>

#include "core/base/text.h"
#include "core/gltf/accessor.h"

namespace parsel::split {
namespace {

using nlohmann::json;

constexpr std::uint32_t unnumbered = std::numeric_limits<std::uint32_t>::max();
constexpr std::size_t array_buffer = 34962, element_array_buffer = 34963;

/// Calls `see` with every whole number in `value`, however deep.
template <class See>
void numbers_in(const json& value, const See& see) {
  if (value.is_number_unsigned()) see(value.get<std::size_t>());
  if (value.is_structured()) {
    for (const json& inner : value) numbers_in(inner, see);
  }
}

/// The same for what stands under a key, if anything does.
template <class See>
void numbers_under(const json& value, const char* key, const See& see) {
  if (value.is_object() && value.contains(key)) numbers_in(value[key], see);
}

/// Calls `see` with every entry of a top-level array.
template <class See>
void each(const json& file, const char* key, const See& see) {
  if (!file.contains(key)) return;
  for (const json& entry : file[key]) see(entry);
}

template <class T>
double loaded(const char* bytes) {
  T value;
  std::memcpy(&value, bytes, sizeof value);
  return static_cast<double>(value);
}

/// Component `c` of the element at `bytes`, as it is stored.
double stored(const char* bytes, std::size_t c, std::size_t type) {
  switch (type) {
    case gltf::type_byte:
      return loaded<std::int8_t>(bytes + c);
    case gltf::type_unsigned_byte:
      return loaded<std::uint8_t>(bytes + c);
    case gltf::type_short:
      return loaded<std::int16_t>(bytes + 2 * c);
    case gltf::type_unsigned_short:
      return loaded<std::uint16_t>(bytes + 2 * c);
    case gltf::type_unsigned_int:
      return loaded<std::uint32_t>(bytes + 4 * c);
    default:
      return loaded<float>(bytes + 4 * c);
  }
}

class Writer {
 public:
  explicit Writer(gltf::File& file)
      : file_(file),
        document_(file.original),
        json_(document_.json),
        originals_(json_.value("accessors", json::array())) {}

  Status run(const std::vector<NewNodes>& meshes) {
    free_what_goes(meshes);
    for (const NewNodes& mesh : meshes) {
      if (Status s = add_mesh(mesh); !s.ok()) return s;
    }
    empty_what_is_left();
    place_bytes();
    for (const char* key : {"nodes", "meshes", "accessors", "bufferViews"}) {
      if (json_.contains(key)) file_.json.set(key, gltf::JsonText(nlohmann::ordered_json(json_[key])));
    }
    return success();
  }

 private:
  /// Accessors that only the meshes read that go, and buffer views that only these accessors read.
  void free_what_goes(const std::vector<NewNodes>& meshes) {
    std::set<std::size_t> going, stay;
    for (const NewNodes& mesh : meshes) going.insert(mesh.mesh);
    std::set<std::size_t>&accessors = free_accessors_, &views = free_views_;
    const auto keep_accessor = [&](std::size_t a) { stay.insert(a); };
    for (std::size_t m = 0; m < json_["meshes"].size(); ++m) {
      for (const json& primitive : json_["meshes"][m]["primitives"]) {
        for (const char* key : {"attributes", "indices"}) {
          numbers_under(primitive, key, [&](std::size_t a) { (going.count(m) ? accessors : stay).insert(a); });
        }
        for (const char* key : {"targets", "extensions"}) numbers_under(primitive, key, keep_accessor);
      }
    }
    each(json_, "nodes", [&](const json& node) { numbers_under(node, "extensions", keep_accessor); });
    each(json_, "skins", [&](const json& skin) { numbers_under(skin, "inverseBindMatrices", keep_accessor); });
    each(json_, "animations", [&](const json& animation) { numbers_under(animation, "samplers", keep_accessor); });
    numbers_under(json_, "extensions", keep_accessor);
    for (const std::size_t a : stay) accessors.erase(a);

    std::set<std::size_t> read;
    const auto keep_view = [&](std::size_t v) { read.insert(v); };
    for (std::size_t a = 0; a < json_["accessors"].size(); ++a) {
      const json& accessor = json_["accessors"][a];
      if (accessors.count(a)) {
        numbers_under(accessor, "bufferView", [&](std::size_t v) { views.insert(v); });
      } else {
        for (const char* key : {"bufferView", "sparse", "extensions"}) numbers_under(accessor, key, keep_view);
      }
    }
    each(json_, "images", [&](const json& image) {
      for (const char* key : {"bufferView", "extensions"}) numbers_under(image, key, keep_view);
    });
    for (const json& mesh : json_["meshes"]) {
      for (const json& primitive : mesh["primitives"]) numbers_under(primitive, "extensions", keep_view);
    }
    numbers_under(json_, "extensions", keep_view);
    for (const std::size_t v : read) views.erase(v);
  }

  Status add_mesh(const NewNodes& mesh) {
    const json before = json_["meshes"][mesh.mesh];
    std::vector<std::size_t> made;
    for (std::size_t i = 0; i < mesh.nodes.size(); ++i) {
      json after = before;
      after["name"] = mesh.nodes[i].name;
      after["primitives"] = json::array();
      json primitive = before["primitives"][mesh.nodes[i].triangles.front()[0].primitive];
      primitive.erase("mode");
      if (Status status = add_primitive(primitive, before["primitives"], mesh.nodes[i]); !status.ok()) return status;
      after["primitives"].push_back(std::move(primitive));
      if (i == 0) {
        json_["meshes"][mesh.mesh] = std::move(after);
        made.push_back(mesh.mesh);
      } else {
        json_["meshes"].push_back(std::move(after));
        made.push_back(json_["meshes"].size() - 1);
      }
    }
    const std::size_t nodes = document_.nodes.size();
    for (std::size_t n = 0; n < nodes; ++n) {
      if (document_.nodes[n].mesh != mesh.mesh) continue;
      json children = json_["nodes"][n].value("children", json::array());
      for (std::size_t i = 0; i < made.size(); ++i) {
        json child = {{"name", mesh.nodes[i].name}, {"mesh", made[i]}};
        children.push_back(json_["nodes"].size());
        json_["nodes"].push_back(std::move(child));
      }
      json_["nodes"][n]["children"] = std::move(children);
      json_["nodes"][n].erase("mesh");
    }
    return success();
  }

  Status add_primitive(json& primitive, const json& sources, const NewNode& node) {
    const std::vector<VertexOf> used = number_vertices(node);
    const json attributes = primitive["attributes"];
    for (const auto& entry : attributes.items()) {
      const std::string& name = entry.key();
      const auto added = add_attribute(sources, name, used);
      if (!added.ok()) return added.error();
      primitive["attributes"][name] = *added;
    }
    const bool is_short = used.size() < 65535;
    std::string bytes;
    bytes.reserve(3 * node.triangles.size() * (is_short ? 2 : 4));
    for (const auto& t : node.triangles) {
      for (const VertexOf& v : t) {
        const std::uint32_t index = numbers_[v.primitive][v.vertex];
        bytes.append(reinterpret_cast<const char*>(&index), is_short ? 2 : 4);  // little-endian: see accessor.cpp
      }
    }
    for (const VertexOf& v : used) numbers_[v.primitive][v.vertex] = unnumbered;
    primitive["indices"] = put({{"componentType", is_short ? gltf::type_unsigned_short : gltf::type_unsigned_int},
                                {"count", 3 * node.triangles.size()},
                                {"type", "SCALAR"}},
                               std::move(bytes), 0, element_array_buffer);
    return success();
  }

  /// The vertices of a node, ascending, and in numbers_ where each of them stands among these.
  std::vector<VertexOf> number_vertices(const NewNode& node) {
    std::vector<VertexOf> used;
    for (const auto& t : node.triangles) {
      for (const VertexOf& v : t) {
        if (numbers_.size() <= v.primitive) numbers_.resize(v.primitive + 1);
        std::vector<std::uint32_t>& own = numbers_[v.primitive];
        if (own.size() <= v.vertex) own.resize(v.vertex + 1, unnumbered);
        if (own[v.vertex] != unnumbered) continue;
        own[v.vertex] = 0;
        used.push_back(v);
      }
    }
    std::sort(used.begin(), used.end());
    for (std::uint32_t i = 0; i < used.size(); ++i) numbers_[used[i].primitive][used[i].vertex] = i;
    return used;
  }

  /// The elements of `used`, byte for byte, as an accessor of its own.
  Result<std::size_t> add_attribute(const json& sources, const std::string& name, const std::vector<VertexOf>& used) {
    std::map<std::uint32_t, gltf::Layout> places;
    for (const VertexOf& v : used) {
      if (places.count(v.primitive)) continue;
      const auto where = gltf::layout(document_, sources[v.primitive]["attributes"][name].get<std::size_t>());
      if (!where.ok()) return where.error();
      places.emplace(v.primitive, *where);
    }
    const gltf::Layout& kind = places.begin()->second;  // all are alike
    const std::size_t stride = (kind.element + 3) / 4 * 4;
    std::string bytes(stride * used.size(), '\0');
    const gltf::Layout* where = nullptr;
    for (std::size_t i = 0; i < used.size(); ++i) {
      if (i == 0 || used[i].primitive != used[i - 1].primitive) where = &places.at(used[i].primitive);
      if (!where->view) continue;  // zeros
      const char* from = document_.buffers[where->buffer].bytes.data() + where->begin + used[i].vertex * where->stride;
      std::memcpy(bytes.data() + i * stride, from, where->element);
    }
    json entry = originals_.at(sources[used.front().primitive]["attributes"][name].get<std::size_t>());
    for (const char* key : {"bufferView", "byteOffset", "min", "max"}) entry.erase(key);
    entry["count"] = used.size();
    if (name == "POSITION") add_bounds(entry, kind, bytes, stride);
    return put(std::move(entry), std::move(bytes), stride, array_buffer);
  }

  /// Least and greatest of each component, as they are stored (glTF 2.0 §3.6.2.5).
  static void add_bounds(json& entry, const gltf::Layout& where, const std::string& bytes, std::size_t stride) {
    json low = json::array(), high = json::array();
    for (std::size_t c = 0; c < where.components; ++c) {
      double least = std::numeric_limits<double>::infinity(), most = -least;
      for (std::size_t at = 0; at + where.element <= bytes.size(); at += stride) {
        const double value = stored(bytes.data() + at, c, where.component_type);
        least = std::min(least, value);
        most = std::max(most, value);
      }
      low.push_back(least);
      high.push_back(most);
    }
    entry["min"] = std::move(low);
    entry["max"] = std::move(high);
  }

  std::size_t put(json accessor, std::string bytes, std::size_t stride, std::size_t target) {
    json view = {{"buffer", 0}, {"byteOffset", 0}, {"byteLength", bytes.size()}, {"target", target}};
    if (stride > 0) view["byteStride"] = stride;
    const std::size_t at = put_into("bufferViews", free_views_, std::move(view));
    new_bytes_[at] = std::move(bytes);
    accessor["bufferView"] = at;
    return put_into("accessors", free_accessors_, std::move(accessor));
  }

  /// In place of an entry that nothing names any more, else behind all others.
  std::size_t put_into(const char* array, std::set<std::size_t>& free, json entry) {
    json& all = json_[array];
    if (free.empty()) {
      all.push_back(std::move(entry));
      return all.size() - 1;
    }
    const std::size_t at = *free.begin();
    free.erase(free.begin());
    all[at] = std::move(entry);
    return at;
  }

  /// Where primitives were joined, fewer accessors are made than were freed: those left keep their numbers, of nothing.
  void empty_what_is_left() {
    for (const std::size_t a : free_accessors_) {
      json& accessor = json_["accessors"][a];
      for (const char* key : {"bufferView", "byteOffset", "sparse", "min", "max"}) accessor.erase(key);
      accessor["count"] = 1;
    }
  }

  /// Whether the bytes of buffer 0 can be put in order anew: they are at hand, and views alone say where they lie.
  bool can_rebuild() const {
    if (file_.home != 0) return false;
    std::size_t bytes = 0;
    for (const gltf::BufferView& view : document_.views) {
      if (view.extended) return false;
      bytes += view.length;
    }
    return bytes <= 2 * file_.binary.size();  // views that overlap would be written again and again
  }

  void place_bytes() {
    const bool rebuild = can_rebuild();
    const std::string before = rebuild ? std::exchange(file_.binary, {}) : "";
    for (std::size_t v = 0; v < json_["bufferViews"].size(); ++v) {
      json& view = json_["bufferViews"][v];
      const auto made = new_bytes_.find(v);
      if (made != new_bytes_.end()) {
        view["buffer"] = file_.home;
        view["byteOffset"] = file_.append_bytes(made->second);
        made->second = {};
      } else if (rebuild && document_.views[v].buffer == 0) {
        if (free_views_.count(v)) view["byteLength"] = std::min<std::size_t>(document_.views[v].length, 4);
        view["byteOffset"] = file_.append_bytes(
            std::string_view(before).substr(document_.views[v].offset, view["byteLength"].get<std::size_t>()));
      }
    }
  }

  gltf::File& file_;
  const gltf::Document& document_;
  json json_;             ///< as it becomes
  const json originals_;  ///< the accessors as they came
  std::set<std::size_t> free_accessors_, free_views_;
  std::map<std::size_t, std::string> new_bytes_;  ///< by buffer view
  /// By primitive and vertex, of the node that is written: its number there. Between nodes, unnumbered.
  std::vector<std::vector<std::uint32_t>> numbers_;
};

}  // namespace

bool alike(const gltf::Document& document, std::size_t mesh, std::size_t a, std::size_t b) {
  json p = document.json["meshes"][mesh]["primitives"][a], q = document.json["meshes"][mesh]["primitives"][b];
  const json of_a = p["attributes"], of_b = q["attributes"];
  for (json* primitive : {&p, &q}) {
    for (const char* key : {"attributes", "indices", "mode"}) primitive->erase(key);
  }
  if (p != q || of_a.size() != of_b.size()) return false;
  for (const auto& entry : of_a.items()) {
    const std::string& name = entry.key();
    if (!of_b.contains(name)) return false;
    const auto kind = gltf::layout(document, entry.value().get<std::size_t>());
    const auto other = gltf::layout(document, of_b[name].get<std::size_t>());
    if (!kind.ok() || !other.ok() || kind->components != other->components || kind->normalized != other->normalized ||
        kind->component_type != other->component_type) {
      return false;
    }
  }
  return true;
}

std::string why_whole(const gltf::Document& document, const gltf::Primitive& primitive) {
  if (!primitive.targets.empty()) return "it has morph targets";
  if (primitive.has_draco) return "it has a compressed copy";
  for (const auto& [name, accessor] : primitive.attributes) {
    const auto where = gltf::layout(document, accessor);
    if (!where.ok()) return "its " + printable(name) + " cannot be read";
    if (document.accessors[accessor].sparse) return "its " + printable(name) + " is sparse";
    if (!gltf::out_of_reach(document, accessor).empty()) return "its " + printable(name) + " is out of reach";
    if (where->count != gltf::accessor_count(document, primitive.attributes.at("POSITION"))) {
      return "its " + printable(name) + " has another count than its POSITION";
    }
  }
  return "";
}

Status write_pieces(gltf::File& file, const std::vector<NewNodes>& meshes) {
  return Writer(file).run(meshes);
}

}  // namespace parsel::split
