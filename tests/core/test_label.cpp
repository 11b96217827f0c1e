#include <doctest/doctest.h>

#include <string>
#include <vector>

#include "core/shape/label.h"

using namespace parsel;

namespace {

std::vector<std::string> ids(const std::vector<std::string>& labels, const std::vector<Vec3>& centres) {
  std::vector<std::string> out;
  for (const PartName& name : name_parts(labels, centres)) out.push_back(name.id);
  return out;
}

}  // namespace

TEST_CASE("counters are not part of a label, words are") {
  CHECK(clean_label("leg.001") == "leg");
  CHECK(clean_label("Leg 3") == "Leg");
  CHECK(clean_label("leg_12_L") == "leg");
  CHECK(clean_label("leg (2)") == "leg");
  CHECK(clean_label("table_R.002") == "table");
  CHECK(clean_label("rail") == "rail");
  CHECK(clean_label("door") == "door");
  CHECK(clean_label("__shelf") == "shelf");
  CHECK(clean_label("") == "part");
  CHECK(clean_label("0042") == "part");
  CHECK(clean_label("a\x01\nb") == "a b");
  CHECK(clean_label(std::string(500, 'x')).size() == 64);
}

TEST_CASE("direction words are stripped for grouping in any position and case, glued or not") {
  CHECK(grouping_key("leftwall") == grouping_key("rightwall"));
  CHECK(grouping_key("legFrontLeft") == grouping_key("rightbackleg"));
  CHECK(grouping_key("legfrontleft") == "leg");
  CHECK(grouping_key("Top Beam") == grouping_key("bottom beam"));
  CHECK(grouping_key("LEFT_COLUMN") == "column");
  CHECK(grouping_key("upper-left door") == "door");
  CHECK(grouping_key("handle L") == "handle");
  // What is nothing but a direction is a name: the back of a chair is not its top.
  CHECK(grouping_key("back") == "back");
  CHECK(grouping_key("top") == "top");
  CHECK(grouping_key("seat") == "seat");
}

TEST_CASE("ids are stable slugs") {
  CHECK(slug("Back Slat") == "back_slat");
  CHECK(slug("  a--b__c ") == "a_b_c");
  CHECK(slug("\xe8\x85\xbf") == "part");
}

TEST_CASE("parts that share a label get direction words by their arrangement") {
  using V = std::vector<std::string>;
  const V four(4, "leg");
  // +x is the asset's left, +z its front.
  CHECK(ids(four, {{1, 0, 1}, {-1, 0, 1}, {1, 0, -1}, {-1, 0, -1}}) ==
        V{"leg_front_left", "leg_front_right", "leg_back_left", "leg_back_right"});
  CHECK(ids(four, {{-3, 0, 0}, {-1, 0, 0}, {1, 0, 0}, {3, 0, 0}}) ==
        V{"leg_right", "leg_right_center", "leg_left_center", "leg_left"});
  CHECK(ids({"shelf", "shelf", "shelf"}, {{0, 0, 0}, {0, 1, 0}, {0, 2, 0}}) ==
        V{"shelf_bottom", "shelf_center", "shelf_top"});
  CHECK(ids({"leg", "seat", "leg"}, {{1, 0, 0}, {0, 1, 0}, {-1, 0, 0}}) == V{"leg_left", "seat", "leg_right"});
  CHECK(name_parts(four, {{1, 0, 1}, {-1, 0, 1}, {1, 0, -1}, {-1, 0, -1}})[0].name == "front left leg");
}

TEST_CASE("more than five parts, or parts that words do not tell apart, are numbered; ids never collide") {
  using V = std::vector<std::string>;
  CHECK(ids(V(6, "rung"), {{0, 5, 0}, {0, 4, 0}, {0, 3, 0}, {0, 2, 0}, {0, 1, 0}, {0, 0, 0}}) ==
        V{"rung_1", "rung_2", "rung_3", "rung_4", "rung_5", "rung_6"});
  CHECK(ids(V(2, "a"), {{0, 0, 0}, {0, 0, 0}}) == V{"a_1", "a_2"});
  CHECK(ids({"leg", "leg", "leg left"}, {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}}) ==
        V{"leg_left", "leg_right", "leg_left_2"});
}
