#include "core/gallery/gallery.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "core/gallery/model_builder.h"

namespace parsel {
namespace gallery {
Result<GalleryAsset> build_shelf_wall(int part_count);
extern const GalleryModel chair, armchair, bar_stool, dining_table, round_table, desk, bookcase, cabinet, bed, bunk_bed,
    bench, floor_lamp, picket_fence, ceiling_fan, windmill, gazebo, bird_house, ladder, wagon_wheel;
}  // namespace gallery

const std::vector<GalleryModel>& gallery_models() {
  using namespace gallery;
  static const std::vector<GalleryModel> models = {
      chair, armchair,   bar_stool,    dining_table, round_table, desk,   bookcase,   cabinet, bed,        bunk_bed,
      bench, floor_lamp, picket_fence, ceiling_fan,  windmill,    gazebo, bird_house, ladder,  wagon_wheel};
  return models;
}

const GalleryModel* find_gallery_model(std::string_view id) {
  const auto& models = gallery_models();
  const auto found = std::find_if(models.begin(), models.end(), [&](const GalleryModel& m) { return m.id == id; });
  return found == models.end() ? nullptr : &*found;
}

Result<GalleryAsset> build(const GalleryModel& model, const GalleryValues& overrides) {
  const std::string stage = "gallery/" + model.id;
  GalleryValues defaults;
  for (const GalleryParameter& parameter : model.parameters) defaults[parameter.name] = parameter.value;
  GalleryValues values = defaults;
  for (const auto& [name, value] : overrides) {
    const auto found = std::find_if(model.parameters.begin(), model.parameters.end(),
                                    [&, &wanted = name](const GalleryParameter& p) { return p.name == wanted; });
    if (found == model.parameters.end()) {
      return Error{stage, name, "the model has no such parameter", "use one of the parameters that the model lists"};
    }
    if (!(value >= found->min && value <= found->max)) {
      return Error{stage, name, "the value " + std::to_string(value) + " is out of range",
                   "use a value from " + std::to_string(found->min) + " to " + std::to_string(found->max)};
    }
    if (found->unit == "count" && value != std::floor(value)) {
      return Error{stage, name, "a count is a whole number", "round it"};
    }
    values[name] = value;
  }
  gallery::ModelBuilder nominal(model, defaults, nullptr);
  model.layout(nominal);
  gallery::ModelBuilder builder(model, std::move(values), &nominal.sizes());
  model.layout(builder);
  return builder.finish();
}

nlohmann::json gallery_entry(const GalleryModel& model, const GalleryAsset& asset) {
  nlohmann::json requests = nlohmann::json::array();
  for (const GalleryEdit& edit : asset.edits) {
    requests.push_back({{"id", edit.id}, {"request", edit.request}, {"edit", nlohmann::json::parse(edit.json)}});
  }
  return {{"id", model.id},
          {"title", model.title},
          {"file", model.id + ".glb"},
          {"bytes", asset.glb.size()},
          {"parts", asset.parts.size()},
          {"requests", std::move(requests)}};
}

Result<GalleryAsset> scaling_model(int part_count) {
  return gallery::build_shelf_wall(part_count);
}

}  // namespace parsel
