#include "core/family/vote.h"

#include <doctest/doctest.h>

#include <algorithm>

#include "core/base/random.h"
#include "core/cad/scad_flatten.h"
#include "core/family/candidates.h"
#include "core/gallery/programs.h"

using namespace parsel;
using namespace parsel::family;

namespace {

cad::Model program(const std::string& id) {
  for (const GalleryProgram& one : gallery_programs()) {
    if (one.id == id) return *cad::read_scad(one.scad, id);
  }
  return {};
}

struct Asked {
  explicit Asked(const std::string& id)
      : model(program(id)), layout(layout_of(model, Vocabulary::extended)), base(values_of(layout, model)) {}

  Ballot ballot(const Values& values) const { return {values, std::vector<bool>(model.parts.size(), false)}; }
  double& value(Values& values, const std::string& parameter) const {
    const std::size_t i = layout.find(parameter);
    REQUIRE(i < layout.size());
    return values[static_cast<Eigen::Index>(i)];
  }
  double at(const Voted& voted, const std::string& parameter) const {
    return voted.variation.values[static_cast<Eigen::Index>(layout.find(parameter))];
  }
  std::size_t part(const std::string& id) const {
    return static_cast<std::size_t>(model.find(id) - model.parts.data());
  }

  cad::Model model;
  Layout layout;
  Values base;
};

/// The largest residual of the base's constraints between parts that a kind has.
double torn(const Asked& asked, const Voted& voted) {
  double most = 0;
  for (const Constraint& constraint : find_candidates(asked.layout, asked.model, asked.base, 1e-6).holding) {
    if (!voted.variation.has(constraint.a.part) || !voted.variation.has(constraint.b.part)) continue;
    most = std::max(most, constraint.residual(voted.variation.values));
  }
  return most;
}

}  // namespace

TEST_CASE("votes on a kind: the median of each bound, wherever the answers stand") {
  const Asked asked("table");
  std::vector<Ballot> ballots;
  for (const double wider : {0.0, 100.0, 700.0}) {
    Values values = asked.base;
    for (std::size_t p = 0; p < asked.model.parts.size(); ++p) {
      values[static_cast<Eigen::Index>(asked.layout.centre(p, 2))] += wider;  // the same thing elsewhere
    }
    asked.value(values, "board.sx") += wider;
    ballots.push_back(asked.ballot(values));
  }
  const auto voted = count_votes(asked.model, asked.layout, "bench", ballots);
  REQUIRE(voted.ok());
  CHECK(voted->variation.name == "bench");
  CHECK(voted->variation.source == "model");
  CHECK(voted->variation.votes == 3);
  CHECK(asked.at(*voted, "board.sx") == doctest::Approx(700));
  CHECK(asked.at(*voted, "board.sz") == doctest::Approx(600));
  CHECK(asked.at(*voted, "board.cz") == doctest::Approx(100));
  // Two of three no longer have the board flush with the legs: that is not kept.
  CHECK(voted->agreed < voted->constraints);
}

TEST_CASE("votes on a kind: what slipped in one answer does not count") {
  Random random(20);
  for (const GalleryProgram& one : gallery_programs()) {
    CAPTURE(one.id);
    const Asked asked((std::string(one.id)));
    const auto parameters = static_cast<std::uint64_t>(asked.layout.size());
    for (int round = 0; round < 20; ++round) {
      std::vector<Ballot> ballots(5, asked.ballot(asked.base));
      for (std::size_t b = 0; b < 2; ++b) {  // two of five have a number wrong
        const auto i = static_cast<Eigen::Index>(random.below(parameters));
        ballots[b].values[i] *= 1.1;
      }
      const auto voted = count_votes(asked.model, asked.layout, "same", ballots);
      REQUIRE(voted.ok());
      CHECK(voted->agreed == voted->constraints);
      CHECK(torn(asked, *voted) < 1e-9);
      CHECK((voted->variation.values - asked.base).cwiseAbs().maxCoeff() < 1e-6 * asked.base.cwiseAbs().maxCoeff());
    }
  }
}

TEST_CASE("votes on a kind: answers of other sizes keep what each of them keeps") {
  const Asked asked("chair");
  std::vector<Ballot> ballots;
  // Legs of another section in each, square in all: the medians of their bounds alone would not be square.
  const double sections[] = {30, 38, 52, 60, 45}, depths[] = {400, 500, 420, 480, 460};
  for (int v = 0; v < 5; ++v) {
    Values values = asked.base;
    const double half = depths[v] / 2;
    asked.value(values, "seat.sz") = depths[v];
    for (const char* z : {"front", "back"}) {
      for (const char* x : {"left", "right"}) {
        const std::string leg = std::string("leg_") + z + "_" + x;
        const double sx = *x == 'l' ? 1 : -1, sz = *z == 'f' ? 1 : -1;
        asked.value(values, leg + ".sx") = asked.value(values, leg + ".sz") = sections[v];
        asked.value(values, leg + ".cx") = sx * (260 - sections[v] / 2);
        asked.value(values, leg + ".cz") = sz * (half - sections[v] / 2);
      }
    }
    ballots.push_back(asked.ballot(values));
  }
  const auto voted = count_votes(asked.model, asked.layout, "chair", ballots);
  REQUIRE(voted.ok());
  CHECK(asked.at(*voted, "leg_front_left.sx") == doctest::Approx(asked.at(*voted, "leg_front_left.sz")).epsilon(1e-12));
  CHECK(asked.at(*voted, "leg_front_left.sx") == doctest::Approx(asked.at(*voted, "leg_back_right.sx")).epsilon(1e-12));
}

TEST_CASE("votes on a kind: parts go by majority") {
  const Asked asked("chair");
  const std::size_t arm = asked.part("arm_left"), back = asked.part("back");
  std::vector<Ballot> ballots(5, asked.ballot(asked.base));
  for (std::size_t b = 0; b < 3; ++b) ballots[b].absent[arm] = true;
  for (std::size_t b = 0; b < 2; ++b) ballots[b].absent[back] = true;
  const auto voted = count_votes(asked.model, asked.layout, "bench", ballots);
  REQUIRE(voted.ok());
  CHECK_FALSE(voted->variation.has(arm));
  CHECK(voted->variation.has(back));
  CHECK(voted->variation.votes == 5);

  const auto none = count_votes(asked.model, asked.layout, "bench", {});
  REQUIRE_FALSE(none.ok());
  CHECK(none.error().cause == "no answer can be counted");
  // Each answer leaves another part, so that no part is left by most.
  std::vector<Ballot> scattered;
  for (std::size_t p = 0; p < asked.model.parts.size(); ++p) {
    scattered.push_back({asked.base, std::vector<bool>(asked.model.parts.size(), true)});
    scattered.back().absent[p] = false;
  }
  const auto nothing = count_votes(asked.model, asked.layout, "bench", scattered);
  REQUIRE_FALSE(nothing.ok());
  CHECK(nothing.error().cause == "the answers leave no part of it");
}

TEST_CASE("votes on a kind: no answers make a part without size") {
  Random random(5);
  const Asked asked("camera");
  for (int round = 0; round < 300; ++round) {
    std::vector<Ballot> ballots;
    for (std::uint64_t b = 0; b < 1 + random.below(5); ++b) {
      Ballot ballot = asked.ballot(asked.base);
      for (std::size_t i = 0; i < asked.layout.size(); ++i) {
        const bool is_centre = asked.layout.parameters[i].quantity == Quantity::centre;
        if (random.below(2) == 0) continue;
        ballot.values[static_cast<Eigen::Index>(i)] = is_centre ? random.uniform(-50, 50) : random.uniform(0.1, 100);
      }
      ballots.push_back(std::move(ballot));
    }
    const auto voted = count_votes(asked.model, asked.layout, "any", ballots);
    if (!voted.ok()) continue;
    for (std::size_t i = 0; i < asked.layout.size(); ++i) {
      if (asked.layout.parameters[i].quantity == Quantity::size) {
        CHECK(voted->variation.values[static_cast<Eigen::Index>(i)] > 0);
      }
    }
  }
}
