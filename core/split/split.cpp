#include "core/split/split.h"

#include <algorithm>
#include <array>
#include <map>
#include <utility>

#include "core/export/apply_file.h"
#include "core/gltf/scene.h"
#include "core/shape/gltf_import.h"
#include "core/shape/label.h"
#include "core/split/creases.h"
#include "core/split/form.h"
#include "core/split/pieces.h"
#include "core/split/seams.h"
#include "core/split/write.h"

namespace parsel {
namespace {

using namespace split;

constexpr std::array<std::pair<SplitMethod, std::string_view>, 4> methods = {{{SplitMethod::automatic, "auto"},
                                                                              {SplitMethod::components, "components"},
                                                                              {SplitMethod::materials, "materials"},
                                                                              {SplitMethod::regions, "regions"}}};

/// Fewer parts than this, and components have told nothing apart: a fused model, maybe with a few screws.
constexpr std::size_t few_parts = 3;

Error refused(std::string cause, std::string fix) {
  return {"split/split", "", std::move(cause), std::move(fix)};
}

/// Primitives of a glTF mesh that can become one: as one mesh, as the first node shows them.
struct Group {
  PartMesh mesh;
  std::vector<VertexOf> vertices;  ///< where each vertex of `mesh` comes from
  std::vector<Piece> pieces;
  std::optional<Seams> seams;
};

struct Source {
  std::size_t mesh = 0;
  int node = -1;                            ///< the first that shows it
  std::vector<const PartMesh*> primitives;  ///< of that node, those that were read
  std::size_t nodes = 0;                    ///< that show it in the scene
  std::vector<Group> groups;

  std::size_t pieces() const {
    std::size_t count = 0;
    for (const Group& group : groups) count += group.pieces.size();
    return count;
  }
};

class Splitter {
 public:
  Splitter(gltf::File& file, const ImportedModel& model, const SplitOptions& options, const Progress& progress)
      : file_(file), model_(model), options_(options), progress_(progress) {}

  Result<SplitModel> run() {
    result_.before = result_.parts = model_.meshes.size();
    find_sources();
    result_.by = options_.by == SplitMethod::automatic ? SplitMethod::components : options_.by;
    if (Status s = take_apart(); !s.ok()) return s.error();
    if (options_.by == SplitMethod::automatic && result_.parts < few_parts) {
      result_.by = SplitMethod::regions;
      if (Status s = take_apart(); !s.ok()) return s.error();
    }
    std::vector<NewNodes> meshes;
    for (const Source& source : sources_) {
      if (source.pieces() > 1 || source.primitives.size() > 1) meshes.push_back(named(source));
    }
    report(progress_, "writing the parts", 0, 1);
    if (Status s = write_pieces(file_, meshes); !s.ok()) return s.error();
    return std::move(result_);
  }

 private:
  void find_sources() {
    std::map<std::size_t, std::size_t> known;  // mesh → source
    for (const PartMesh& mesh : model_.meshes) {
      const std::size_t of = *file_.original.nodes[static_cast<std::size_t>(mesh.node)].mesh;
      const auto [at, is_new] = known.try_emplace(of, sources_.size());
      if (is_new) sources_.push_back({of, mesh.node, {}, 0, {}});
      Source& source = sources_[at->second];
      if (mesh.node == source.node) source.primitives.push_back(&mesh);
      if (source.primitives.front()->primitive == mesh.primitive) ++source.nodes;
    }
    std::erase_if(sources_, [&](const Source& source) {
      const std::string why = why_it_stays(source.mesh);
      if (why.empty()) return false;
      result_.warnings.push_back({"mesh " + std::to_string(source.mesh), "it was left whole: " + why});
      return true;
    });
    for (Source& source : sources_) {
      for (const PartMesh* primitive : source.primitives) add_to_group(source, *primitive);
    }
  }

  void add_to_group(Source& source, const PartMesh& primitive) {
    const auto number = static_cast<std::size_t>(primitive.primitive);
    auto group = std::find_if(source.groups.begin(), source.groups.end(), [&](const Group& other) {
      return alike(file_.original, source.mesh, static_cast<std::size_t>(other.mesh.primitive), number);
    });
    if (group == source.groups.end()) {
      source.groups.push_back({primitive, {}, {}, {}});
      group = std::prev(source.groups.end());
      group->mesh.positions.clear();
      group->mesh.triangles.clear();
    }
    PartMesh& mesh = group->mesh;
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    mesh.positions.insert(mesh.positions.end(), primitive.positions.begin(), primitive.positions.end());
    for (const Triangle& t : primitive.triangles) mesh.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
    for (std::uint32_t v = 0; v < primitive.positions.size(); ++v) {
      group->vertices.push_back({static_cast<std::uint32_t>(number), v});
    }
  }

  std::string why_it_stays(std::size_t mesh) const {
    for (const gltf::Node& node : file_.original.nodes) {
      if (node.mesh != mesh) continue;
      if (node.skinned) return "it is bound to a skeleton";
      if (node.instanced) return "it is GPU-instanced";
      if (!node.levels.empty()) return "it has levels of detail";
    }
    for (const gltf::Primitive& primitive : file_.original.meshes[mesh].primitives) {
      if (primitive.mode < 4) return "it has lines or points beside its triangles";
      if (std::string why = why_whole(file_.original, primitive); !why.empty()) return why;
    }
    return "";
  }

  Status take_apart() {
    std::size_t parts = result_.before;
    result_.joined = 0;
    for (std::size_t i = 0; i < sources_.size(); ++i) {
      report(progress_, "looking for what hangs together", static_cast<int>(i), static_cast<int>(sources_.size()));
      Source& source = sources_[i];
      for (Group& group : source.groups) {
        group.pieces = pieces_in(group);
        if (result_.by != SplitMethod::materials)
          result_.joined += join_small(group.pieces, small_below(options_.fine));
      }
      parts += source.nodes * source.pieces();
      parts -= source.nodes * source.primitives.size();
      if (parts > ImportLimits().parts) {
        return refused("it comes apart into more than " + std::to_string(ImportLimits().parts) + " pieces",
                       "split it coarser, so that small pieces go to what they sit on");
      }
    }
    result_.parts = parts;
    return success();
  }

  std::vector<Piece> pieces_in(Group& group) const {
    const PartMesh& mesh = group.mesh;
    if (result_.by == SplitMethod::materials) {
      return pieces_of(mesh, {std::vector<std::uint32_t>(mesh.triangles.size(), 0), 1});
    }
    const bool turned = mesh.world.topLeftCorner<3, 3>().determinant() < 0;
    if (!group.seams) group.seams = close_seams(mesh, turned);
    return pieces_of(mesh, result_.by == SplitMethod::regions
                               ? crease_regions(mesh, *group.seams, turned)
                               : components(*group.seams, [](HalfEdge) { return true; }));
  }

  /// The triangles of a piece with the vertices that they use.
  static PartMesh mesh_of(const PartMesh& mesh, const Piece& piece) {
    PartMesh out;
    std::vector<std::uint32_t> used;
    for (const std::uint32_t t : piece.triangles)
      used.insert(used.end(), mesh.triangles[t].begin(), mesh.triangles[t].end());
    std::sort(used.begin(), used.end());
    used.erase(std::unique(used.begin(), used.end()), used.end());
    for (const std::uint32_t v : used) out.positions.push_back(mesh.positions[v]);
    for (const std::uint32_t t : piece.triangles) {
      Triangle corners{};
      for (std::size_t k = 0; k < 3; ++k) {
        const auto at = std::lower_bound(used.begin(), used.end(), mesh.triangles[t][k]);
        corners[k] = static_cast<std::uint32_t>(at - used.begin());
      }
      out.triangles.push_back(corners);
    }
    return out;
  }

  static NewNodes named(const Source& source) {
    NewNodes out{source.mesh, {}};
    const std::string& label = source.primitives.front()->label;
    std::optional<PartMesh> first;
    bool all_alike = grouping_key(label) != "part";
    for (const Group& group : source.groups) {
      for (const Piece& piece : group.pieces) {
        NewNode node;
        const PartMesh mesh = mesh_of(group.mesh, piece);
        node.name = form_name(mesh);
        if (!first) first = mesh;
        all_alike = all_alike && same_size(*first, mesh);
        for (const std::uint32_t t : piece.triangles) {
          const Triangle& corners = group.mesh.triangles[t];
          node.triangles.push_back(
              {group.vertices[corners[0]], group.vertices[corners[1]], group.vertices[corners[2]]});
        }
        out.nodes.push_back(std::move(node));
      }
    }
    if (all_alike) {
      for (NewNode& node : out.nodes) node.name = label;
    }
    return out;
  }

  gltf::File& file_;
  const ImportedModel& model_;
  const SplitOptions& options_;
  const Progress& progress_;
  SplitModel result_;
  std::vector<Source> sources_;
};

}  // namespace

std::optional<SplitMethod> split_method(std::string_view text) {
  for (const auto& [method, name] : methods) {
    if (name == text) return method;
  }
  return std::nullopt;
}

std::string_view to_string(SplitMethod method) {
  for (const auto& [known, name] : methods) {
    if (known == method) return name;
  }
  return "";
}

Result<SplitModel> split_model(std::string_view bytes, const ExternalBuffers& external, const SplitOptions& options,
                               const Progress& progress) {
  if (!(options.fine >= 0 && options.fine <= 1)) {
    return refused("how fine to split is a number from 0 to 1", "give one of these");
  }
  report(progress, "reading the model", 0, 1);
  const Result<ImportedModel> model = import_gltf(bytes, external);
  if (!model.ok()) return model.error();
  Result<gltf::File> file = gltf::read_file(bytes, external);
  if (!file.ok()) return file.error();
  Result<SplitModel> result = Splitter(*file, *model, options, progress).run();
  if (!result.ok()) return result.error();
  gltf::embed(*file, external);
  Result<std::string> glb = gltf::write_glb(std::move(*file));
  if (!glb.ok()) return glb.error();
  result->glb = std::move(*glb);
  return result;
}

}  // namespace parsel
