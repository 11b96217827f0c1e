#include "core/infer/plain_offers.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <set>

#include "core/infer/plain_part.h"
#include "core/infer/plain_parts.h"
#include "core/infer/plain_seed.h"
#include "core/infer/reading.h"
#include "core/shape/label.h"

namespace parsel {

namespace {

// Shares of the whole's size.
constexpr double on_floor = 0.03;
constexpr double shortest_leg = 0.08;
constexpr double longest_leg = 0.85;
constexpr double back_above = 0.25;  ///< and more is where a back begins
constexpr double back_height = 0.2;  ///< and more is how high it is
constexpr double back_width = 0.4;   ///< and more is how wide it is
constexpr double panel_face = 0.15;  ///< of the largest face of any part, and more is a panel
constexpr std::size_t most_panels = 3;
constexpr std::size_t most_rows = 4;

class Offers {
 public:
  Offers(const Shape& shape, std::size_t most) : facts_(shape), shape_(shape), most_(most) {}

  std::vector<PlainOffer> run() {
    for (const auto& [change, title] :
         {std::pair{Change::width, "Width"}, std::pair{Change::height, "Height"}, std::pair{Change::depth, "Depth"}}) {
      Clause whole;
      whole.change = change;
      whole.whole = whole.names_whole = true;
      offer(title, whole, {});
    }
    rows();
    legs();
    back();
    panels();
    return std::move(offers_);
  }

 private:
  void offer(const std::string& title, const Clause& clause, const std::vector<PartIndex>& parts) {
    if (offers_.size() >= most_) return;
    const Meant meant = mean(facts_, clause, parts);
    if (meant.edits.size() != 1 || !meant.fault.empty()) return;
    std::optional<EditRequest> edit = request_of(shape_, meant.edits.front());
    if (edit && seen_.insert(reading_signature(shape_, edit->seed)).second)
      offers_.push_back({title, std::move(*edit)});
  }
  void offer_of(const std::vector<PartIndex>& parts, Change change, const std::string& quantity) {
    if (parts.empty()) return;
    Clause clause;
    clause.change = change;
    clause.knows_way = change == Change::tilt;
    Noun noun;
    noun.parts = parts;
    noun.plural = true;
    clause.nouns = {noun};
    offer(title_of(parts, quantity), clause, parts);
  }

  bool is_taken(const std::string& title) const {
    return std::any_of(offers_.begin(), offers_.end(), [&](const PlainOffer& other) {
      return other.title.size() == title.size() && other.title.substr(1) == title.substr(1);
    });
  }
  /// "Leg height", "Seat slat count": a part by its name, several by their label, or by what their labels have in common
  /// without their sides.
  std::string title_of(const std::vector<PartIndex>& parts, const std::string& quantity) const {
    const Part& named = shape_.parts[parts.front()];
    std::set<std::string> labels;
    for (const PartIndex p : parts) {
      if (!shape_.parts[p].is_virtual()) labels.insert(shape_.parts[p].label);
      for (const PartIndex member : shape_.parts[p].members) labels.insert(shape_.parts[member].label);
    }
    const std::string& label = *labels.begin();
    std::string base = labels.size() == 1 && grouping_key(label) != "part" ? label : grouping_key(label);
    const bool is_one = parts.size() == 1 && !named.is_virtual();
    if (is_one || base.empty() || base == "part" || is_taken(base + " " + quantity)) base = name_of(shape_, parts[0]);
    std::replace(base.begin(), base.end(), '_', ' ');
    if (base[0] >= 'a' && base[0] <= 'z') base[0] = static_cast<char>(base[0] - 'a' + 'A');
    return base + " " + quantity;
  }

  void rows() {
    std::size_t count = 0;
    for (const PartIndex p : facts_.active()) {
      if (!shape_.parts[p].is_virtual() || count == most_rows) continue;
      const std::size_t before = offers_.size();
      offer_of({p}, Change::count, "count");
      count += offers_.size() - before;
    }
  }

  bool is_leg(PartIndex part) const {
    const PartBox own = facts_.extent(part);
    const double height = facts_.whole().size()[1];
    const double tall = facts_.edges(part)[1];
    const bool upright = tall >= 0.999 * facts_.edges(part).maxCoeff();
    return upright && own.low[1] - facts_.whole().low[1] <= on_floor * height && tall >= shortest_leg * height &&
           tall <= longest_leg * height;
  }
  /// All that stand on the floor, when they are alike: two or more, or a row or ring.
  void legs() {
    std::vector<PartIndex> all;
    for (const PartIndex p : facts_.active()) {
      if (is_leg(p)) all.push_back(p);
    }
    if (all.empty() || (all.size() < 2 && !shape_.parts[all.front()].is_virtual())) return;
    const double tall = facts_.edges(all.front())[1];
    const bool same = std::all_of(all.begin(), all.end(), [&](PartIndex p) {
      return std::abs(facts_.edges(p)[1] - tall) <= on_floor * facts_.whole().size()[1];
    });
    if (same) offer_of(all, Change::length, "height");
  }

  bool is_back(PartIndex part) const {
    const PartBox own = facts_.extent(part);
    const PartBox& whole = facts_.whole();
    const Vec3 e = facts_.edges(part);
    return !shape_.parts[part].is_virtual() && e[1] > 2 * e[2] && own.size()[0] >= back_width * whole.size()[0] &&
           own.centre()[2] < whole.centre()[2] - 0.2 * whole.size()[2] &&
           own.low[1] > whole.low[1] + back_above * whole.size()[1];
  }
  void back() {
    const PartNames names(shape_, word_lists().front());
    const std::vector<Token> word = plain_tokens("back");
    std::vector<PartIndex> parts = names.called(word).parts;
    // Not the apron at the back of a table.
    const double height = facts_.whole().size()[1];
    std::erase_if(parts, [&](PartIndex p) {
      const PartBox own = facts_.extent(p);
      return own.low[1] <= facts_.whole().low[1] + back_above * height || own.size()[1] < back_height * height;
    });
    if (parts.empty()) {
      for (const PartIndex p : facts_.active()) {
        if (is_back(p)) parts.push_back(p);
      }
      if (parts.size() > 1) return;
    }
    if (parts.empty()) return;
    Clause clause;
    clause.change = Change::tilt;
    clause.knows_way = true;
    Noun noun;
    noun.parts = parts;
    noun.plural = noun.is_made_of = true;
    clause.nouns = {noun};
    offer("Lean of the back", clause, parts);
  }

  void panels() {
    struct Panel {
      double face;
      std::vector<PartIndex> parts;
    };
    std::vector<Panel> found;
    double largest = 0;
    for (const auto& set : facts_.mirrored(facts_.active())) {
      const Vec3 e = facts_.edges(set.front());
      const double face = e.prod() / std::max(e.minCoeff(), 1e-9);
      largest = std::max(largest, face);
      if (facts_.thin_axis(set.front())) found.push_back({face, set});
    }
    std::stable_sort(found.begin(), found.end(), [](const Panel& a, const Panel& b) { return a.face > b.face; });
    std::size_t count = 0;
    for (const Panel& panel : found) {
      if (count == most_panels || panel.face < panel_face * largest) return;
      const std::size_t before = offers_.size();
      offer_of(panel.parts, Change::thick, "thickness");
      count += offers_.size() - before;
    }
  }

  const ShapeFacts facts_;
  const Shape& shape_;
  std::size_t most_;
  std::vector<PlainOffer> offers_;
  std::set<std::string> seen_;
};

}  // namespace

std::vector<PlainOffer> plain_offers(const Shape& shape, std::size_t most) {
  return Offers(shape, most).run();
}

nlohmann::json to_json(const std::vector<PlainOffer>& offers) {
  nlohmann::json list = nlohmann::json::array();
  for (const PlainOffer& offer : offers) list.push_back({{"title", offer.title}, {"edit", to_json(offer.edit)}});
  return list;
}

}  // namespace parsel
