// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>
#include <string>
#include <thread>

#include "physics/body/distance_field.h"
#include "tests/physics/body/field_inputs.h"

using namespace furrow::physics;
using namespace furrow::tests;

TEST_CASE("distance_field: progress never falls, ends at 1, comes from the caller's thread, changes no bit",
          "[long]") {
  const TriangleMesh ball = sphere(12, 0.3);
  const auto silent = DistanceField::build(ball);
  for (const int threads : {1, 3}) {
    DistanceFieldOptions options;
    options.threads = threads;
    std::vector<double> shares;
    const auto caller = std::this_thread::get_id();
    bool elsewhere = false;
    const auto field = DistanceField::build(ball, options, [&](double share) {
      shares.push_back(share);
      elsewhere |= std::this_thread::get_id() != caller;
      return true;
    });
    CHECK(shares.size() > 20);
    CHECK(std::is_sorted(shares.begin(), shares.end()));
    CHECK(shares.front() >= 0);
    CHECK(shares.back() == 1);
    CHECK_FALSE(elsewhere);
    CHECK(field.to_bytes() == silent.to_bytes());
  }
}

TEST_CASE("distance_field: a build is cancelled where its progress says no, or throws") {
  const TriangleMesh ball = sphere(12, 0.3);
  for (const int threads : {1, 3})
    for (const int allowed : {0, 7}) {
      DistanceFieldOptions options;
      options.threads = threads;
      int calls = 0;
      CHECK_THROWS_AS(DistanceField::build(ball, options, [&](double) { return calls++ < allowed; }),
                      Cancelled);
      CHECK(calls == allowed + 1);
      CHECK_THROWS_AS(DistanceField::build(ball, options, [](double) -> bool { throw 7; }), int);
    }
}

TEST_CASE("distance_field: a tolerance that asks for too much is cancelled, not waited for") {
  DistanceFieldOptions options;
  options.tolerance = 1e-9;
  options.max_depth = 12;
  options.band_depth = 12;
  int calls = 0;
  CHECK_THROWS_AS(DistanceField::build(sphere(12, 0.3), options, [&](double) { return ++calls < 50; }),
                  Cancelled);
}

TEST_CASE("distance_field: more samples than allowed are refused before they are taken, with what helps",
          "[long]") {
  const TriangleMesh ball = sphere(12, 0.3);
  DistanceFieldOptions options;
  options.tolerance = 2e-5;
  options.most_samples = 1000000;
  double furthest = 0;
  const auto tell = [&](double share) {
    furthest = share;
    return true;
  };
  double advised = 0;
  try {
    DistanceField::build(ball, options, tell);
    FAIL("built");
  } catch (const TooMuchWork& e) {
    const std::string text = e.what();
    CHECK(text.starts_with("the distance field would take about "));
    const std::string before = "raise the tolerance to ";
    advised = std::stod(text.substr(text.find(before) + before.size()));
  }
  CHECK(furthest < 0.8);
  options.tolerance = advised;
  const DistanceField field = DistanceField::build(ball, options);
  CHECK(field.report().samples <= 1000000);
  options.most_samples = 0;
  CHECK(DistanceField::build(ball, options).to_bytes() == field.to_bytes());
}

TEST_CASE("distance_field: a body that is tiny beside its band is refused, too") {
  DistanceFieldOptions options;
  options.most_samples = 100000;
  CHECK_THROWS_AS(DistanceField::build(sphere(6, 1e-6), options), TooMuchWork);
}
