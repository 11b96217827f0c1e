// The gallery: parametric models of furniture and the like, each a labelled GLB with what its generator knows about it.
//
// A model is a function of named parameters. The generator states the parts, the relations between them and, for some
// edits, which parameters express the edited model; tests compare this truth with what core/shape finds and with what
// core/propagate infers. Frame: glTF, metres, +Y up, front towards +Z, own left is +X, standing on y = 0.
#pragma once

#include <functional>
#include <map>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/geometry.h"
#include "core/base/result.h"
#include "core/shape/shape.h"

namespace parsel {

struct GalleryParameter {
  std::string name;
  double value = 0, min = 0, max = 0;  ///< value is the default
  std::string unit;                    ///< "m", "count", "rad" or "ratio"
  std::string description;
};

/// Parameter values by name.
using GalleryValues = std::map<std::string, double, std::less<>>;

struct GalleryPart {
  int node = -1;      ///< glTF node index
  int primitive = 0;  ///< of the node's mesh
  std::string label;  ///< without counters
  Corners corners;    ///< of the part's box in metres, in the order of its local axes
};

/// One relation that the generator put there on purpose. A part is a list of node indices: one node for a real part,
/// several (in the order of the group) for the virtual part that stands for a translation or rotation group.
/// Attachments of a grouped part are those of its virtual part.
struct GalleryRelation {
  RelationKind kind = RelationKind::point;
  std::vector<std::vector<int>>
      parts;      ///< reflection, attachment: two; translation, rotation: the instances in order; ground: one
  int axis = -1;  ///< reflection: global axis across the plane
};

/// An edit whose right answer is known: the model edited at slider value x equals the model built with values(x).
/// Tilted and stretched parts compare by boxes and by vertices alike; where values(x) changes a count, node indices
/// differ and parts are to be matched by label and place.
struct GalleryEdit {
  std::string id;
  std::string request;  ///< in words
  /// Format parsel/edit v1, amounts depend on x in [-0.35, 0.35]. Parts are named node:<index>, groups <label>_group.
  std::string json;
  std::function<GalleryValues(double x)> values;  ///< all parameters that differ from the asset's, within their ranges
};

struct GalleryAsset {
  std::string id;
  std::string glb;
  Frame frame;                     ///< centre and half-diagonal of the bounding box of all parts
  std::vector<GalleryPart> parts;  ///< by node, then primitive
  std::vector<GalleryRelation> relations;
  std::vector<GalleryEdit> edits;
};

namespace gallery {
class ModelBuilder;
}

struct GalleryModel {
  std::string id, title;
  std::vector<GalleryParameter> parameters;
  void (*layout)(gallery::ModelBuilder& builder);
};

/// All models, in the order in which people see them.
const std::vector<GalleryModel>& gallery_models();

/// By id; null when there is none.
const GalleryModel* find_gallery_model(std::string_view id);

/// Builds a model with its default values except for `overrides`. Deterministic. Refuses unknown names and values that
/// are not finite, out of range, or (unit "count") not whole.
Result<GalleryAsset> build(const GalleryModel& model, const GalleryValues& overrides = {});

/// An entry of gallery.json: {"id","title","file","bytes","parts","requests":[{"id","request","edit": parsel/edit
/// v1}]}.
nlohmann::json gallery_entry(const GalleryModel& model, const GalleryAsset& asset);

/// A wall of shelves with exactly `part_count` parts (5 to 1000), to measure how time grows with size. Not in the list.
Result<GalleryAsset> scaling_model(int part_count);

}  // namespace parsel
