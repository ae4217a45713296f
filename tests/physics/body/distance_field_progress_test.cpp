// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>
#include <thread>

#include "physics/body/distance_field.h"
#include "tests/physics/body/field_inputs.h"

using namespace furrow::physics;
using namespace furrow::tests;

TEST_CASE("distance_field: progress never falls, ends at 1, comes from the caller's thread, changes no bit") {
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
