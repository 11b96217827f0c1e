// Screened Poisson surface reconstruction (Kazhdan and Hoppe 2013) for WebAssembly: Kazhdan's own implementation, version 9,
// as MeshLab ships it (fetch.sh), behind one function. In a module of its own, which pages load when it is asked for.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>
#include <unordered_map>
#include <vector>

// The headers print what they do through this.
static void DumpOutput(const char*, ...) {}

// They ask /proc how much memory there is in use; there is none here.
#define MEMORY_USAGE_INCLUDED
struct MemoryInfo {
  static std::size_t Usage() { return 0; }
};

// They build on each other in this order.
// clang-format off
#include "MyTime.h"
#include "MarchingCubes.h"
#include "Octree.h"
#include "SparseMatrix.h"
#include "PPolynomial.h"
#include "MultiGridOctreeData.h"
// clang-format on

namespace {

using Real = float;
using Vector = Point3D<Real>;
constexpr int degree = 2;  // of the B-splines
constexpr BoundaryType boundary = BOUNDARY_NEUMANN;

/// Points with normals, six numbers each.
class Samples : public OrientedPointStreamWithData<Real, Vector> {
 public:
  Samples(const float* values, std::size_t count) : values_(values), count_(count) {}
  void reset() override { at_ = 0; }
  bool nextPoint(OrientedPoint3D<Real>& point, Vector& data) override {
    if (at_ == count_) return false;
    for (int k = 0; k < 3; ++k) {
      point.p[k] = values_[6 * at_ + k];
      point.n[k] = values_[6 * at_ + 3 + k];
      data[k] = 0;
    }
    ++at_;
    return true;
  }

 private:
  const float* values_;
  std::size_t count_, at_ = 0;
};

std::vector<float> positions;
std::vector<std::uint32_t> triangles;

}  // namespace

extern "C" {

/// `values`: `count` points and outward normals, six numbers each, in the unit cube. `depth` of the octree: cells are 2^-depth wide.
/// `weight` of the points against the gradients; 0 is not screened, 4 what its authors advise. Returns the number of vertices.
int poisson_reconstruct(const float* values, int count, int depth, float weight) {
  constexpr int full_depth = 5, iterations = 8;
  constexpr double accuracy = 1e-3;
  constexpr float samples_per_node = 1.5f;
  using Tree = Octree<Real>;
  using Density = Tree::DensityEstimator<WEIGHT_DEGREE>;
  positions.clear();
  triangles.clear();
  Reset<Real>();
  OctNode<TreeNodeData>::SetAllocator(MEMORY_ALLOCATOR_BLOCK_SIZE);
  Tree tree;
  tree.threads = 1;
  std::vector<Tree::PointSample> samples;
  Samples stream(values, static_cast<std::size_t>(count));
  tree.init<Vector>(stream, depth, false, samples, static_cast<std::vector<ProjectiveData<Vector, Real>>*>(nullptr));
  for (auto& sample : samples) sample.sample.data.n *= Real(-1);  // it wants them inward
  tree.resetNodeIndices();

  Real weight_sum = 0;
  SparseNodeData<Vector, NORMAL_DEGREE> normals;
  {
    Density* density = tree.setDensityEstimator<WEIGHT_DEGREE>(samples, depth - 2, samples_per_node);
    normals = tree.setNormalField<NORMAL_DEGREE>(samples, *density, weight_sum, boundary == BOUNDARY_NEUMANN);
    delete density;
  }
  std::vector<int> moved;
  tree.inalizeForBroodedMultigrid<std::max(NORMAL_DEGREE, degree), degree, boundary>(
      std::min(full_depth, depth), Tree::HasNormalDataFunctor<NORMAL_DEGREE>(normals), &moved);
  normals.remapIndices(moved);

  auto constraints = tree.initDenseNodeData<degree>();
  tree.addFEMConstraints<degree, boundary, NORMAL_DEGREE, boundary>(
      FEMVFConstraintFunctor<NORMAL_DEGREE, boundary, degree, boundary>(1., 0.), normals, constraints, depth);
  Tree::InterpolationInfo<false> screening(tree, samples, Real(0.5), 1, weight * weight_sum, Real(0));
  if (weight > 0) tree.addInterpolationConstraints<degree, boundary>(screening, constraints, depth);
  Tree::SolverInfo solver;
  solver.cgDepth = 0;
  solver.iters = iterations;
  solver.cgAccuracy = accuracy;
  solver.verbose = false;
  solver.showResidual = false;
  solver.lowResIterMultiplier = 1;
  auto solution = tree.solveSystem<degree, boundary>(FEMSystemFunctor<degree, boundary>(0, 1., 0),
                                                     weight > 0 ? &screening : nullptr, constraints, depth, solver);
  double sum = 0, weights = 0;
  {
    Tree::MultiThreadedEvaluator<degree, boundary> evaluate(&tree, solution, 1);
    for (auto& [node, sample] : samples) {
      if (sample.weight <= 0) continue;
      weights += sample.weight;
      sum += evaluate.value(sample.data.p / sample.weight, 0, node) * sample.weight;
    }
  }
  CoredVectorMeshData<PlyVertex<Real>> mesh;
  tree.getMCIsoSurface<degree, boundary, WEIGHT_DEGREE, DATA_DEGREE>(
      static_cast<Density*>(nullptr), static_cast<SparseNodeData<ProjectiveData<Vector, Real>, DATA_DEGREE>*>(nullptr),
      solution, static_cast<Real>(sum / weights), mesh, true, true, false);

  mesh.resetIterator();
  const auto keep = [](const PlyVertex<Real>& vertex) {
    for (int k = 0; k < 3; ++k) positions.push_back(vertex.point[k]);
  };
  for (const auto& vertex : mesh.inCorePoints) keep(vertex);
  const int first = static_cast<int>(mesh.inCorePoints.size());
  for (int i = 0; i < mesh.outOfCorePointCount(); ++i) {
    PlyVertex<Real> vertex;
    mesh.nextOutOfCorePoint(vertex);
    keep(vertex);
  }
  std::vector<CoredVertexIndex> corners;
  while (mesh.nextPolygon(corners)) {
    for (const auto& corner : corners)
      triangles.push_back(static_cast<std::uint32_t>(corner.inCore ? corner.idx : corner.idx + first));
  }
  return static_cast<int>(positions.size() / 3);
}

/// Of the last reconstruction, until the next: three numbers a vertex.
const float* poisson_positions() {
  return positions.data();
}
int poisson_triangle_count() {
  return static_cast<int>(triangles.size() / 3);
}
/// Three vertices a triangle, counter-clockwise from outside.
const std::uint32_t* poisson_triangles() {
  return triangles.data();
}
}
