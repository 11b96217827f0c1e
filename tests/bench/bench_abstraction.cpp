// How long a model takes from its bytes to its shape, and the memory it takes: lines `benchmark,case,metric,value`.
// Generated models always; the files of $PARSEL_DATA/furniture when that is set.
#include <sys/resource.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

#include "core/shape/abstraction.h"
#include "core/shape/gltf_import.h"
#include "tests/core/glb_fixture.h"
#include "tests/core/real_models.h"

namespace {

using namespace parsel;

double milliseconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

/// Peak resident memory of the process so far, MB.
double peak_memory() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024.0;
}

/// A cylinder: what turned legs and knobs are made of.
fixture::Mesh cylinder(const Vec3& centre, double radius, double height, std::uint32_t sides, std::uint32_t rings) {
  fixture::Mesh mesh;
  for (std::uint32_t r = 0; r <= rings; ++r) {
    for (std::uint32_t s = 0; s < sides; ++s) {
      const double angle = 2 * pi * s / sides;
      mesh.positions.push_back(centre + Vec3(radius * std::cos(angle), height * (static_cast<double>(r) / rings - 0.5),
                                             radius * std::sin(angle)));
      if (r == rings) continue;
      const std::uint32_t a = r * sides + s, b = r * sides + (s + 1) % sides;
      mesh.triangles.push_back({a, a + sides, b});
      mesh.triangles.push_back({b, a + sides, b + sides});
    }
  }
  return mesh;
}

/// A fence of posts with rails: `parts` parts of `triangles` triangles or more each.
std::vector<fixture::Named> fence(int parts, std::uint32_t triangles) {
  std::vector<fixture::Named> out;
  const int rails = std::max(2, parts / 10), posts = parts - rails;
  for (int i = 0; i < posts; ++i) {
    // Every third post a little thicker, so that there is more than one set.
    out.push_back({"post", cylinder({0.2 * i, 0.5, 0}, i % 3 == 0 ? 0.04 : 0.03, 1, 32, triangles / 64)});
  }
  for (int i = 0; i < rails; ++i) {
    out.push_back(
        {"rail", fixture::box({0.1 * (posts - 1), 0.05 + 0.9 * i / (rails - 1), 0}, {0.2 * posts, 0.04, 0.02})});
  }
  return out;
}

void measure(const std::string& name, const std::string& bytes) {
  std::vector<double> times;
  std::size_t parts = 0, relations = 0, triangles = 0;
  double import_best = 1e9;
  for (int run = 0; run < 5; ++run) {
    auto start = std::chrono::steady_clock::now();
    const Result<Abstraction> result = abstract_shape(bytes, name);
    times.push_back(milliseconds_since(start));
    if (!result.ok()) {
      std::fprintf(stderr, "%s: %s\n", name.c_str(), result.error().message().c_str());
      std::exit(1);
    }
    parts = result->meshes.size();
    relations = result->shape.relations.size();
    triangles = 0;
    for (const PartMesh& mesh : result->meshes) triangles += mesh.triangles.size();
    start = std::chrono::steady_clock::now();
    const bool read = import_gltf(bytes).ok();
    if (read) import_best = std::min(import_best, milliseconds_since(start));
  }
  std::sort(times.begin(), times.end());
  const auto print = [&](const char* metric, double value) {
    std::printf("abstraction,%s,%s,%.6g\n", name.c_str(), metric, value);
  };
  print("parts", static_cast<double>(parts));
  print("relations", static_cast<double>(relations));
  print("triangles", static_cast<double>(triangles));
  print("import_best_ms", import_best);
  print("best_ms", times.front());
  print("median_ms", times[times.size() / 2]);
  print("peak_memory_mb", peak_memory());
}

}  // namespace

int main() {
  measure("fence_20_parts_100k", fixture::model(fence(20, 5120)));
  measure("fence_100_parts_100k", fixture::model(fence(100, 1088)));
  for (const auto& path : test::real_models("furniture")) measure(path.stem().string(), test::read_bytes(path));
  return 0;
}
