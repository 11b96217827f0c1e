// The gallery's generators and their files, read back by a small reader of its own.
#include <doctest/doctest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "core/gallery/gallery.h"

using namespace parsel;
using Json = nlohmann::json;

namespace {

struct ReadMesh {
  std::vector<Vec3> positions, normals;
  std::vector<std::uint32_t> indices;
};

struct ReadGlb {
  Json json;
  std::vector<ReadMesh> meshes;
};

std::uint32_t u32_at(const std::string& bytes, std::size_t offset) {
  std::uint32_t value = 0;
  std::memcpy(&value, bytes.data() + offset, 4);
  return value;
}

/// Checks the container and every accessor's bounds on the way.
ReadGlb read(const std::string& glb) {
  ReadGlb out;
  REQUIRE(glb.size() > 28);
  CHECK(glb.substr(0, 4) == "glTF");
  CHECK(u32_at(glb, 4) == 2);
  REQUIRE(u32_at(glb, 8) == glb.size());
  const std::size_t json_size = u32_at(glb, 12);
  REQUIRE(json_size % 4 == 0);
  CHECK(glb.substr(16, 4) == "JSON");
  out.json = Json::parse(glb.substr(20, json_size));
  const std::size_t binary_size = u32_at(glb, 20 + json_size), begin = 28 + json_size;
  REQUIRE(begin + binary_size == glb.size());
  CHECK(out.json["buffers"][0]["byteLength"] == binary_size);

  const auto view_of = [&](const Json& accessor, std::size_t element_size) {
    const Json& view = out.json["bufferViews"][accessor["bufferView"].get<std::size_t>()];
    const auto offset = view["byteOffset"].get<std::size_t>(), length = view["byteLength"].get<std::size_t>();
    REQUIRE(offset + length <= binary_size);
    REQUIRE(accessor["count"].get<std::size_t>() * element_size == length);
    REQUIRE(offset % 4 == 0);
    return begin + offset;
  };
  const auto vectors = [&](std::size_t index) {
    const Json& accessor = out.json["accessors"][index];
    std::size_t at = view_of(accessor, 12);
    std::vector<Vec3> values;
    Vec3 low = Vec3::Constant(1e30), high = -low;
    for (std::size_t i = 0; i < accessor["count"].get<std::size_t>(); ++i, at += 12) {
      std::array<float, 3> v;
      std::memcpy(v.data(), glb.data() + at, 12);
      values.emplace_back(v[0], v[1], v[2]);
      low = low.cwiseMin(values.back());
      high = high.cwiseMax(values.back());
    }
    if (accessor.contains("min")) {
      for (std::size_t k = 0; k < 3; ++k) {
        CHECK(accessor["min"][k].get<double>() == low[static_cast<int>(k)]);
        CHECK(accessor["max"][k].get<double>() == high[static_cast<int>(k)]);
      }
    }
    return values;
  };
  for (const Json& mesh : out.json["meshes"]) {
    REQUIRE(mesh["primitives"].size() == 1);
    const Json& primitive = mesh["primitives"][0];
    ReadMesh m;
    m.positions = vectors(primitive["attributes"]["POSITION"]);
    m.normals = vectors(primitive["attributes"]["NORMAL"]);
    const Json& indices = out.json["accessors"][primitive["indices"].get<std::size_t>()];
    REQUIRE(indices["componentType"] == 5123);
    std::size_t at = view_of(indices, 2);
    for (std::size_t i = 0; i < indices["count"].get<std::size_t>(); ++i, at += 2) {
      std::uint16_t index = 0;
      std::memcpy(&index, glb.data() + at, 2);
      m.indices.push_back(index);
    }
    out.meshes.push_back(std::move(m));
  }
  return out;
}

/// Finite, closed, facing outwards, with unit normals. Returns the number of triangles.
std::size_t check_mesh(const ReadMesh& mesh) {
  bool is_finite = true, is_unit = true, in_range = true;
  for (const Vec3& p : mesh.positions) is_finite = is_finite && p.allFinite();
  for (const Vec3& n : mesh.normals) is_unit = is_unit && std::abs(n.norm() - 1) < 1e-4;
  for (const std::uint32_t i : mesh.indices) in_range = in_range && i < mesh.positions.size();
  CHECK(is_finite);
  CHECK(is_unit);
  REQUIRE(in_range);
  REQUIRE(mesh.indices.size() % 3 == 0);

  // Corners by place: normals split vertices, so edges are matched by position.
  std::map<std::array<double, 3>, std::uint32_t> places;
  const auto place = [&](std::uint32_t i) {
    const Vec3& p = mesh.positions[i];
    return places.emplace(std::array<double, 3>{p.x(), p.y(), p.z()}, static_cast<std::uint32_t>(places.size()))
        .first->second;
  };
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
  double volume = 0;
  int against_normals = 0;
  for (std::size_t t = 0; t < mesh.indices.size(); t += 3) {
    const std::uint32_t i[3] = {mesh.indices[t], mesh.indices[t + 1], mesh.indices[t + 2]};
    const Vec3 &a = mesh.positions[i[0]], &b = mesh.positions[i[1]], &c = mesh.positions[i[2]];
    volume += a.dot(b.cross(c)) / 6;
    const Vec3 face = (b - a).cross(c - a);
    const Vec3 normal = mesh.normals[i[0]] + mesh.normals[i[1]] + mesh.normals[i[2]];
    if (face.norm() > 1e-9 && face.normalized().dot(normal) < 0) ++against_normals;
    for (int k = 0; k < 3; ++k) ++edges[{place(i[k]), place(i[(k + 1) % 3])}];
  }
  CHECK(volume > 0);
  CHECK(against_normals == 0);
  int open_edges = 0;
  for (const auto& [edge, count] : edges) {
    const auto back = edges.find({edge.second, edge.first});
    if (back == edges.end() || back->second != count) ++open_edges;
  }
  CHECK(open_edges == 0);
  return mesh.indices.size() / 3;
}

Eigen::Affine3d local_transform(const Json& node) {
  Eigen::Affine3d transform = Eigen::Affine3d::Identity();
  if (node.contains("translation")) {
    const auto t = node["translation"].get<std::array<double, 3>>();
    transform.translate(Vec3(t[0], t[1], t[2]));
  }
  if (node.contains("rotation")) {
    const auto r = node["rotation"].get<std::array<double, 4>>();
    transform.rotate(Eigen::Quaterniond(r[3], r[0], r[1], r[2]));
  }
  return transform;
}

std::vector<Eigen::Affine3d> world_transforms(const Json& json) {
  const std::size_t n = json["nodes"].size();
  std::vector<Eigen::Affine3d> world(n, Eigen::Affine3d::Identity());
  // Parents come before their children in these files.
  for (const auto& root : json["scenes"][0]["nodes"]) {
    world[root.get<std::size_t>()] = local_transform(json["nodes"][root.get<std::size_t>()]);
  }
  for (std::size_t i = 0; i < n; ++i) {
    if (!json["nodes"][i].contains("children")) continue;
    for (const auto& child : json["nodes"][i]["children"]) {
      REQUIRE(child.get<std::size_t>() > i);
      world[child.get<std::size_t>()] = world[i] * local_transform(json["nodes"][child.get<std::size_t>()]);
    }
  }
  return world;
}

/// Every part's vertices fill the box that the generator states.
void check_boxes(const GalleryAsset& asset, const ReadGlb& glb) {
  const std::vector<Eigen::Affine3d> world = world_transforms(glb.json);
  for (const GalleryPart& part : asset.parts) {
    const auto node = static_cast<std::size_t>(part.node);
    const ReadMesh& mesh = glb.meshes[glb.json["nodes"][node]["mesh"].get<std::size_t>()];
    Vec3 low = Vec3::Constant(1e30), high = -low;
    for (const Vec3& p : mesh.positions) {
      low = low.cwiseMin(p);
      high = high.cwiseMax(p);
    }
    double worst = 0;
    for (int k = 0; k < 8; ++k) {
      Vec3 corner;
      for (int i = 0; i < 3; ++i) corner[i] = corner_sign(k, i) > 0 ? high[i] : low[i];
      worst = std::max(worst, (world[node] * corner - part.corners.row(k).transpose()).norm());
    }
    CAPTURE(part.label);
    CHECK(worst < 1e-5);
  }
}

double lowest(const GalleryAsset& asset) {
  double y = 1e30;
  for (const GalleryPart& part : asset.parts) y = std::min(y, part.corners.col(1).minCoeff());
  return y;
}

}  // namespace

TEST_CASE("gallery: every model is a sound file that stands on the ground") {
  REQUIRE(gallery_models().size() >= 16);
  std::set<std::string> ids;
  for (const GalleryModel& model : gallery_models()) {
    CAPTURE(model.id);
    CHECK(ids.insert(model.id).second);
    const Result<GalleryAsset> asset = build(model);
    REQUIRE(asset.ok());
    const ReadGlb glb = read(asset->glb);
    std::vector<std::size_t> triangles;
    for (const ReadMesh& mesh : glb.meshes) triangles.push_back(check_mesh(mesh));
    std::size_t total = 0;
    for (const GalleryPart& part : asset->parts) {
      total += triangles[glb.json["nodes"][static_cast<std::size_t>(part.node)]["mesh"].get<std::size_t>()];
    }
    CHECK(total >= 500);
    CHECK(total <= 15000);
    CHECK(asset->glb.size() < 300000);
    CHECK(asset->parts.size() >= 5);
    CHECK(std::abs(lowest(*asset)) < 1e-9);
    check_boxes(*asset, glb);
    CHECK(build(model)->glb == asset->glb);
  }
}

namespace {

void check_parameters_at(double GalleryParameter::*end) {
  for (const GalleryModel& model : gallery_models()) {
    CAPTURE(model.id);
    CHECK(model.parameters.size() >= 7);
    for (const GalleryParameter& parameter : model.parameters) {
      CAPTURE(parameter.name);
      CHECK(parameter.min < parameter.max);
      const Result<GalleryAsset> asset = build(model, {{parameter.name, parameter.*end}});
      REQUIRE(asset.ok());
      const ReadGlb glb = read(asset->glb);
      bool is_finite = true;
      for (const ReadMesh& mesh : glb.meshes) {
        for (const Vec3& p : mesh.positions) is_finite = is_finite && p.allFinite();
      }
      CHECK(is_finite);
      check_boxes(*asset, glb);
    }
  }
}

}  // namespace

TEST_CASE("gallery: every parameter at its lower end gives a sound file") {
  check_parameters_at(&GalleryParameter::min);
}

TEST_CASE("gallery: every parameter at its upper end gives a sound file") {
  check_parameters_at(&GalleryParameter::max);
}

TEST_CASE("gallery: wrong values are refused by name") {
  const GalleryModel& chair = *find_gallery_model("chair");
  const auto place_of = [&](const GalleryValues& values) {
    const Result<GalleryAsset> asset = build(chair, values);
    REQUIRE(!asset.ok());
    return asset.error().place;
  };
  CHECK(place_of({{"wings", 2}}) == "wings");
  CHECK(place_of({{"seat_width", 100}}) == "seat_width");
  CHECK(place_of({{"seat_width", std::nan("")}}) == "seat_width");
  CHECK(place_of({{"slat_count", 4.5}}) == "slat_count");
  CHECK(find_gallery_model("throne") == nullptr);
}

TEST_CASE("gallery: the values of every edit can be built over the whole range") {
  for (const GalleryModel& model : gallery_models()) {
    CAPTURE(model.id);
    const GalleryAsset rest = build(model).value();
    CHECK(rest.edits.size() >= 2);
    std::set<std::string> ids;
    for (const GalleryEdit& edit : rest.edits) {
      CAPTURE(edit.id);
      CHECK(ids.insert(edit.id).second);
      CHECK(edit.request.back() == '.');
      const Json json = Json::parse(edit.json);
      CHECK(!json["seed"].empty());
      for (const double x : {-0.35, 0.0, 0.35}) {
        CAPTURE(x);
        const Result<GalleryAsset> edited = build(model, edit.values(x));
        REQUIRE_MESSAGE(edited.ok(), edited.error().message());
        // At 0 nothing changes; elsewhere something does.
        CHECK((edited->glb == rest.glb) == (x == 0.0));
      }
      for (const Json& statement : json["seed"]) {
        if (!statement.contains("part")) continue;
        const int node = std::stoi(statement["part"].get<std::string>().substr(5));
        CHECK(std::any_of(rest.parts.begin(), rest.parts.end(), [&](const auto& p) { return p.node == node; }));
      }
    }
  }
}

TEST_CASE("gallery: an edit of affine parts moves vertices as it moves boxes") {
  // Bevels are those of the default state, stretched: local coordinates of all vertices stay what they were.
  const GalleryModel& chair = *find_gallery_model("chair");
  const ReadGlb rest = read(build(chair)->glb), wide = read(build(chair, {{"seat_width", 0.6}})->glb);
  REQUIRE(rest.meshes.size() == wide.meshes.size());
  double worst = 0;
  for (std::size_t m = 0; m < rest.meshes.size(); ++m) {
    REQUIRE(rest.meshes[m].positions.size() == wide.meshes[m].positions.size());
    Vec3 before = Vec3::Zero(), after = Vec3::Zero();
    for (const Vec3& p : rest.meshes[m].positions) before = before.cwiseMax(p);
    for (const Vec3& p : wide.meshes[m].positions) after = after.cwiseMax(p);
    for (std::size_t i = 0; i < rest.meshes[m].positions.size(); ++i) {
      const Vec3 expected = rest.meshes[m].positions[i].cwiseQuotient(before).cwiseProduct(after);
      worst = std::max(worst, (wide.meshes[m].positions[i] - expected).norm());
    }
  }
  CHECK(worst < 5e-6);
}

TEST_CASE("gallery: the scaling model has as many parts as asked for") {
  for (const int n : {5, 6, 7, 20, 50, 101}) {
    const Result<GalleryAsset> asset = scaling_model(n);
    REQUIRE(asset.ok());
    CHECK(asset->parts.size() == static_cast<std::size_t>(n));
    std::set<std::string> labels;
    for (const GalleryPart& part : asset->parts) labels.insert(part.label);
    CHECK(labels.size() == static_cast<std::size_t>(n));
    const ReadGlb glb = read(asset->glb);
    for (const ReadMesh& mesh : glb.meshes) check_mesh(mesh);
  }
  CHECK(!scaling_model(4).ok());
  CHECK(!scaling_model(1001).ok());
}
