// SPDX-License-Identifier: GPL-3.0-or-later
// Strips whose rest is known from ordinary differential equations; bench/statics_cases.cpp has the whole
// table.
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "tests/physics/cloth/strips.h"
#include "tests/physics/rest/settled.h"

using namespace furrow::physics;
using namespace furrow::tests;

namespace {

struct Fall {
  double width, height;  // W/L, H/L
};

Fall hang(Strip strip, double density, double gamma) {
  const double gravity = gravity_for(gamma, density, strip.length, strip.rigidity);
  const Settled report = find_rest(strip.cloth, down_to(1e-5, {0, 0, -gravity}));
  CHECK(report.converged);
  CHECK(report.stable);
  return {strip.tip().x() / strip.length, -strip.tip().z() / strip.length};
}

double chart_error(const StripOptions& options, double gamma) {
  const Fall fall = hang(equilateral_strip(options), options.density, gamma);
  const Elastica exact = heavy_elastica(gamma);
  return fall.height / fall.width / (exact.height / exact.width) - 1;
}

}  // namespace

TEST_CASE("cantilever: shooting for the heavy elastica meets the table", "[release]") {
  const Elastica a = heavy_elastica(10), b = heavy_elastica(1, 3);
  CHECK(a.width == Approx(0.6563537612).epsilon(1e-9));
  CHECK(a.height == Approx(0.7001997155).epsilon(1e-9));
  CHECK(a.tip_angle == Approx(60.31200795 * std::numbers::pi / 180).epsilon(1e-8));
  CHECK(heavy_elastica(0.01, 3).height == Approx(0.0639966626834).epsilon(1e-5));
  CHECK(b.height > 0.28);
}

TEST_CASE("cantilever: a ladder of 40 hinges meets the elastica, and halving its links quarters the error",
          "[release]") {
  for (const auto& [gamma, bound] : {std::pair{1.0, 1e-4}, {10.0, 1e-3}, {100.0, 1e-3}}) {
    const Elastica exact = heavy_elastica(gamma);
    double error[2];
    for (const int k : {0, 1}) {
      LadderOptions o;
      o.links = k ? 40 : 20;
      error[k] = hang(ladder(o), o.density, gamma).height - exact.height;
    }
    CAPTURE(gamma, error[1]);
    CHECK(std::abs(error[1]) < bound);  // relative to the length; of H it is 6.2e-4 for Gamma = 1: (h/L)^2
    CHECK(std::log2(error[0] / error[1]) == Approx(2).margin(0.05));
  }
}

TEST_CASE("cantilever: equilateral triangles meet the elastica but for the softening of free edges",
          "[release]") {
  for (const auto& [gamma, bound] : {std::pair{1.0, 0.04}, {5.0, 0.02}, {10.0, 0.01}, {25.0, 0.01}}) {
    const double error = chart_error({}, gamma);
    CAPTURE(gamma);
    CHECK(error > 0);
    CHECK(error < bound);
  }
  StripOptions fine;
  fine.rows = 32;
  fine.columns = 8;
  CHECK(std::abs(chart_error(fine, 100)) < 0.01);
}

TEST_CASE("cantilever: irregular triangles are a little too stiff", "[release]") {
  for (const auto& [gamma, bound] : {std::pair{1.0, 0.10}, {10.0, 0.05}}) {
    StripOptions o;
    o.jitter = 0.2 * std::sqrt(0.75);  // 0.2 of the cell's length along; 0.2 edges give 1.4 % more
    double mean = 0;
    for (o.seed = 1; o.seed <= 5; ++o.seed) mean += chart_error(o, gamma) / 5;
    CAPTURE(gamma, mean);
    CHECK(mean < 0);
    CHECK(std::abs(mean) < bound);
  }
}

TEST_CASE("cantilever: springs across edges follow the third root of the load", "[release]") {
  double drop[2];
  for (const int k : {0, 1}) {
    const double gamma = k ? 0.1 : 0.001;
    StripOptions o;
    o.young = 1e5;
    Strip strip = equilateral_strip(o);
    const double edge = strip.width / o.columns, spring = 1000;
    replace_hinges_by_springs(strip, spring);
    const Elastica exact = heavy_elastica(gamma, 3);
    for (Vec3& x : strip.cloth.particles.x) {  // flat it would have no stiffness
      if (x.x() > 0) x.z() = -exact.height * o.length * std::pow(x.x() / o.length, 5.0 / 3);
    }
    // M = B_3 curvature^3 with B_3 = 0.0608929 k edge^4,  Gamma_3 = density g L^5 / B_3.
    const double rigidity = 0.0608929 * spring * std::pow(edge, 4);
    const double gravity = gamma * rigidity / (o.density * std::pow(o.length, 5));
    // The smaller load is a gravity of 1.7e-4 m/s^2. There round-off of the energy hides descents below 0.2
    // weights, which are within 2 nm of the rest.
    CHECK(find_rest(strip.cloth, down_to(k ? 0.01 : 1, {0, 0, -gravity})).converged);
    drop[k] = -strip.tip().z() / o.length;
    CHECK(drop[k] == Approx(exact.height).epsilon(0.01));
  }
  CHECK(std::log10(drop[1] / drop[0]) / 2 == Approx(1.0 / 3).margin(0.01));
}

TEST_CASE("buckling: a standing strip and a strip on edge lose their stability where theory says",
          "[release]") {
  StripOptions o;
  o.rows = 46;  // width / length = 0.1
  const Strip strip = equilateral_strip(o);
  // Greenhill's 7.8373 (1 - nu^2) and Timoshenko's lateral buckling with the lattice's nu = -1/3.
  CHECK(critical_gamma(strip, {-1, 0, 0}, 6, 8.5) == Approx(7.837347438943 * 8 / 9).epsilon(0.05));
  CHECK(critical_gamma(strip, {0, -1, 0}, 18, 24) == Approx(20.9901076079).epsilon(0.05));
}

TEST_CASE("buckling: a strip between two clamps rises as the elastica does", "[release]") {
  for (const auto& [shortening, height] : {std::pair{0.1, 0.194924311376}, {0.3, 0.314312612956}}) {
    StripOptions o;
    o.rows = 32;
    o.far_clamp = true;
    Strip strip = equilateral_strip(o);
    for (Vec3& x : strip.cloth.particles.x) {
      const double s = std::clamp(x.x() / o.length, 0.0, 1.0);
      x += o.length * Vec3(-shortening * s, 0, 0.5 * height * (1 - std::cos(2 * std::numbers::pi * s)));
    }
    const Settled report = find_rest(strip.cloth, down_to(1e-6, Vec3::Zero()));
    CHECK(report.converged);
    CHECK(report.stable);
    CHECK(strip.middle(17).z() / o.length == Approx(height).epsilon(0.01));
  }
}
