#include "core/edit/program.h"

#include <doctest/doctest.h>

#include "core/base/random.h"
#include "core/base/text.h"
#include "core/edit/program_fields.h"
#include "core/edit/readable.h"
#include "hand_shapes.h"
#include "tests/core/golden.h"

using namespace parsel;
using nlohmann::json;

namespace {

json small_program() {
  return json::parse(R"({"format":"parsel/program","version":1,"shape":{"name":"pair","sha256":"00ff"},"layers":[
    {"request":"widen","parameter":{"name":"x1","min":-0.35,"max":0.35,"value":0.1},
     "statements":[
       {"op":"scale_1d","part":"seat","feature":[0,1,0],"origin":{"part":"seat","at":[0,0,-1]},"direction":[1,0,0],
        "amount":"x1/2","why":{"kind":"seed","relations":[]}},
       {"op":"rotate","part":"leg","feature":[0,0,0],"origin":[0,0.5,0],"axis":{"part":"seat","axis":2},"amount":"pi*x1"},
       {"op":"keep_fixed","part":"seat"}],
     "relations":[{"id":"a1","status":"held","worst":1.2e-9,"proof":"certified"}]}]})");
}

/// Program → JSON → program is compared as JSON text, which holds everything.
std::string dump(const Program& program) {
  return to_json(program).dump();
}

Program read(const json& file) {
  Result<Program> program = program_from_json(file);
  REQUIRE_MESSAGE(program.ok(), program.error().message());
  return *program;
}

Program read_text(const std::string& text) {
  Result<Program> program = program_from_text(text);
  REQUIRE_MESSAGE(program.ok(), program.error().message() << "\n" << text);
  return *program;
}

Error json_error(const json& file) {
  const Result<Program> program = program_from_json(file);
  REQUIRE_FALSE(program.ok());
  CHECK(program.error().stage == "edit/program");
  CHECK_FALSE(program.error().fix.empty());
  return program.error();
}

template <class Change>
Error refused(Change change) {
  json file = small_program();
  change(file);
  return json_error(file);
}

Error text_error(const std::string& text) {
  const Result<Program> program = program_from_text(text);
  REQUIRE_FALSE(program.ok());
  CHECK(program.error().stage == "edit/program");
  return program.error();
}

bool mentions(const Error& error, const std::string& words) {
  return error.message().find(words) != std::string::npos;
}

const std::string head = "parsel program 1\nshape \"pair\" \"00ff\"\n";
const std::string layer_line = "layer \"\": x1 = 0 in [-0.5, 0.5]\n";

/// Names with everything that has a meaning somewhere: quotes, commas, comments, control characters, other scripts.
std::string random_name(Random& random) {
  static const std::vector<std::string> bits = {"seat", "_", "left", "\"", "\\",      "#",    ",",      ")",
                                                "(",    " ", "\n",   "\t", "é",       "座",   "𝄞",      "0",
                                                "\x01", "'", "/",    "~",  "amount=", "\x7f", "because"};
  std::string name;
  for (std::uint64_t i = 0, n = 1 + random.below(6); i < n; ++i) name += bits[random.below(bits.size())];
  return name;
}

double random_number(Random& random) {
  const double v = random.uniform(-2, 2);
  return random.below(2) == 0 ? v : std::round(v * 100) / 100;
}

Vec3 random_vector(Random& random) {
  return {random_number(random) + 3, random_number(random), random_number(random)};
}

LocalTriple random_triple(Random& random) {
  LocalTriple triple{};
  for (int& i : triple) i = static_cast<int>(random.below(3)) - 1;
  return triple;
}

PointReference random_point(Random& random) {
  if (random.below(2) == 0) return random_vector(random);
  return PartPoint{random_name(random), random_triple(random)};
}

DirectionReference random_direction(Random& random) {
  if (random.below(2) == 0) return random_vector(random);
  return PartAxis{random_name(random), static_cast<int>(random.below(3))};
}

Amount random_amount(Random& random) {
  static const std::vector<std::string> texts = {"x1",
                                                 "-x1/3 + 0.98*x2^2",
                                                 "floor(6.1*sqrt(abs(0.1*x1 - 0.4)))",
                                                 "2*atan2(x1, 1 + sqrt(1 - x1^2))",
                                                 "min(x1, max(x2, 0.25))",
                                                 "pi*x1/180 + 0.12345678901234567",
                                                 "1/(1 + x1) - 1",
                                                 "0",
                                                 "(x1 - 1)*(x2 + 2)*3.5"};
  return *parse_amount(texts[random.below(texts.size())]);
}

Statement random_statement(Random& random) {
  Statement s;
  s.op = static_cast<Op>(random.below(9));
  (is_geometric(s.op) ? s.part : s.relation) = random_name(random);
  if (is_geometric(s.op) && s.op != Op::keep_fixed) s.feature = random_triple(random);
  if (needs_origin(s.op)) s.origin = random_point(random);
  if (needs_direction(s.op)) s.direction = random_direction(random);
  if (needs_normal(s.op)) s.normal = random_direction(random);
  if (!is_geometric(s.op)) s.anchor = static_cast<Anchor>(random.below(4));
  if (s.op != Op::keep_fixed) s.amount = random_amount(random);
  if (random.below(2) == 0) {
    s.why = Why{static_cast<WhyKind>(random.below(6)), {}};
    for (std::uint64_t i = random.below(4); i > 0; --i) s.why->relations.push_back(random_name(random));
  }
  return s;
}

Program random_program(Random& random) {
  Program program;
  if (random.below(8) != 0) program.shape_name = random_name(random);
  program.shape_sha256 = random.below(2) == 0 ? "" : std::string(64, 'a');
  for (std::uint64_t l = random.below(4); l > 0; --l) {
    Layer layer;
    layer.request = random.below(4) == 0 ? "" : random_name(random);
    layer.parameter = {"x" + std::to_string(l), random_number(random), random_number(random), random_number(random)};
    for (std::uint64_t i = random.below(6); i > 0; --i) layer.statements.push_back(random_statement(random));
    for (std::uint64_t i = random.below(4); i > 0; --i) {
      layer.relations.push_back({random_name(random),
                                 static_cast<RelationStatus>(random.below(3)),
                                 random.unit() * 1e-7,
                                 static_cast<Proof>(random.below(2)),
                                 {}});
    }
    program.layers.push_back(std::move(layer));
  }
  return program;
}

}  // namespace

TEST_CASE("random programs go through JSON and text without loss") {
  Random random(9);
  for (int round = 0; round < 100; ++round) {
    const Program program = random_program(random);
    const std::string before = dump(program);
    CHECK(dump(read(json::parse(before))) == before);
    const std::string text = to_text(program);
    CAPTURE(text);
    const Program back = read_text(text);
    CHECK(dump(back) == before);
    CHECK(to_text(back) == text);
  }
}

TEST_CASE("the golden programs go through the text form without loss") {
  for (const auto& vector : golden("program_vectors.json")["cases"]) {
    const Program program = read(vector["program"]);
    CHECK(dump(read_text(to_text(program))) == dump(program));
  }
}

TEST_CASE("the text form reads like the paper's figure 2") {
  const std::string text = to_text(read(small_program()));
  CHECK(text ==
        "parsel program 1\n"
        "shape \"pair\" \"00ff\"\n"
        "\n"
        "layer \"widen\": x1 = 0.1 in [-0.35, 0.35]\n"
        "  scale_1d(\"seat\", amount=0.5*x1, origin=point(\"seat\", 0, 0, -1), direction=(1, 0, 0), feature=(0, 1, 0)) "
        "because "
        "seed\n"
        "  rotate(\"leg\", amount=pi*x1, origin=(0, 0.5, 0), axis=axis(\"seat\", 2))\n"
        "  keep_fixed(\"seat\")\n"
        "  relation \"a1\": held, worst 1.2e-09, certified\n");
}

TEST_CASE("a sampled report says how finely, in JSON and in text") {
  json file = small_program();
  json& report = file["layers"][0]["relations"][0];
  report["proof"] = "sampled";
  report["samples"] = 257;
  const Program program = read(file);
  CHECK(program.layers[0].relations[0].samples == 257);
  CHECK(to_json(program)["layers"][0]["relations"][0]["samples"] == 257);
  const Result<Program> again = program_from_text(to_text(program));
  REQUIRE(again.ok());
  CHECK(to_json(*again) == to_json(program));
  for (const json& wrong : {json(0), json(2.5), json(1e9), json("257")}) {
    json bad = file;
    bad["layers"][0]["relations"][0]["samples"] = wrong;
    CHECK(program_from_json(bad).error().place == "/layers/0/relations/0/samples");
  }
  report["proof"] = "certified";
  CHECK(program_from_json(file).error().place == "/layers/0/relations/0/samples");
}

TEST_CASE("text is written by hand: comments, blanks, order of fields, line ends") {
  const Program program = read_text(
      "# a program\r\n\r\n  parsel   program 1 # first\r\nshape\"pair\" \"\"\r\n"
      "layer \"a # b\" : x1=0 in[-1,1]\r\n"
      "shear( \"seat\" , normal = ( 0,1,0 ),direction=axis(\"leg\",0),amount = min( x1 , 1 ) ,origin=(0,0,0))because "
      "group \"t1\" , \"a1\" # done\r\n");
  REQUIRE(program.layers.size() == 1);
  CHECK(program.layers[0].request == "a # b");
  REQUIRE(program.layers[0].statements.size() == 1);
  const Statement& s = program.layers[0].statements[0];
  CHECK(s.op == Op::shear);
  CHECK(s.amount.text() == "min(1, x1)");
  CHECK(std::get<PartAxis>(*s.direction) == PartAxis{"leg", 0});
  CHECK(s.why->relations == std::vector<std::string>{"t1", "a1"});
}

TEST_CASE("text errors say line and column") {
  const auto at = [](const std::string& text) { return text_error(text).place; };
  CHECK(at("") == "line 1, column 1");
  CHECK(at("widen the chair") == "line 1, column 1");
  CHECK(at("parsel program 2\n") == "line 1, column 16");
  CHECK(mentions(text_error("parsel program 2\n"), "newer version"));
  CHECK(at("parsel program 1\nlayer") == "line 2, column 1");
  CHECK(at(head + "scale_1d(\"seat\")") == "line 3, column 1");  // no layer yet
  const auto in_layer = [&](const std::string& line) { return at(head + layer_line + line); };
  CHECK(in_layer("widen(\"seat\")") == "line 4, column 1");
  CHECK(in_layer("translate(seat, amount=x1, direction=(1, 0, 0))") == "line 4, column 11");
  CHECK(in_layer("translate(\"seat\", amount=2*+*x1, direction=(1, 0, 0))") == "line 4, column 29");
  CHECK(in_layer("translate(\"sïège\", amount=2*+*x1, direction=(1, 0, 0))") == "line 4, column 30");
  CHECK(in_layer("translate(\"seat\", amount=, direction=(1, 0, 0))") == "line 4, column 26");
  CHECK(in_layer("translate(\"seat\", amount=x1, direction=(1, 0))") == "line 4, column 45");
  CHECK(in_layer("translate(\"seat\", amount=x1, direction=(0, 0, 0))") == "line 4, column 40");
  CHECK(in_layer("translate(\"seat\", amount=x1, direction=axis(\"seat\", 3))") == "line 4, column 53");
  CHECK(in_layer("translate(\"seat\", amount=x1)") == "line 4, column 1");
  CHECK(in_layer("translate(\"seat\", amount=x1, origin=(0, 0, 0), direction=(1, 0, 0))") == "line 4, column 30");
  CHECK(in_layer("translate(\"seat\", amount=x1, amount=x1, direction=(1, 0, 0))") == "line 4, column 30");
  CHECK(in_layer("translate(\"seat\", amount=x1, direction=(1, 0, 0)") == "line 4, column 49");
  CHECK(in_layer("translate(\"seat\", amount=(x1, direction=(1, 0, 0))") == "line 4, column 29");
  CHECK(in_layer("keep_fixed(\"seat) because seed") == "line 4, column 12");
  CHECK(in_layer("keep_fixed(\"seat\") why seed") == "line 4, column 20");
  CHECK(in_layer("keep_fixed(\"seat\") because seed 7") == "line 4, column 33");
  CHECK(in_layer("keep_fixed(\"seat\", amount=x1)") == "line 4, column 20");
  CHECK(in_layer("keep_fixed(\"\\q\")") == "line 4, column 13");
  CHECK(in_layer("keep_fixed(\"\\ud800\")") == "line 4, column 12");
  CHECK(in_layer("keep_fixed(\"\xff\")") == "line 4, column 12");
  CHECK(in_layer("change_count(\"t1\", amount=x1, anchor=centre)") == "line 4, column 38");
  CHECK(in_layer("relation \"a1\": held, worst -1, sampled") == "line 4, column 28");
  CHECK(in_layer("layer \"\": sin = 0 in [0, 1]") == "line 4, column 11");
  CHECK(in_layer("layer \"\": x2 = nan in [0, 1]") == "line 4, column 16");
  CHECK(in_layer("layer \"\": x2 = 0 in [0, 1e999]") == "line 4, column 25");
}

TEST_CASE("JSON: what is optional has its default") {
  const Program program =
      read(json::parse(R"({"format":"parsel/program","version":1,"shape":{"name":"","sha256":""},"layers":[
    {"request":"","parameter":{"name":"x","min":0,"max":0,"value":0},
     "statements":[{"op":"translate","part":"p","direction":[0,0,2],"amount":"x"},{"op":"change_delta","relation":"t1",
       "amount":"x"}]}]})"));
  CHECK(program.layers[0].statements[0].feature == LocalTriple{0, 0, 0});
  CHECK(program.layers[0].statements[1].anchor == Anchor::middle);
  CHECK(program.layers[0].relations.empty());
}

TEST_CASE("JSON: format and version") {
  CHECK(json_error(json::array()).place.empty());
  CHECK(json_error(json()).place.empty());
  CHECK(refused([](json& f) { f.erase("format"); }).place.empty());
  CHECK(refused([](json& f) { f["format"] = "parsel/shape"; }).place == "/format");
  CHECK(refused([](json& f) { f["format"] = 3; }).place == "/format");
  const Error newer = refused([](json& f) {
    f["version"] = 2;
    f["novelty"] = true;
  });
  CHECK(newer.place == "/version");
  CHECK(mentions(newer, "newer version"));
  CHECK(refused([](json& f) { f["version"] = "1"; }).place == "/version");
  CHECK(refused([](json& f) { f["version"] = 0; }).place == "/version");
  CHECK(refused([](json& f) { f["version"] = 1.5; }).place == "/version");
}

TEST_CASE("JSON: unknown keys are refused by name, __proto__ among them") {
  CHECK(refused([](json& f) { f["extra"] = 1; }).place == "/extra");
  CHECK(refused([](json& f) { f["__proto__"] = json::object(); }).place == "/__proto__");
  CHECK(refused([](json& f) { f["shape"]["a/b~c"] = 1; }).place == "/shape/a~1b~0c");
  CHECK(refused([](json& f) { f["layers"][0]["constructor"] = 1; }).place == "/layers/0/constructor");
  CHECK(refused([](json& f) { f["layers"][0]["parameter"]["step"] = 1; }).place == "/layers/0/parameter/step");
  const Error deep = refused([](json& f) { f["layers"][0]["statements"][0]["__proto__"] = json::object(); });
  CHECK(deep.place == "/layers/0/statements/0/__proto__");
  CHECK(mentions(deep, "'__proto__'"));
  CHECK(refused([](json& f) { f["layers"][0]["statements"][0]["why"]["note"] = 1; }).place ==
        "/layers/0/statements/0/why/note");
  CHECK(refused([](json& f) { f["layers"][0]["relations"][0]["x"] = 1; }).place == "/layers/0/relations/0/x");
  CHECK(refused([](json& f) { f["layers"][0]["statements"][0]["origin"]["z"] = 1; }).place ==
        "/layers/0/statements/0/origin/z");
}

TEST_CASE("JSON: types, ranges and fields of statements") {
  const auto statement = [](std::size_t i, auto change) {
    return refused([&](json& f) { change(f["layers"][0]["statements"][i]); });
  };
  const std::string s0 = "/layers/0/statements/0", s1 = "/layers/0/statements/1", s2 = "/layers/0/statements/2";
  CHECK(statement(0, [](json& s) { s = 7; }).place == s0);
  CHECK(statement(0, [](json& s) { s["op"] = "widen"; }).place == s0 + "/op");
  CHECK(statement(0, [](json& s) { s.erase("part"); }).place == s0);
  CHECK(statement(0, [](json& s) { s["part"] = ""; }).place == s0 + "/part");
  CHECK(statement(0, [](json& s) { s["part"] = std::string(201, 'a'); }).place == s0 + "/part");
  CHECK(statement(0, [](json& s) { s["part"] = "\xc3\x28"; }).place == s0 + "/part");
  CHECK(statement(0, [](json& s) { s["feature"] = {0, 2, 0}; }).place == s0 + "/feature/1");
  CHECK(statement(0, [](json& s) { s["feature"] = {0, 0.5, 0}; }).place == s0 + "/feature/1");
  CHECK(statement(0, [](json& s) { s["feature"] = {0, 0}; }).place == s0 + "/feature");
  CHECK(statement(0, [](json& s) { s.erase("origin"); }).place == s0);
  CHECK(statement(0, [](json& s) { s["origin"] = {0, 0, 2e6}; }).place == s0 + "/origin");
  CHECK(statement(0, [](json& s) { s["origin"] = {0, 0, nullptr}; }).place == s0 + "/origin/2");
  CHECK(statement(0, [](json& s) { s["origin"] = {{"part", "seat"}}; }).place == s0 + "/origin");
  CHECK(statement(0, [](json& s) { s["direction"] = {0, 0, 0}; }).place == s0 + "/direction");
  CHECK(statement(0, [](json& s) {
          s["direction"] = {{"part", "seat"}, {"axis", 3}};
        }).place == s0 + "/direction/axis");
  CHECK(statement(0, [](json& s) { s["normal"] = {0, 0, 1}; }).place == s0 + "/normal");
  CHECK(statement(0, [](json& s) { s["axis"] = {0, 0, 1}; }).place == s0 + "/axis");
  CHECK(statement(0, [](json& s) { s["relation"] = "t1"; }).place == s0 + "/relation");
  CHECK(statement(0, [](json& s) { s["anchor"] = "start"; }).place == s0 + "/anchor");
  CHECK(statement(0, [](json& s) { s["amount"] = 0.5; }).place == s0 + "/amount");
  const Error bad_amount = statement(0, [](json& s) { s["amount"] = "x1 + "; });
  CHECK(bad_amount.place == s0 + "/amount");
  CHECK(mentions(bad_amount, "column 6"));
  CHECK(statement(0, [](json& s) { s["amount"] = std::string(100000, '('); }).place == s0 + "/amount");
  CHECK(statement(1, [](json& s) { s["direction"] = s["axis"]; }).place == s1 + "/direction");
  CHECK(statement(2, [](json& s) { s["amount"] = "0"; }).place == s2 + "/amount");
  CHECK(statement(2, [](json& s) { s["feature"] = {0, 0, 0}; }).place == s2 + "/feature");
  CHECK(statement(0, [](json& s) { s["why"] = "seed"; }).place == s0 + "/why");
  CHECK(statement(0, [](json& s) { s["why"]["kind"] = "magic"; }).place == s0 + "/why/kind");
  CHECK(statement(0, [](json& s) { s["why"]["relations"] = json::array_t(257, "a1"); }).place == s0 + "/why/relations");
  CHECK(refused([](json& f) { f["layers"][0]["relations"][0]["worst"] = -1; }).place == "/layers/0/relations/0/worst");
  CHECK(refused([](json& f) { f["layers"][0]["parameter"]["name"] = "sin"; }).place == "/layers/0/parameter/name");
  CHECK(refused([](json& f) { f["layers"][0]["parameter"]["name"] = "X"; }).place == "/layers/0/parameter/name");
  CHECK(refused([](json& f) { f["layers"][0]["parameter"]["min"] = NAN; }).place == "/layers/0/parameter/min");
  CHECK(refused([](json& f) { f["layers"][0]["request"] = std::string(4097, 'a'); }).place == "/layers/0/request");
  CHECK(refused([](json& f) { f["shape"]["sha256"] = "XYZ"; }).place == "/shape/sha256");
  CHECK(refused([](json& f) { f["layers"] = json::object(); }).place == "/layers");
  CHECK(refused([](json& f) { f["layers"][0]["statements"] = json::object(); }).place == "/layers/0/statements");
}

TEST_CASE("too many layers or statements are refused before they are read") {
  json file = small_program();
  file["layers"] = json::array_t(101, file["layers"][0]);
  CHECK(json_error(file).place == "/layers");
  file = small_program();
  file["layers"][0]["statements"] = json::array_t(10'001, nullptr);
  CHECK(json_error(file).place == "/layers/0/statements");
  file["layers"][0]["statements"] = json::array_t(1'000, nullptr);
  file["layers"] = json::array_t(11, file["layers"][0]);
  CHECK(mentions(json_error(file), "11000 statements"));

  std::string text = head + layer_line;
  for (int i = 0; i < 10'001; ++i) text += "keep_fixed(\"a\")\n";
  CHECK(text_error(text).place == "line 10004, column 1");
  CHECK(mentions(text_error(std::string(ProgramLimits::text_bytes + 1, '\n')), "8 MiB"));
}

TEST_CASE("a layer may have as many reports as are written, and no reader takes one more") {
  const Shape shape = hand::slats();
  Program program = hand::program(shape, {hand::statement(Op::translate, "rail", Vec3::UnitX(), "x1")});
  program.layers[0].relations.assign(ProgramLimits::reports,
                                     {"a1", RelationStatus::held, 0.012345678901234, Proof::certified, {}});
  CHECK(readable(program, shape).ok());
  std::string text = to_text(program);
  CHECK(program_from_text(text).ok());
  program.layers[0].relations.push_back(program.layers[0].relations[0]);
  CHECK_FALSE(validate(program, shape).ok());
  CHECK_FALSE(readable(program, shape).ok());
  CHECK(json_error(to_json(program)).place == "/layers/0/relations");
  text += "  relation \"a1\": held, worst 0, certified\n";
  CHECK(mentions(text_error(text), "100000 reports"));
}

TEST_CASE("what its own reader refuses is not readable, though it makes sense for the shape") {
  const Shape shape = hand::slats();
  Program program = hand::program(shape, {hand::statement(Op::translate, "rail", Vec3::UnitX(), "x1")});
  CHECK(readable(program, shape).ok());
  program.layers[0].request = std::string(ProgramLimits::request_bytes + 1, 'a');
  CHECK(validate(program, shape).ok());
  CHECK_FALSE(readable(program, shape).ok());
}

TEST_CASE("deeply nested JSON is refused, not recursed into") {
  std::string deep(10'000, '[');
  deep += std::string(10'000, ']');
  const json nested = json::parse(deep);
  CHECK(refused([&](json& f) { f["layers"][0]["statements"][0] = nested; }).place == "/layers/0/statements/0");
  json file = small_program();
  file["layers"][0]["statements"][0]["origin"] = json::parse(deep);
  CHECK(json_error(file).place == "/layers/0/statements/0/origin");
}

TEST_CASE("UTF-8 is checked to the letter") {
  for (const std::string good : {"", "a", "é", "座", "𝄞", "\xed\x9f\xbf", "\xf4\x8f\xbf\xbf"}) CHECK(is_utf8(good));
  for (const std::string bad : {"\x80", "\xc3", "\xc0\x80", "\xe0\x80\x80", "\xed\xa0\x80", "\xf4\x90\x80\x80",
                                "\xf8\x88\x80\x80", "\xf0\x80\x80\x80", "a\xff", "\xe5\xba"}) {
    CHECK_FALSE(is_utf8(bad));
  }
}
