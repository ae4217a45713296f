// SPDX-License-Identifier: GPL-3.0-or-later
// Strips of a plate whose rest is known from ordinary differential equations.
#include <catch2/catch.hpp>
#include <cmath>

#include "physics/cloth/pins.h"
#include "tests/cases/flat_meshes.h"
#include "tests/cases/plates.h"
#include "tests/physics/cloth/strips.h"
#include "tests/physics/rest/settled.h"

using namespace furrow::physics;
using namespace furrow::tests;
using namespace furrow::cases;

namespace {

constexpr double strip_length = 0.1, strip_b = 1e-5;

struct PlateFall {
  double chart;  ///< error of H/W [-]
  double twist;  ///< of the tip, over the width [-]
};

PlateFall fall_of(ClampedStrip strip, double gamma) {
  const double gravity = gravity_for(gamma, strip.density, strip.length, strip_b);
  const Settled report = find_rest(strip.cloth, down_to(1e-5, {0, 0, -gravity}));
  CHECK(report.converged);
  Vec3 tip = Vec3::Zero();
  for (const int i : strip.tip) tip += strip.cloth.particles.x[i] / double(strip.tip.size());
  const Elastica exact = heavy_elastica(gamma);
  const Vec3 across = strip.cloth.particles.x[strip.tip.back()] - strip.cloth.particles.x[strip.tip.front()];
  return {-tip.z() / tip.x() / (exact.height / exact.width) - 1, std::abs(across.z()) / strip.width};
}

/// Y L^2 / B = stiffness.
PlateFall plate_fall(SheetKind kind, int n, double gamma, double stiffness = 2e5) {
  ClampedStrip strip = clamped_strip(kind, strip_length, strip_length / 4, n,
                                     stiffness * strip_b / (strip_length * strip_length));
  add_plate(strip.cloth, isotropic_plate(strip_b));
  return fall_of(std::move(strip), gamma);
}

}  // namespace

TEST_CASE("plate_bending: cantilevers meet the elastica on eight kinds of meshes", "[release]") {
  for (const SheetKind kind : sheet_kinds) {
    for (const double gamma : {1.0, 5.0, 25.0, 100.0}) {
      const PlateFall coarse = plate_fall(kind, 16, gamma), fine = plate_fall(kind, 32, gamma);
      CAPTURE(name_of(kind), gamma, coarse.chart, fine.chart, coarse.twist, fine.twist);
      // At 100 the radius at the clamp is one and a half cells of the coarse strip.
      CHECK(std::abs(coarse.chart) < (gamma > 25 ? 2.6e-2 : 1.1e-2));
      CHECK(std::abs(fine.chart) < (gamma > 25 ? 7e-3 : 3e-3));
      CHECK(fine.twist < 5e-3);
    }
  }
}

TEST_CASE("plate_bending: plain hinges do not meet it on cut quads, which tests the test", "[release]") {
  ClampedStrip strip = clamped_strip(SheetKind::one_diagonal, strip_length, strip_length / 4, 32,
                                     2e5 * strip_b / (strip_length * strip_length));
  add_flat_hinges(strip.cloth, strip_b);
  stiffen_clamps(strip.cloth);
  const PlateFall fall = fall_of(std::move(strip), 25);
  CAPTURE(fall.chart, fall.twist);
  CHECK(fall.chart > 0.05);
  CHECK(fall.twist > 0.05);
}

TEST_CASE("plate_bending: strips cut at an angle bend as their cloth's warp, weft and twist say",
          "[release]") {
  const PlateRigidity cloth{strip_b, 0.5 * strip_b, 0.2 * strip_b, 0.1};
  for (const double angle : {0.0, 0.3927, 0.7854, 1.5708}) {
    ClampedStrip strip = clamped_strip(SheetKind::jittered, strip_length, strip_length / 16, 64,
                                       2e5 * strip_b / (strip_length * strip_length));
    add_plate(strip.cloth, cloth, -angle);
    const double own = strip_rigidity(cloth, angle), gamma = 2;
    const double gravity = gravity_for(gamma, strip.density, strip.length, own);
    const Settled report = find_rest(strip.cloth, down_to(1e-5, {0, 0, -gravity}));
    CHECK(report.converged);
    Vec3 tip = Vec3::Zero();
    for (const int i : strip.tip) tip += strip.cloth.particles.x[i] / double(strip.tip.size());
    const Elastica exact = heavy_elastica(gamma);
    CAPTURE(angle, own / strip_b, -tip.z() / strip_length, exact.height);
    CHECK(-tip.z() / strip_length == Approx(exact.height).epsilon(0.02));
  }
}
