// Which bytes of the binary chunk only one accessor reads.
#include <algorithm>
#include <nlohmann/json.hpp>
#include <tuple>

#include "core/export/apply_accessor.h"

namespace parsel::gltf {
namespace {

/// Whether two accessors of one buffer view touch no byte in common.
bool disjoint(const Layout& a, const Layout& b) {
  if (a.end() <= b.begin || b.end() <= a.begin) return true;
  if (a.stride != b.stride) return false;
  const std::size_t shift =
      b.begin >= a.begin ? (b.begin - a.begin) % a.stride : (a.stride - (a.begin - b.begin) % a.stride) % a.stride;
  return shift >= a.element && shift + b.element <= a.stride;  // interleaved
}

}  // namespace

Storage::Storage(const Document& document)
    : document_(document),
      view_accessors_(document.views.size()),
      references_(view_accessors_.size()),
      overlapped_(view_accessors_.size()) {
  count_references(document.json);
  for (std::size_t a = 0; a < document.accessors.size(); ++a) {
    const auto where = layout(document, a);
    layouts_.push_back(where.ok() ? std::optional(*where) : std::nullopt);
    if (where.ok() && where->view) view_accessors_[*where->view].push_back(a);
  }
  std::vector<std::pair<ViewRange, std::size_t>> ranges;
  for (std::size_t v = 0; v < view_accessors_.size(); ++v) {
    if (const auto range = view_range(document, v)) ranges.emplace_back(*range, v);
  }
  std::sort(ranges.begin(), ranges.end(), [](const auto& a, const auto& b) {
    return std::tie(a.first.buffer, a.first.begin, a.second) < std::tie(b.first.buffer, b.first.begin, b.second);
  });
  // In order of their beginnings, a view overlaps an earlier one when it begins before the furthest end so far.
  for (std::size_t i = 1, furthest = 0; i < ranges.size(); ++i) {
    const ViewRange& last = ranges[furthest].first;
    const ViewRange& next = ranges[i].first;
    if (next.buffer == last.buffer && next.begin < last.end) {
      overlapped_[ranges[i].second] = overlapped_[ranges[furthest].second] = true;
    }
    if (next.buffer != last.buffer || next.end > last.end) furthest = i;
  }
}

void Storage::count_references(const nlohmann::json& json) {
  if (json.is_array()) {
    for (const nlohmann::json& value : json) count_references(value);
  } else if (json.is_object()) {
    for (const auto& [key, value] : json.items()) {
      const bool names_view = key == "bufferView" && value.is_number_unsigned();
      const auto view = names_view ? value.get<std::uint64_t>() : references_.size();
      if (view < references_.size()) ++references_[static_cast<std::size_t>(view)];
      count_references(value);
    }
  }
}

bool Storage::is_free(std::size_t view) const {
  return view < references_.size() && references_[view] == 1 && !document_.views[view].extended;
}

bool Storage::can_patch_in_place(std::size_t accessor) const {
  const auto& where = layouts_[accessor];
  if (!where || !where->view || where->buffer != 0 || document_.accessors[accessor].sparse ||
      where->component_type != type_float || !document_.buffers[0].missing.empty()) {
    return false;
  }
  const std::size_t view = *where->view;
  // Images, sparse parts and extensions may read the view in ways of their own.
  if (overlapped_[view] || references_[view] != view_accessors_[view].size() || document_.views[view].extended)
    return false;
  return std::all_of(view_accessors_[view].begin(), view_accessors_[view].end(),
                     [&](std::size_t other) { return other == accessor || disjoint(*where, *layouts_[other]); });
}

}  // namespace parsel::gltf
