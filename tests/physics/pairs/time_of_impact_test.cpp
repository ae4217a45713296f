// SPDX-License-Identifier: GPL-3.0-or-later
#include "physics/pairs/time_of_impact.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "tests/physics/pairs/random_pairs.h"

using namespace furrow::physics;
using namespace furrow::tests;

namespace {

double distance_after(const MovingPair& p, double t) {
  Corners x;
  for (std::size_t i = 0; i < 4; ++i) x[i] = p.x[i] + t * p.move[i];
  return std::sqrt(distance_of(p.edges, x).squared());
}

MovingPair random_motion(std::uint64_t seed, bool edges) {
  Noise noise(seed + 77);
  MovingPair p{edges, random_corners(seed), {}};
  const Vec3 common = noise.vector();
  for (Vec3& m : p.move) m = common + 0.3 * noise.vector();
  return p;
}

}  // namespace

TEST_CASE("time_of_impact: up to it the two are apart, by a tenth of what they were or of the range",
          "[long]") {
  int cut = 0, free = 0;
  for (const bool edges : {false, true})
    for (std::uint64_t seed = 1; seed <= 20000; ++seed) {
      const MovingPair p = random_motion(seed, edges);
      const double start = distance_after(p, 0), range = 0.02, share = time_of_impact(p, range);
      if (start == 0) continue;
      const double least = 0.1 * std::min(start, range);
      (share < 1 ? cut : free)++;
      const int n = 100;
      for (int i = 0; i <= n; ++i)
        if (!(distance_after(p, share * i / n) >= least * (1 - 1e-9)))
          FAIL("seed " << seed << ", sample " << i);
      // It is no more careful than that: a little later they are that near.
      if (share < 1 && start > 1e-3) CHECK(distance_after(p, share) <= 1.1 * least * (1 + 1e-9));
    }
  CHECK(cut > 2000);
  CHECK(free > 2000);
}

TEST_CASE("time_of_impact: a vertex that is thrown at a face stops at a tenth of its distance") {
  MovingPair p{false, {Vec3(0.2, 0.2, 1), Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0)}, {}};
  p.move.fill(Vec3(5, 3, 2));
  CHECK(time_of_impact(p, 10) == 1);
  p.move[0] += Vec3(0, 0, -2);
  const double share = time_of_impact(p, 10);
  CHECK(share <= 0.45);
  CHECK(share > 0.444);
  CHECK(time_of_impact(p, 0.01) < 0.5);
  p.x[0].z() = 0;
  CHECK(time_of_impact(p, 10) == 0);
}

TEST_CASE("time_of_impact: motion that stays beyond the range is not cut, whatever it passes") {
  MovingPair p{true, {Vec3(0, 0, 0), Vec3(0, 1, 0), Vec3(0.05, 0.5, -3), Vec3(0.05, 0.5, -2)}, {}};
  p.move = {Vec3::Zero(), Vec3::Zero(), Vec3(0, 0, 9), Vec3(0, 0, 9)};
  CHECK(time_of_impact(p, 0.05) == 1);
}

TEST_CASE("time_of_impact: what slides along a gap of nanometres is not cut before it closes") {
  const double gap = 2e-9;
  MovingPair p{true, {Vec3(-1, 0, gap), Vec3(1, 0, gap), Vec3(0, -1, 0), Vec3(0, 1, 0)}, {}};
  p.move = {Vec3(0.1, 0.4, 0), Vec3(0.1, 0.5, 0), Vec3(0, 0.01, 0), Vec3(0.02, 0, 0)};
  CHECK(time_of_impact(p, 1e-3) == 1);
  for (const std::size_t corner : {0u, 1u}) p.move[corner].z() = -2 * gap;
  const double share = time_of_impact(p, 1e-3);
  CHECK(share <= 0.45);
  CHECK(share > 0.44);
  MovingPair on_face{false, {Vec3(0.2, 0.2, gap), Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0)}, {}};
  on_face.move = {Vec3(0.3, 0.1, 0), Vec3(0, 0.01, 0), Vec3(0, 0, 0), Vec3(0.01, 0, 0)};
  CHECK(time_of_impact(on_face, 1e-3) == 1);
}
