// What closing gaps does to models, looked at with nothing of its own: edits that pull parts about, both ends of their
// sliders, before and after close_gaps(). Prints a JSON line a state with a gap, and at the end one with sums.
//   cmake --build --preset native-release --target parsel_repairs
//   build/native-release/tests/eval/parsel_repairs [FOLDER of GLBs]…        without a folder: the gallery
// Edits: automatic_edits(), and every active part moved along each axis by itself, propagated; of the gallery its own edits
// as well. Lengths in the normalised frame.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <limits>
#include <nlohmann/json.hpp>
#include <sstream>

#include "core/export/apply.h"
#include "core/gallery/gallery.h"
#include "core/propagate/propagate.h"
#include "core/shape/gltf_import.h"
#include "core/shape/surface.h"
#include "tests/eval/measure.h"
#include "tests/eval/seeds.h"

using namespace parsel;
using namespace parsel::eval;
using nlohmann::json;
namespace fs = std::filesystem;

namespace {

struct Sums {
  int models = 0, edits = 0, states = 0, open_states = 0;
  int gaps = 0, closed = 0, left = 0;
  int surface_gaps_before = 0, surface_gaps_after = 0;
  int extended = 0;
  double new_overlap = 0, elsewhere = 0, stretch = 0;
  std::size_t triangles = 0, relabelled = 0;
};

std::vector<NamedEdit> edits_of(const Shape& shape) {
  std::vector<NamedEdit> edits = automatic_edits(shape);
  for (const PartIndex p : active_parts(shape)) {
    for (const int axis : {0, 1, 2}) {
      json direction = {0, 0, 0};
      direction[static_cast<std::size_t>(axis)] = 1;
      const json statement = {
          {"op", "translate"}, {"part", shape.parts[p].id}, {"direction", direction}, {"amount", "x"}};
      edits.push_back({shape.parts[p].id + " along " + "xyz" [axis], {
                         {"format", "parsel/edit"}, {"version", 1}, {
                           "seed", json::array({statement})
                         }
                       }});
    }
  }
  return edits;
}

PartMesh deformed(const Abstraction& abstraction, PartIndex part, const Corners& corners) {
  PartMesh mesh = abstraction.meshes[part];
  const Hexahedron& rest = abstraction.shape.parts[part].hexahedron;
  for (Vec3& point : mesh.positions) {
    if (point.allFinite()) point = interpolate(trilinear_weights(rest.local(point)), corners);
  }
  return mesh;
}

/// Greatest distance of points of one surface from another surface.
double farthest(const std::vector<Vec3>& points, const PartMesh& mesh) {
  double most = 0;
  for (const Vec3& p : points) {
    double least = std::numeric_limits<double>::infinity();
    for (const Triangle& t : mesh.triangles) {
      const Vec3 &a = mesh.positions[t[0]], &b = mesh.positions[t[1]], &c = mesh.positions[t[2]];
      const Vec3 low = a.cwiseMin(b).cwiseMin(c), high = a.cwiseMax(b).cwiseMax(c);
      if ((p - p.cwiseMax(low).cwiseMin(high)).norm() < least)
        least = std::min(least, distance_to_triangle(p, a, b, c));
    }
    most = std::max(most, least);
  }
  return most;
}

/// Hausdorff distance of an extended part from what it was, save what it grew by: of the old surface to the new one and back,
/// without points that lie nearer to where its end was than it grew.
double moved_elsewhere(const Abstraction& abstraction, PartIndex part, const Corners& was, const Corners& is) {
  const PartMesh before = deformed(abstraction, part, was), after = deformed(abstraction, part, is);
  // The end that moved: its plane, before and after.
  Vec3 from = Vec3::Zero(), to = Vec3::Zero();
  double count = 0;
  for (int k = 0; k < 8; ++k) {
    if ((is.row(k) - was.row(k)).norm() < 1e-12) continue;
    from += was.row(k).transpose();
    to += is.row(k).transpose();
    ++count;
  }
  if (count == 0) return 0;
  from /= count;
  to /= count;
  const double grown = (to - from).norm();
  const Vec3 along = (to - from) / grown;
  const auto away = [&](const PartMesh& mesh) {
    std::vector<Vec3> kept;
    for (const Vec3& p : sample_surface(mesh, 1500)) {
      if ((p - from).dot(along) < -grown) kept.push_back(p);
    }
    return kept;
  };
  return std::max(farthest(away(before), after), farthest(away(after), before));
}

int surface_gaps(const Damage& damage) {
  int count = 0;
  for (const PairOfParts& pair : damage.gaps) count += pair.amount > narrowest_gap;
  return count;
}

void look_at(const std::string& bytes, const Abstraction& abstraction, const Gauge& gauge, const Program& program,
             double x, const json& name, Sums& sums) {
  const Shape& shape = abstraction.shape;
  const State edited = Evaluator(program, shape)({x});
  State repaired = edited;
  ++sums.states;
  const ClosedGaps closed = close_gaps(shape, repaired);
  if (closed.before.empty()) return;
  ++sums.open_states;
  const Damage before = gauge.measure(edited), after = gauge.measure(repaired);
  json line = name;
  line.update({{"x", x},
               {"gaps", closed.before.size()},
               {"left", closed.left.size()},
               {"surface_gaps", {surface_gaps(before), surface_gaps(after)}},
               {"widest_surface_gap", {before.gap, after.gap}},
               {"new_overlap", after.overlap - before.overlap}});
  json left = json::array();
  for (const Gap& gap : closed.left) {
    const auto& pair = shape.relations[gap.relation].parts;
    left.push_back({shape.parts[pair[0]].id, shape.parts[pair[1]].id, gap.width});
  }
  line["left_open"] = left;
  double elsewhere = 0, stretch = 0;
  int extended = 0;
  for (const PartIndex p : abstraction.meshes.indices()) {
    const Corners &was = edited.parts[p], &is = repaired.parts[p];
    if (was == is) continue;
    ++extended;
    elsewhere = std::max(elsewhere, moved_elsewhere(abstraction, p, was, is));
    for (int k = 0; k < 8; ++k) {
      for (int axis = 0; axis < 3; ++axis) {
        const int other = k ^ (1 << axis);
        const double length = (was.row(k) - was.row(other)).norm();
        if (length > 1e-9) stretch = std::max(stretch, (is.row(k) - is.row(other)).norm() / length - 1);
      }
    }
  }
  line.update({{"extended", extended}, {"elsewhere", elsewhere}, {"stretch", stretch}});
  // What is written, part by part, as a reader of files sees it.
  ApplyOptions options;
  options.repair = true;
  const auto plain = apply_program(bytes, shape, program, {x});
  const auto whole = apply_program(bytes, shape, program, {x}, std::nullopt, options);
  if (plain.ok() && whole.ok()) {
    const auto a = import_gltf(plain->glb), b = import_gltf(whole->glb);
    for (std::size_t i = 0; a.ok() && i < a->meshes.size(); ++i) {
      const PartIndex p(i);
      sums.triangles += a->meshes[p].triangles.size();
      const bool same = b.ok() && b->meshes.size() == a->meshes.size() && b->meshes[p].label == a->meshes[p].label &&
                        b->meshes[p].triangles == a->meshes[p].triangles;
      if (!same) sums.relabelled += a->meshes[p].triangles.size();
    }
  } else {
    line["failure"] = "apply";
  }
  sums.gaps += static_cast<int>(closed.before.size());
  sums.left += static_cast<int>(closed.left.size());
  sums.surface_gaps_before += surface_gaps(before);
  sums.surface_gaps_after += surface_gaps(after);
  sums.extended += extended;
  sums.new_overlap = std::max(sums.new_overlap, after.overlap - before.overlap);
  sums.elsewhere = std::max(sums.elsewhere, elsewhere);
  sums.stretch = std::max(sums.stretch, stretch);
  std::cout << line.dump() << std::endl;
}

void look_at(const std::string& bytes, const std::string& name, const std::vector<NamedEdit>& more, Sums& sums) {
  const auto abstraction = abstract_shape(bytes, name);
  if (!abstraction.ok()) {
    std::cerr << name << ": " << abstraction.error().message() << '\n';
    return;
  }
  ++sums.models;
  const Gauge gauge(*abstraction);
  std::vector<NamedEdit> edits = edits_of(abstraction->shape);
  edits.insert(edits.end(), more.begin(), more.end());
  for (const NamedEdit& edit : edits) {
    const auto request = edit_request_from_json(edit.edit);
    if (!request.ok()) continue;
    const auto found = propagate(abstraction->shape, *request);
    if (!found.ok()) continue;
    ++sums.edits;
    const Parameter& parameter = found->program.layers[0].parameter;
    for (const double x : {parameter.min, parameter.max})
      look_at(bytes, *abstraction, gauge, found->program, x, {{"model", name}, {"edit", edit.name}}, sums);
  }
}

}  // namespace

int main(int count, char** arguments) {
  Sums sums;
  if (count < 2) {
    for (const GalleryModel& model : gallery_models()) {
      const auto asset = build(model);
      if (!asset.ok()) return 1;
      std::vector<NamedEdit> own;
      for (const GalleryEdit& edit : asset->edits) own.push_back({edit.id, json::parse(edit.json)});
      look_at(asset->glb, model.id, own, sums);
      std::cerr << '\r' << model.id << "\x1b[K" << std::flush;
    }
  }
  for (int i = 1; i < count; ++i) {
    std::vector<fs::path> files;
    for (const auto& entry : fs::directory_iterator(arguments[i])) {
      if (entry.path().extension() == ".glb") files.push_back(entry.path());
    }
    std::sort(files.begin(), files.end());
    for (const fs::path& file : files) {
      std::ifstream in(file, std::ios::binary);
      std::ostringstream bytes;
      bytes << in.rdbuf();
      look_at(bytes.str(), file.stem().string(), {}, sums);
      std::cerr << '\r' << file.stem().string() << "\x1b[K" << std::flush;
    }
  }
  std::cerr << '\n';
  std::cout << json{{"models", sums.models},
                    {"edits", sums.edits},
                    {"states", sums.states},
                    {"states_with_gaps", sums.open_states},
                    {"gaps", sums.gaps},
                    {"left", sums.left},
                    {"surface_gaps", {sums.surface_gaps_before, sums.surface_gaps_after}},
                    {"extended_parts", sums.extended},
                    {"most_new_overlap", sums.new_overlap},
                    {"hausdorff_elsewhere", sums.elsewhere},
                    {"most_stretch", sums.stretch},
                    {"triangles", sums.triangles},
                    {"relabelled", sums.relabelled}}
                   .dump()
            << '\n';
}
