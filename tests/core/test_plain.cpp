// Plain requests: what is taken as sure is right, what cannot be known is asked about, nothing is wrong in silence.
#include <doctest/doctest.h>

#include <algorithm>
#include <chrono>
#include <set>

#include "core/base/random.h"
#include "core/infer/plain_words.h"
#include "tests/core/hostile_names.h"
#include "tests/core/plain_measure.h"
#include "tests/core/scripts.h"
#include "tests/core/shape_fixture.h"

using namespace parsel;
using namespace parsel::test;
using nlohmann::json;

namespace {

struct Counts {
  int all = 0, sure = 0, right = 0, ask = 0, asked = 0;
};

Counts measure(const char* file) {
  Counts counts;
  for (const json& entry : json_file(file)) {
    const PlainVerdict verdict = judge(entry);
    const bool ask = entry.value("ask", false);
    ask ? ++counts.ask : ++counts.all;
    if (ask && verdict.right) ++counts.asked;
    if (!ask && verdict.sure) ++counts.sure;
    if (!ask && verdict.sure && verdict.right) ++counts.right;
    INFO(entry["model"].get<std::string>(), ": ", entry["request"].get<std::string>(), ": ", verdict.why);
    CHECK((verdict.right || !verdict.sure));
  }
  MESSAGE(std::string(file), ": of ", counts.all, " plain requests ", counts.sure, " are taken, ", counts.right,
          " of them rightly; ", counts.asked, " of ", counts.ask, " others are asked about");
  return counts;
}

PlainReading read(const std::string& model, const std::string& request, std::vector<std::string> mentioned = {}) {
  const auto reading = read_plainly(gallery_shape(model), {request, std::move(mentioned)});
  REQUIRE_MESSAGE(reading.ok(), (reading.ok() ? "" : reading.error().message()));
  return *reading;
}

std::vector<std::string> words(const std::string& model, const std::string& request) {
  return read(model, request).words;
}

}  // namespace

TEST_CASE("plain requests are read as written down before the reader was") {
  const Counts counts = measure("eval/plain.json");
  CHECK(counts.all + counts.ask >= 200);
  CHECK(counts.sure >= 0.9 * counts.all);
  CHECK(counts.right >= 0.97 * counts.sure);
  CHECK(counts.asked == counts.ask);
}

TEST_CASE("plain requests in other words, written down before they were run") {
  const Counts counts = measure("eval/plain_unseen.json");
  CHECK(counts.sure >= 0.9 * counts.all);
  CHECK(counts.right >= 0.97 * counts.sure);
  CHECK(counts.asked == counts.ask);
}

TEST_CASE("requests that are easily read wrongly are asked about") {
  const Counts counts = measure("eval/plain_traps.json");
  CHECK(counts.asked == counts.ask);
  CHECK(counts.right == counts.all);
}

TEST_CASE("recorded requests: what is taken comes to the expected mesh") {
  int taken = 0, all = 0;
  for (const json& entry : json_file("../prompts/expected.json")) {
    const PlainVerdict verdict = judge_recorded(entry);
    ++all;
    if (verdict.sure) ++taken;
    INFO(entry["model"].get<std::string>(), ": ", entry["request"].get<std::string>(), ": ", verdict.why);
    CHECK((verdict.right || !verdict.sure));
  }
  MESSAGE("of ", all, " recorded requests ", taken, " are taken");
  CHECK(taken >= 30);
}

TEST_CASE("recorded requests: what is taken does what the language model's voted replies do") {
  int both = 0, same = 0;
  for (const json& entry : json_file("../prompts/expected.json")) {
    const std::string model = entry["model"].get<std::string>();
    const Shape& shape = gallery_shape(model);
    const EditWish wish{entry["request"].get<std::string>(), {}};
    const PlainReading reading = read(model, wish.request);
    const auto voted = voted_edit(shape, wish);
    if (!reading.sure || !voted) continue;
    ++both;
    const bool form =
        reading_signature(shape, voted->seed) == reading_signature(shape, reading.edits.front().statements);
    const double distance = edit_distance(shape, edit_of(shape, reading), *voted);
    if (form || distance <= same_mesh) ++same;
    INFO(model, ": ", wish.request, ": ", reading.words.front(), ", off by ", distance);
    CHECK((form || distance <= same_mesh));
  }
  MESSAGE("of ", both, " requests that both read, ", same, " come to the same seeds or mesh");
  CHECK(both >= 30);
}

TEST_CASE("every word counts") {
  for (const std::string request : {"make it wider", "make it nicely wider", "make it wider for grandmother"}) {
    CAPTURE(request);
    CHECK(read("chair", request).sure == (request == "make it wider"));
  }
  const PlainReading reading = read("chair", "make the seat wider for grandmother");
  CHECK_FALSE(reading.sure);
  CHECK(reading.unused == std::vector<std::string>{"grandmother"});
  REQUIRE(reading.words.size() == 1);  // the nearest
  CHECK(reading.words[0] == "widen seat about its centre, left and right");
}

TEST_CASE("what may be meant is offered") {
  CHECK(words("floor_lamp", "tilt the shade").size() == 4);
  CHECK(words("desk", "move the drawer out").size() == 3);
  CHECK(words("chair", "make it 10 wider") ==
        std::vector<std::string>{"widen seat about its centre, left and right, by 10 cm",
                                 "widen seat about its centre, left and right, to 110 %"});
  CHECK(words("armchair", "only the left arm").size() > 1);
  CHECK(words("chair", "make it nicer").empty());
  CHECK(words("chair", "make the seat 40 cm wide and the seat 50 cm wide") ==
        std::vector<std::string>{"narrow seat about its centre, left and right, to 40 cm",
                                 "widen seat about its centre, left and right, to 50 cm"});
}

TEST_CASE("of what there shall be more, where nothing is called so, is asked with every row and ring") {
  for (const char* request : {"two more shelves", "add two spindles", "make it two boards more"}) {
    CAPTURE(request);
    const PlainReading reading = read("chair", request);
    CHECK_FALSE(reading.sure);
    REQUIRE(reading.edits.size() == 1);
    CHECK(reading.edits.front().statements.front().op == Op::change_count);
    REQUIRE(reading.edits.front().target);
    CHECK(reading.edits.front().target->how_much.value == 2);
  }
  const PlainReading fewer = read("bookcase", "remove one plank");
  CHECK_FALSE(fewer.sure);
  REQUIRE(fewer.edits.size() == 1);
  CHECK(fewer.edits.front().target->how_much.value == -1);
  CHECK(words("chair", "more comfortable").empty());
  CHECK(words("chair", "more").empty());
}

TEST_CASE("what may be said of one thing or of two is asked about") {
  CHECK(read("bed", "bigger and smaller pillows").reason == "it asks for more and for less");
  CHECK(read("chair", "Sitz tiefer").words.size() == 2);  // German for lower and for deeper
  CHECK(read("chair", "tiefer").sure);
}

TEST_CASE("an unclear reading is counted as unclear, an unsure one as split") {
  const Shape& shape = gallery_shape("chair");
  const auto outcome = [&](const char* request) { return as_inference(shape, read("chair", request)).seed.outcome; };
  CHECK(outcome("wider") == SeedVote::Outcome::decided);
  CHECK(outcome("make it 10 wider") == SeedVote::Outcome::split);
  CHECK(outcome("paint it red") == SeedVote::Outcome::unclear);
  const json written = to_json(shape, read("chair", "make the legs 10 cm longer"));
  CHECK(written["seed"]["outcome"] == "decided");
  CHECK(written["plain"]["sure"] == true);
  CHECK(written["plain"]["readings"][0]["edit"] == written["edit"]);
  const json& target = written["plain"]["readings"][0]["target"];
  CHECK(target["part"] == "leg_front_left");
  CHECK(target["by"].get<double>() == doctest::Approx(0.1));
  CHECK(target["x"].get<double>() == doctest::Approx(0.1 / 0.43).epsilon(0.01));
}

TEST_CASE("what a reading gives up is told: mirror images, and joints along which something slides") {
  const Shape& shape = gallery_shape("bed");
  const PlainReading reading = read("bed", "raise the headboard");
  REQUIRE(reading.sure);
  const json written = to_json(shape, reading);
  std::set<std::string> given_up, kept;
  for (const json& relation : written["relations"])
    (relation["keep"].get<bool>() ? kept : given_up).insert(relation["relation"].get<std::string>());
  const auto& disabled = written["edit"]["disabled"];
  CHECK(given_up == std::set<std::string>(disabled.begin(), disabled.end()));
  CHECK(std::any_of(given_up.begin(), given_up.end(),
                    [&](const std::string& id) { return !shape.relations[*shape.find_relation(id)].is_symmetry(); }));
  // Of joints only those that some reading gives up are listed.
  for (const std::string& id : kept) CHECK(shape.relations[*shape.find_relation(id)].is_symmetry());
}

// A size or a move has one slider, whatever is said: steeper, its search would look where nothing is left of a part, and
// who wants to go on past its end stretches it. Counts go in steps whose slope is fixed when the layer is made.
TEST_CASE("a size is the slider's value itself, however far that is; a count lies within its range") {
  const auto edit = [](const char* model, const char* request) {
    const PlainReading reading = read(model, request);
    REQUIRE(reading.sure);
    return reading.edits[0];
  };
  for (const auto& [request, x] : std::vector<std::pair<const char*, double>>{
           {"make the table 10% longer", 0.1}, {"make the table twice as long", 1}, {"half as long", 0.5}}) {
    const PlainEdit sized = edit("dining_table", request);
    CHECK(sized.statements[0].amount.text() == (x == 0.5 ? "-x" : "x"));
    CHECK(sized.target->x == doctest::Approx(x).epsilon(1e-3));
  }
  CHECK(edit("ladder", "add four rungs").statements[0].amount.text() == "17*x");
  for (const auto& [request, pieces] :
       std::vector<std::pair<const char*, int>>{{"add four rungs", 10}, {"two rungs less", 4}, {"eight rungs", 8}}) {
    const PlainReading reading = read("ladder", request);
    REQUIRE(reading.sure);
    const auto found = propagate(gallery_shape("ladder"), edit_of(gallery_shape("ladder"), reading));
    REQUIRE(found.ok());
    const double x = reading.edits[0].target->x;
    CHECK(x <= found->program.layers[0].parameter.max);
    const State state = Evaluator(found->program, gallery_shape("ladder"))({x});
    const auto group = gallery_shape("ladder").find_relation("t1");
    REQUIRE(group);
    CHECK(state.groups[*group].instances.size() == static_cast<std::size_t>(pieces));
  }
}

TEST_CASE("a wish that cannot be asked is refused as for prompts") {
  const Shape& shape = gallery_shape("chair");
  CHECK_FALSE(read_plainly(shape, {" ", {}}).ok());
  CHECK_FALSE(read_plainly(shape, {"wider", {"lid"}}).ok());
  CHECK_FALSE(read_plainly(shape, {std::string(5000, 'a'), {}}).ok());
}

TEST_CASE("slips of the hand, not other words") {
  CHECK(misspelling("teh", "the") == 1);
  CHECK(misspelling("tallr", "taller") == 1);
  CHECK(misspelling("drawar", "drawer") == 2);
  CHECK(misspelling("flower", "lower") == 3);
  CHECK(misspelling("thing", "thin") == 3);
  CHECK(misspelling("paint", "point") == 3);
  CHECK(misspelling("chair", "stool") == 4);
}

TEST_CASE("numbers, signs and letters of other scripts") {
  const auto said = [](const char* text) {
    std::string joined;
    for (const Token& token : plain_tokens(text)) joined += token.text + "|";
    return joined;
  };
  CHECK(said("10cm wider.") == "10|cm|wider|");
  CHECK(said("1,5 m, höher!") == "1.5|m|,|hoher|");
  CHECK(said("it's 8\" \xe2\x80\x93 wide") == "its|8|\"|wide|");
  CHECK(said("-5 cm") == "-|5|cm|");
  CHECK(said("\xff\xfe").empty());
  for (const Script& script : scripts) {
    const auto reading = read_plainly(gallery_shape("chair"), {script.request, {}});
    if (reading.ok()) CHECK_FALSE(reading->sure);
  }
}

TEST_CASE("words in any order and from hostile names break nothing, and stay quick") {
  std::vector<std::string> all = {"seat", "back", "legs", "left", "the",   "of", "front",
                                  "10",   "cm",   "and",  ",",    "twice", "as"};
  for (const auto& [phrase, meanings] : word_lists()[0].phrases) all.push_back(phrase);
  Random random(7);
  for (int round = 0; round < 400; ++round) {
    std::string request;
    const auto length = 1 + random.below(9);
    for (std::uint64_t i = 0; i < length; ++i) request += all[random.below(all.size())] + " ";
    CAPTURE(request);
    const auto before = std::chrono::steady_clock::now();
    const auto reading = read_plainly(gallery_shape(round % 2 == 0 ? "chair" : "desk"), {request, {}});
    if (!reading.ok()) continue;
    const Shape& shape = gallery_shape(round % 2 == 0 ? "chair" : "desk");
    for (const PlainEdit& edit : reading->edits) CHECK(resolve({edit.statements, {}, edit.hints}, shape).ok());
    CHECK(std::chrono::steady_clock::now() - before < std::chrono::seconds(2));
  }
}

TEST_CASE("parts may be called anything") {
  const Shape tame = fixture::shape(fixture::slat_chair(5));
  for (const std::string& name : hostile_names) {
    CAPTURE(name);
    Shape shape = tame;
    shape.name = name;
    for (Part& part : shape.parts) part.name = part.label = name;
    for (const char* request : {"wider", "make the legs longer", "raise it", "thicker part"}) {
      const auto reading = read_plainly(shape, {request, {}});
      REQUIRE(reading.ok());
      CHECK_NOTHROW(to_json(shape, *reading).dump());
    }
  }
}

TEST_CASE("a part's name that is a verb or a side is understood or asked about") {
  auto parts = fixture::slat_chair(5);
  for (auto& part : parts) {
    if (part.name == "seat") part.name = "stand";
  }
  const Shape shape = fixture::shape(parts);
  REQUIRE(shape.find_part("stand"));
  const auto sure_of = [&](const char* request) {
    const auto reading = read_plainly(shape, {request, {}});
    REQUIRE(reading.ok());
    return reading->sure ? reading->words.front() : "";
  };
  CHECK(sure_of("make the stand wider") == "widen stand about its centre, left and right");
  CHECK(sure_of("stand") == "");
  CHECK(sure_of("stand it up") == "");
  CHECK(sure_of("back") == "");
  CHECK(sure_of("move the stand back") == "move stand backwards");
}
