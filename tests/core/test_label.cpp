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

TEST_CASE("what programs add to names is no part of a label") {
  CHECK(clean_label("leg<1>") == "leg");
  CHECK(clean_label("deskcorner(Clone)") == "deskcorner");
  CHECK(clean_label("predefinito(33b9bc94-cd6b-4f12-9c3e-0123456789ab)") == "predefinito");
  CHECK(clean_label("33b9bc94-cd6b-4f12-9c3e-0123456789ab") == "part");
  CHECK(clean_label("Component#12") == "Component");
  CHECK(clean_label("door (left)") == "door (left)");
}

TEST_CASE("a name that only an exporter gave has no kind, and what it adds to one does not count") {
  for (const char* name : {"Component", "RootNode", "Object", "mesh_primitive", "Node 12", "Sketchfab_model",
                           "defaultMaterial", "33b9bc94-cd6b-4f12-9c3e-0123456789ab", "0a1b2c3d4e"}) {
    CAPTURE(name);
    CHECK(grouping_key(name) == "part");
  }
  CHECK(grouping_key("leg_mesh") == "leg");
  CHECK(grouping_key("leg_LOD0") == "leg");
  CHECK(grouping_key("Mesh leg left 3a8e77d1") == "leg");
}

TEST_CASE("direction words of other languages are stripped for grouping") {
  for (const char* name : {"Bein vorne links", "Bein hinten rechts", "Vorderbein", "hinteres Bein", "BEIN_VL"}) {
    CHECK_MESSAGE(grouping_key(name) == "bein", name);
  }
  for (const char* name : {"pied avant gauche", "Pied arri\xc3\xa8re droit", "PIED ARRI\xc3\x88RE"}) {
    CHECK_MESSAGE(grouping_key(name) == "pied", name);
  }
  for (const char* name : {"pata delantera izquierda", "Pata trasera derecha"}) CHECK(grouping_key(name) == "pata");
  for (const char* name : {"gamba anteriore sinistra", "gamba posteriore destra"}) CHECK(grouping_key(name) == "gamba");
  for (const char* name : {"左前腿", "右后腿", "右後腿", "腿"}) CHECK(grouping_key(name) == "腿");
  for (const char* name : {"左の脚", "右前脚", "後ろ脚"}) CHECK_MESSAGE(grouping_key(name).ends_with("脚"), name);
}

TEST_CASE("names that differ by a letter or a small word are alike") {
  CHECK(alike("lega", "legb"));
  CHECK(alike("side", "sideboard"));
  CHECK_FALSE(alike("door", "drawer"));
  CHECK_FALSE(alike("leg", "top"));
  CHECK_FALSE(alike("ab", "ac"));
}

TEST_CASE("names are shown as given where they tell parts apart") {
  const auto names = [](const std::vector<std::string>& given, const std::vector<Vec3>& centres) {
    std::vector<std::string> labels, out;
    for (const std::string& name : given) labels.push_back(clean_label(name));
    for (const PartName& name : name_parts(labels, centres, given)) out.push_back(name.name);
    return out;
  };
  using V = std::vector<std::string>;
  CHECK(names({"Apron long 1", "Apron long 2", "Top"}, {{0, 0, 1}, {0, 0, -1}, {0, 1, 0}}) ==
        V{"Apron long 1", "Apron long 2", "Top"});
  CHECK(names({"Leg.001", "Leg.002"}, {{1, 0, 0}, {-1, 0, 0}}) == V{"left leg", "right leg"});
  CHECK(names({"doorleft", "doorleft"}, {{0, 1, 0}, {0, 0, 0}}) == V{"doorleft (top)", "doorleft (bottom)"});
  CHECK(names({"deskcorner(Clone)", "Bein vorne links"}, {{1, 0, 0}, {-1, 0, 0}}) ==
        V{"deskcorner", "Bein vorne links"});
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

TEST_CASE("panels of different heights stand left, center and right; six legs are rows and columns") {
  using V = std::vector<std::string>;
  CHECK(ids(V(3, "side"), {{-0.9, 0.3, 0}, {0, -0.2, 0}, {0.9, 0.3, 0}}) ==
        V{"side_right", "side_center", "side_left"});
  CHECK(
      ids(V(6, "leg"), {{1, 0, 0.5}, {0, 0, 0.5}, {-1, 0, 0.5}, {1, 0, -0.5}, {0, 0, -0.5}, {-1, 0, -0.5}}) ==
      V{"leg_front_left", "leg_front_center", "leg_front_right", "leg_back_left", "leg_back_center", "leg_back_right"});
}

TEST_CASE("more than five parts in a line, or parts that words do not tell apart, are numbered; ids never collide") {
  using V = std::vector<std::string>;
  CHECK(ids(V(6, "rung"), {{0, 5, 0}, {0, 4, 0}, {0, 3, 0}, {0, 2, 0}, {0, 1, 0}, {0, 0, 0}}) ==
        V{"rung_1", "rung_2", "rung_3", "rung_4", "rung_5", "rung_6"});
  CHECK(ids(V(2, "a"), {{0, 0, 0}, {0, 0, 0}}) == V{"a_1", "a_2"});
  CHECK(ids({"leg", "leg", "leg left"}, {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}}) ==
        V{"leg_left", "leg_right", "leg_left_2"});
}
