#include "core/split/split.h"

#include <algorithm>
#include <array>
#include <limits>
#include <map>
#include <utility>

#include "core/export/apply_file.h"
#include "core/gltf/scene.h"
#include "core/shape/gltf_import.h"
#include "core/shape/label.h"
#include "core/shape/oriented_box.h"
#include "core/split/behind.h"
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
constexpr std::size_t few_parts = 4;
/// … and so is one of which a single component has this share of the surface. The largest parts of furniture have up to 0.71
/// of it (a round table's top), what is fused at most of its joints from 0.98.
constexpr double most_of_it = 0.85;
/// Of one mesh, more regions than this are no parts: it is creased all over, as scans are. Fused furniture has up to 39.
constexpr std::size_t most_regions = 200;
/// How much coarser a model of too many pieces is split, again and again, when nobody said how.
constexpr double coarser = 0.25;

constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();

Error refused(std::string cause, std::string fix) {
  return {"split/split", "", std::move(cause), std::move(fix)};
}

/// Primitives of a glTF mesh that can become one: as one mesh, as the first node shows them.
struct Group {
  PartMesh mesh;
  std::vector<VertexOf> vertices;  ///< where each vertex of `mesh` comes from
  std::vector<Piece> apart;        ///< all that is told apart
  std::vector<Piece> pieces;       ///< what is left of it once what is small has gone to what it sits on
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
    const bool chooses = options_.by == SplitMethod::automatic;
    result_.by = chooses ? SplitMethod::components : options_.by;
    take_apart();
    if (chooses && (count_parts() < few_parts || largest_share() > most_of_it)) {
      for (Source& source : sources_) {
        for (Group& group : source.groups) {
          if (take_regions(source, group)) result_.by = SplitMethod::regions;
        }
      }
      join();
    }
    while (chooses && count_parts() > ImportLimits().parts && fine_ > 0) {
      fine_ = std::max(fine_ - coarser, 0.0);
      join();
      if (count_parts() <= ImportLimits().parts) {
        result_.warnings.push_back({"the model", "it was split coarser: it falls into very many pieces"});
      }
    }
    result_.parts = count_parts();
    if (result_.parts > ImportLimits().parts) return too_many();
    std::vector<NewNodes> meshes;
    for (const Source& source : sources_) {
      if (source.pieces() > 1 || source.primitives.size() > 1) meshes.push_back(named(source, meshes.size()));
    }
    report(progress_, "writing the parts", 0, 1);
    if (Status s = write_pieces(file_, meshes); !s.ok()) return s.error();
    return std::move(result_);
  }

  SplitWays ways() {
    result_.before = model_.meshes.size();
    find_sources();
    SplitWays found{result_.before, {}};
    for (const SplitMethod by : {SplitMethod::components, SplitMethod::materials, SplitMethod::regions}) {
      result_.by = by;
      take_apart();
      const std::size_t parts = count_parts();
      found.ways.push_back({by, parts, parts > ImportLimits().parts});
    }
    return found;
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
      source.groups.push_back({primitive, {}, {}, {}, {}});
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

  void take_apart() {
    for (std::size_t i = 0; i < sources_.size(); ++i) {
      const bool creases = result_.by == SplitMethod::regions;
      report(progress_, creases ? "looking for creases" : "looking for what hangs together", static_cast<int>(i),
             static_cast<int>(sources_.size()));
      for (Group& group : sources_[i].groups) group.apart = pieces_in(group, result_.by);
    }
    join();
  }

  /// Along creases, unless there are too many of them to be the borders of parts.
  bool take_regions(const Source& source, Group& group) {
    const std::string place = "mesh " + std::to_string(source.mesh);
    if (group.mesh.triangles.size() > CreaseOptions().most_triangles) {
      result_.warnings.push_back({place, "it hangs together and is as fine as a scan: cut it by hand where parts end"});
      return false;
    }
    report(progress_, "looking for creases", 0, 1);
    std::vector<Piece> regions = pieces_in(group, SplitMethod::regions), large = regions;
    join_small(large, small_below(fine_), ImportLimits().parts);
    if (large.size() > group.pieces.size() + most_regions) {
      result_.warnings.push_back({place, "it hangs together and is creased all over: cut it by hand where parts end"});
      return false;
    }
    group.apart = std::move(regions);
    return true;
  }

  /// What is small goes to what it sits on.
  void join() {
    result_.joined = 0;
    for (Source& source : sources_) {
      for (Group& group : source.groups) {
        group.pieces = group.apart;
        if (result_.by == SplitMethod::materials) continue;
        result_.joined += join_small(group.pieces, small_below(fine_), ImportLimits().parts);
      }
    }
  }

  std::size_t count_parts() const {
    std::size_t parts = result_.before;
    for (const Source& source : sources_) {
      parts += source.nodes * source.pieces();
      parts -= source.nodes * source.primitives.size();
    }
    return parts;
  }

  Error too_many() {
    std::string cause = "it comes apart into more than " + std::to_string(ImportLimits().parts) + " pieces";
    fine_ = 0;
    join();
    if (count_parts() <= ImportLimits().parts) {
      return refused(std::move(cause), "split it coarser, so that small pieces go to what they sit on");
    }
    return refused(cause + ", however coarse", "leave it in one piece, and cut it by hand where parts end");
  }

  /// Of the surface of the model, what its largest piece has.
  double largest_share() const {
    double all = 0, largest = 0;
    for (const Source& source : sources_) {
      for (const Group& group : source.groups) {
        for (const Piece& piece : group.pieces) {
          all += static_cast<double>(source.nodes) * piece.area;
          largest = std::max(largest, piece.area);
        }
      }
    }
    return all > 0 ? largest / all : 0;
  }

  static std::vector<Piece> pieces_in(Group& group, SplitMethod by) {
    const PartMesh& mesh = group.mesh;
    if (by == SplitMethod::materials) {
      return pieces_of(mesh, {std::vector<std::uint32_t>(mesh.triangles.size(), 0), 1});
    }
    const bool turned = mesh.world.topLeftCorner<3, 3>().determinant() < 0;
    if (!group.seams) group.seams = close_seams(mesh, turned);
    const Components apart = by == SplitMethod::regions ? crease_regions(mesh, *group.seams, turned)
                                                        : components(*group.seams, [](HalfEdge) { return true; });
    return pieces_of(mesh, join_behind(mesh, *group.seams, turned, apart));
  }

  /// The triangles of a piece with the vertices that they use. `number` by vertex of `mesh`: all none, before and after.
  static PartMesh mesh_of(const PartMesh& mesh, const Piece& piece, std::vector<std::uint32_t>& number) {
    PartMesh out;
    std::vector<std::uint32_t> used;
    for (const std::uint32_t t : piece.triangles) {
      Triangle corners{};
      for (std::size_t k = 0; k < 3; ++k) {
        const std::uint32_t v = mesh.triangles[t][k];
        if (number[v] == none) {
          number[v] = static_cast<std::uint32_t>(used.size());
          used.push_back(v);
          out.positions.push_back(mesh.positions[v]);
        }
        corners[k] = number[v];
      }
      out.triangles.push_back(corners);
    }
    for (const std::uint32_t v : used) number[v] = none;
    return out;
  }

  NewNodes named(const Source& source, std::size_t done) const {
    NewNodes out{source.mesh, {}};
    const std::string& label = source.primitives.front()->label;
    std::optional<Hexahedron> first;
    bool all_alike = grouping_key(label) != "part";
    for (const Group& group : source.groups) {
      std::vector<std::uint32_t> number(group.mesh.positions.size(), none);
      for (const Piece& piece : group.pieces) {
        if (out.nodes.size() % 50 == 0) {
          report(progress_, "measuring the parts", static_cast<int>(done), static_cast<int>(sources_.size()));
        }
        NewNode node;
        const Hexahedron box = oriented_box(mesh_of(group.mesh, piece, number));
        node.name = form_name(box);
        if (!first) first = box;
        all_alike = all_alike && same_size(*first, box);
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
  double fine_ = options_.fine;  ///< coarser where it has to be
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

namespace {

Status check_fine(double fine) {
  if (fine >= 0 && fine <= 1) return success();
  return refused("how fine to split is a number from 0 to 1", "give one of these");
}

}  // namespace

Result<SplitModel> split_model(std::string_view bytes, const ExternalBuffers& external, const SplitOptions& options,
                               const Progress& progress) {
  if (const Status fine = check_fine(options.fine); !fine) return fine.error();
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

Result<SplitWays> split_ways(std::string_view bytes, const ExternalBuffers& external, double fine,
                             const Progress& progress) {
  if (const Status checked = check_fine(fine); !checked) return checked.error();
  report(progress, "reading the model", 0, 1);
  const Result<ImportedModel> model = import_gltf(bytes, external);
  if (!model.ok()) return model.error();
  Result<gltf::File> file = gltf::read_file(bytes, external);
  if (!file.ok()) return file.error();
  return Splitter(*file, *model, {SplitMethod::components, fine}, progress).ways();
}

}  // namespace parsel
