// SPDX-License-Identifier: GPL-3.0-or-later
#include "jobs/base/ends.h"

#include <catch2/catch.hpp>
#include <limits>
#include <nlohmann/json.hpp>
#include <random>

using namespace furrow;
using jobs::EndFacts;
using jobs::EndLimits;

namespace {

constexpr double no_number = std::numeric_limits<double>::quiet_NaN();

/// An end at random, of few values each, so that many are alike in some.
EndFacts random_end(std::mt19937& random) {
  const auto pick = [&random](int n) { return int(random() % unsigned(n)); };
  EndFacts e;
  e.finite = pick(8) > 0;
  if (pick(4)) e.strain = std::array{0.0, 0.02, 0.4, 1.5, no_number}[std::size_t(pick(5))];
  e.crossings = std::size_t(std::array{0, 0, 3, 369}[std::size_t(pick(4))]);
  if (pick(4))
    e.body = {std::size_t(std::array{0, 0, 2, 15}[std::size_t(pick(4))]), 0,
              std::array{0.0, 0.0018, 0.02, no_number}[std::size_t(pick(4))]};
  if (pick(4)) e.residual = std::array{1e-4, 9e-4, 0.3, 1.0, no_number}[std::size_t(pick(5))];
  e.parts.resize(std::size_t(1 + pick(3)));
  for (jobs::PartEnd& part : e.parts) part.lost = pick(4) == 0;
  return e;
}

/// An end at rest.
EndFacts rest() {
  EndFacts e;
  e.residual = 5e-4;
  e.strain = 0.02;
  e.parts.resize(2);
  return e;
}

}  // namespace

TEST_CASE("ends: of any two ends one is the better or they are alike, and of many one is the best") {
  std::mt19937 random(7);
  const EndLimits limits{2, 0.005, 1e-3};
  for (int round = 0; round < 20000; ++round) {
    const EndFacts a = random_end(random), b = random_end(random), c = random_end(random);
    const bool ab = is_better(a, b, limits), bc = is_better(b, c, limits), ac = is_better(a, c, limits);
    REQUIRE_FALSE(is_better(a, a, limits));
    REQUIRE_FALSE((ab && is_better(b, a, limits)));
    REQUIRE((!ab || !bc || ac));  // transitive
    REQUIRE((ab || bc || !ac));   // and so is "not better"
    REQUIRE((!succeeds(b, limits) || succeeds(a, limits) || is_better(b, a, limits)));
    if (succeeds(a, limits) && a.residual) REQUIRE(outcome_of(a, limits) == "at rest");
  }
}

TEST_CASE("ends: what is worse in one thing loses, whatever it is better in further down the list") {
  const EndLimits limits;
  std::vector<EndFacts> ends(8, rest());  // the best first
  ends[1].strain = 0.3;
  ends[2].residual = 0.5;
  ends[3].parts[0].lost = true;
  ends[4].body = {4, 0, 0.02};
  ends[5].crossings = 1;
  ends[6].strain = 1.5;
  ends[7].finite = false;
  for (std::size_t i = 0; i < ends.size(); ++i)
    for (std::size_t j = 0; j < ends.size(); ++j) CHECK(is_better(ends[i], ends[j], limits) == (i < j));
  EndFacts falls_uncrossed = rest(), rests_crossed = rest();
  falls_uncrossed.parts[1].lost = true;
  falls_uncrossed.residual = 1;
  rests_crossed.crossings = 369;
  CHECK(is_better(falls_uncrossed, rests_crossed, limits));
  CHECK(succeeds(ends[1], limits));
  for (std::size_t i = 2; i < ends.size(); ++i) CHECK_FALSE(succeeds(ends[i], limits));
}

TEST_CASE("ends: what is allowed tells no failure, and still the fewer the better") {
  EndFacts few = rest(), more = rest(), moving = rest();
  few.crossings = 3, more.crossings = 5;
  more.body = {2, 0, 0.001};
  moving.residual = 0.01;
  const EndLimits limits{10, 0.005, 1e-3};
  CHECK(succeeds(more, limits));
  CHECK(is_better(few, more, limits));
  CHECK(is_better(more, moving, limits));
  CHECK_FALSE(succeeds(more, EndLimits{4, 0.005, 1e-3}));
  CHECK(is_better(moving, more, EndLimits{4, 0.005, 1e-3}));
}

TEST_CASE("ends: an end is named by the worst that it has, and lists its facts") {
  const EndLimits limits;
  EndFacts e = rest();
  CHECK(outcome_of(e, limits) == "at rest");
  e.parts[0].lost = true;
  CHECK(outcome_of(e, limits) == "at rest");  // the other part rests
  e.residual = 0.5, e.blocked = true;
  CHECK(outcome_of(e, limits) == "blocked");
  e.parts[1].lost = true, e.parts[1].fallen = 0.25;
  CHECK(outcome_of(e, limits) == "falls");
  e.body = {15, 2, 0.0018};
  CHECK(words_of_piercing(*e.body) == "the body comes through 15 faces, by up to 1.8 mm");
  const io::Json told = to_json(e);
  CHECK(told.at("parts_lost") == 2);
  CHECK(told.at("fallen") == 0.25);
  CHECK(told.at("body").at("depth") == 0.0018);
  CHECK(told.at("parts").size() == 2);
  e.strain = no_number;
  CHECK(outcome_of(e, limits) == "torn");
  e.finite = false;
  CHECK(outcome_of(e, limits) == "numerical failure");
}
