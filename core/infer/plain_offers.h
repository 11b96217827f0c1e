// What geometry and labels alone can offer of a model that nobody has said anything about: width, height, depth, the count
// of each row, the height of the legs, the lean of the back, the thickness of panels. Every offer is a clause of a plain
// request, put into an edit by the same rules (plain_seed.h); what those rules are not certain of is not offered.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "core/propagate/edit_request.h"
#include "core/shape/shape.h"

namespace parsel {

struct PlainOffer {
  std::string title;  ///< "Height", "Shelf count", "Seat thickness"
  EditRequest edit;   ///< passes resolve(); whether it propagates cleanly is not known yet
};

/// At most `most`, the sizes of the whole first; no two of the same edit. Takes milliseconds.
std::vector<PlainOffer> plain_offers(const Shape& shape, std::size_t most = 12);

/// [{"title", "edit": parsel/edit v1}]
nlohmann::json to_json(const std::vector<PlainOffer>& offers);

}  // namespace parsel
