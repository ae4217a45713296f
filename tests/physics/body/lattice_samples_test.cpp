// SPDX-License-Identifier: GPL-3.0-or-later
#include "physics/body/lattice_samples.h"

#include <catch2/catch.hpp>

#include "tests/physics/body/field_inputs.h"

namespace {

using namespace furrow::physics;

constexpr int side = 32;

/// All points of the lattice, from coarse to fine, each with the coarse point below it as a guess.
void add_levels(LatticeSamples& samples) {
  for (int step = side; step >= 1; step /= 2) {
    for (int k = 0; k <= side; k += step)
      for (int j = 0; j <= side; j += step)
        for (int i = 0; i <= side; i += step) {
          const auto below = [&](int a) { return a / (2 * step) * (2 * step); };
          if (step == side)
            samples.add({i, j, k});
          else
            samples.add({i, j, k}, samples.add({below(i), below(j), below(k)}));
        }
    samples.evaluate();
  }
}

}  // namespace

TEST_CASE("lattice_samples: the side that a neighbour tells is that of the winding number") {
  TriangleMesh m = furrow::tests::box({-1, -1, -1}, {0.5, 0.5, 0.5});
  furrow::tests::append(m, furrow::tests::box({-0.4, -0.3, -0.2}, {0.9, 1.1, 1.2}));  // crosses it
  furrow::tests::append(m, furrow::tests::sphere(3, 0.5, {0.7, -0.8, 0.1}));
  const ExactDistance exact(m);
  REQUIRE(exact.report().rule == SignRule::sides);
  REQUIRE(exact.report().crossed_triangles > 12);
  const Vec3 low(-1.51, -1.52, -1.53);
  const double unit = 3.1 / side;
  LatticeSamples samples(exact, low, unit, 1);
  add_levels(samples);
  int inside = 0;
  for (int k = 0; k <= side; ++k)
    for (int j = 0; j <= side; ++j)
      for (int i = 0; i <= side; ++i) {
        const Vec3 x = low + unit * Vec3(i, j, k);
        const double value = samples.value(samples.add({i, j, k}));
        REQUIRE((value < 0) == (exact.winding_number(x) > 0.5));
        REQUIRE(std::abs(value) == Approx(std::abs(exact.sample(x).value)).margin(1e-14));
        inside += value < 0;
      }
  CHECK(samples.size() == (side + 1) * (side + 1) * (side + 1));
  CHECK(inside > 3000);
}
