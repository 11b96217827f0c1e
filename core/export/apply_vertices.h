// Rewrites the vertex data of edited primitives.
//
// An accessor may serve several primitives, in several roles. Every use of it is listed with the vertices that it needs
// (by the primitive's indices) and what should become of them. As long as the uses of one vertex agree, they share a
// copy; where they do not, further copies of the accessor are appended. So primitives that share one vertex buffer
// without sharing vertices (one buffer a model, as many exporters write it) are patched in place, without growth.
#pragma once

#include "core/export/apply_mesh.h"
#include "core/shape/shape.h"

namespace parsel::apply {

/// Positions, normals, tangents and the deltas of morph targets that the primitives have; then the morph targets that
/// they get. Existing deltas become exact differences of deformed vertices, D(p + δ) − D(p), so that every target is
/// right at weight 1. Data that cannot be patched where it is (shared bytes, sparse, quantised, outside of the binary
/// chunk) is appended as plain floats. Attributes that cannot follow (gltf::lost_attributes()) stay, with a warning; of
/// a primitive that Draco holds as well, the compressed copy goes. Error: positions that cannot be read.
Status write_vertices(gltf::File& file, const MeshEdits& edits, std::vector<Warning>& warnings);

}  // namespace parsel::apply
