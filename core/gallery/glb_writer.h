// Writes a scene of triangle meshes as a binary glTF 2.0 file, byte for byte the same on every machine.
#pragma once

#include <Eigen/Geometry>
#include <string>
#include <vector>

#include "core/gallery/solid.h"

namespace parsel::gallery {

struct GlbMaterial {
  std::string name;
  Vec3 colour = Vec3::Ones();  ///< linear RGB in [0, 1]
  double roughness = 0.7;
  double metallic = 0.0;
};

struct GlbPrimitive {
  TriangleMesh mesh;  ///< metres
  int material = 0;
};

struct GlbMesh {
  std::string name;
  std::vector<GlbPrimitive> primitives;
};

struct GlbNode {
  std::string name;
  std::string label;  ///< written as extras.label unless empty
  int mesh = -1;      ///< -1: a node that only carries a transform
  Vec3 translation = Vec3::Zero();
  Eigen::Quaterniond rotation = Eigen::Quaterniond::Identity();
  std::vector<int> children;
};

struct GlbScene {
  std::string name;
  std::string generator = "parsel gallery";
  std::vector<GlbMaterial> materials;
  std::vector<GlbMesh> meshes;
  std::vector<GlbNode> nodes;
};

/// Positions are put on a grid of a micrometre and normals on one of 1e-5, so that libraries which differ in the last
/// bit of a sine write the same bytes; equal vertices are merged and triangles without area left out.
std::string write_glb(const GlbScene& scene);

}  // namespace parsel::gallery
