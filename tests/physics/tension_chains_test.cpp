// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>

#include "physics/pins.h"
#include "physics/simulate.h"
#include "physics/static_equilibrium.h"
#include "tests/physics/tension_cloths.h"

using namespace furrow::physics;
using namespace furrow::tests;

namespace {

constexpr double g = 9.81;

/// Chains of springs whose tension is c [N/m^2] times the square of their elongation [m], so stretch = c L^2.
/// Sags, lengths: an independent program's, by shooting.
struct Level {
  double span, length, weight;  // m, m, N/m
  int springs;
  double c, sag, largest_strain;
};
constexpr Level level_chains[] = {{1, 1.5, 0.981, 32, 50000, 0.563571437043, 0.0831902764289},
                                  {1, 1.2, 0.981, 32, 50000, 0.368253207641, 0.097719365154},
                                  {0.8, 1, 0.5, 20, 10000, 0.328488467273, 0.104302957897},
                                  {0.5, 1.5, 2, 40, 200000, 0.707915341417, 0.0723415752944}};

/// Both ends pinned on one level, masses within; as a parabola of the given depth.
Cloth level_chain(const Level& chain, double depth, double compress) {
  Cloth cloth;
  const double rest = chain.length / chain.springs, stretch = chain.c * rest * rest;
  for (int i = 0; i <= chain.springs; ++i) {
    const double t = double(i) / chain.springs;
    add_particle(cloth, {chain.span * t, -4 * depth * t * (1 - t), 0}, chain.weight * rest / g);
    if (i > 0) cloth.tension.push_back({i - 1, i, rest, stretch, compress * stretch});
  }
  pin(cloth.particles, std::vector<int>{0, chain.springs});
  return cloth;
}

double lowest(const Cloth& cloth) {
  double y = 0;
  for (const Vec3& x : cloth.particles.x) y = std::min(y, x.y());
  return -y;
}

double largest_strain(const Cloth& cloth) {
  double e = 0;
  for (const Tension& t : cloth.tension)
    e = std::max(e, (cloth.particles.x[t.b] - cloth.particles.x[t.a]).norm() / t.rest_length - 1);
  return e;
}

struct Hanging {
  int springs;
  double length, mass, c, hanging_length, largest_extension;
};
constexpr Hanging hanging_chains[] = {{10, 1, 0.01, 1000, 1.22253805915, 0.0313209195267},
                                      {20, 1, 0.005, 1000, 1.43188202416, 0.0313209195267},
                                      {20, 0.5, 0.002, 250, 1.04629235073, 0.0396181776461},
                                      {50, 2, 0.004, 4000, 2.74868210747, 0.0221472345904}};

/// Pinned at the top, straight down, at rest: tension has no stiffness at all there.
Cloth hanging_at_rest(const Hanging& chain) {
  Cloth cloth;
  const double rest = chain.length / chain.springs;
  for (int i = 0; i <= chain.springs; ++i) {
    add_particle(cloth, {0, -rest * i, 0}, chain.mass);
    if (i > 0) cloth.tension.push_back({i - 1, i, rest, chain.c * rest * rest, 0});
  }
  pin(cloth.particles, std::vector<int>{0});
  return cloth;
}

}  // namespace

TEST_CASE("a vertical chain of tension hangs by e = sqrt(T / c) from its rest, where nothing is stiff") {
  for (const Hanging& chain : hanging_chains) {
    CAPTURE(chain.springs, chain.c);
    Cloth cloth = hanging_at_rest(chain);
    StaticOptions options;
    options.tolerance = 1e-10;
    const StaticReport report = find_static_equilibrium(cloth, options);
    CHECK(report.converged);
    CHECK(report.stable);
    double largest = 0, worst = 0;
    for (const Tension& t : cloth.tension) {
      const double extension = (cloth.particles.x[t.b] - cloth.particles.x[t.a]).norm() - t.rest_length;
      const double pull = (chain.springs - t.a) * chain.mass * g;
      worst = std::max(worst, std::abs(extension / t.rest_length - std::sqrt(pull / t.stretch)));
      largest = std::max(largest, extension);
    }
    CAPTURE(worst);
    CHECK(worst < 1e-9);
    CHECK(largest == Approx(chain.largest_extension).epsilon(1e-9));
    CHECK(lowest(cloth) == Approx(chain.hanging_length).epsilon(1e-9));
  }
}

TEST_CASE("level chains of tension have the exact sags, from a flat start, a deep one, with pushing or not") {
  for (const Level& chain : level_chains) {
    for (const double depth : {0.0, 0.7}) {
      for (const double compress : {0.0, 0.3}) {
        CAPTURE(chain.span, chain.length, depth, compress);
        Cloth cloth = level_chain(chain, depth, compress);
        if (depth == 0) cloth.particles.x[std::size_t(chain.springs / 3)].y() -= 1e-4;  // off the symmetry
        StaticOptions options;
        options.tolerance = 1e-8;
        CHECK(find_static_equilibrium(cloth, options).converged);
        CHECK(lowest(cloth) == Approx(chain.sag).margin(1e-8));
        CHECK(largest_strain(cloth) == Approx(chain.largest_strain).epsilon(1e-6));
      }
    }
  }
}

TEST_CASE("leapfrog, RK4 and backward Euler bring a chain of tension to the same rest") {
  const Level& chain = level_chains[2];
  Cloth exact = level_chain(chain, 0.4, 0.2);
  StaticOptions statics;
  statics.tolerance = 1e-10;
  CHECK(find_static_equilibrium(exact, statics).converged);
  for (const Integrator integrator : {Integrator::leapfrog, Integrator::rk4, Integrator::backward_euler}) {
    Cloth cloth = level_chain(chain, 0.4, 0.2);
    SimulateOptions options;
    options.integrator = integrator;
    options.seconds = 6;
    options.air_drag = 8;
    options.spring_damping = 0.2;
    const SimulateReport report = simulate(cloth, nullptr, options);
    CHECK(report.outcome == Outcome::finished);
    CHECK(report.spring_evaluations == report.force_evaluations * std::int64_t(cloth.tension.size()));
    double worst = 0;
    for (std::size_t i = 0; i < cloth.particles.size(); ++i)
      worst = std::max(worst, (cloth.particles.x[i] - exact.particles.x[i]).norm());
    CAPTURE(int(integrator), worst);
    CHECK(worst < 1e-5);
  }
}
