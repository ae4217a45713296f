// SPDX-License-Identifier: GPL-3.0-or-later
#include "bridge/arrays/reactions.h"

#include <catch2/catch.hpp>

#include "physics/cloth/elastic_band.h"
#include "physics/cloth/pins.h"
#include "physics/rest/settle.h"

using namespace furrow;
using physics::Vec3;

namespace {

constexpr double g = 9.81;

/// n + 1 particles of 10 g in a row along x, 0.1 m apart, joined by springs.
physics::Cloth chain(int n, double stiffness) {
  physics::Cloth cloth;
  for (int i = 0; i <= n; ++i) {
    cloth.particles.x.emplace_back(0.1 * i, 0, 0);
    cloth.particles.mass.push_back(0.01);
    cloth.particles.inv_mass.push_back(100);
    if (i > 0) cloth.structural.push_back({i - 1, i, 0.1, stiffness});
  }
  cloth.particles.v.assign(std::size_t(n) + 1, Vec3::Zero());
  return cloth;
}

}  // namespace

TEST_CASE("reactions: a chain between two pins hangs half on each, and pulls them together alike") {
  physics::Cloth cloth = chain(10, 500);
  physics::pin(cloth.particles, std::vector<int>{0, 10});
  physics::SettleOptions options;
  options.gravity = Vec3(0, -g, 0);
  options.tolerance = 1e-9;
  for (int i = 1; i < 10; ++i) cloth.particles.x[std::size_t(i)].y() = -0.01;
  REQUIRE(physics::settle(cloth, nullptr, options).converged);
  const std::vector<std::vector<int>> pins{{0}, {10}};
  const bridge::Reactions r = bridge::reactions(cloth, options.gravity, pins);
  CHECK(r.weight.y() == Approx(-0.11 * g));
  CHECK(r.held[0].y() == Approx(0.055 * g));
  CHECK(r.held[1].y() == Approx(0.055 * g));
  CHECK(r.held[0].x() < 0);
  CHECK(r.held[0].x() == Approx(-r.held[1].x()));
  CHECK(r.contact.norm() < 1e-8);
  CHECK((r.weight + r.contact + r.held[0] + r.held[1]).norm() < 1e-12);
}

TEST_CASE("reactions: all forces add up to none, at rest or not, and what is held in no group is left out") {
  physics::Cloth cloth = chain(4, 100);
  cloth.particles.x[2] += Vec3(0.03, 0.05, -0.02);
  physics::pin(cloth.particles, std::vector<int>{0, 4});
  const Vec3 gravity(0, -g, 0);
  const std::vector<std::vector<int>> both{{0, 4}}, twice{{0}, {0, 4}}, one{{0}}, none_such{{7}};
  const bridge::Reactions r = bridge::reactions(cloth, gravity, both);
  CHECK((r.weight + r.contact + r.held[0]).norm() < 1e-12);
  CHECK(r.contact.norm() > 0.1);
  const bridge::Reactions t = bridge::reactions(cloth, gravity, twice);
  CHECK((t.held[0] + t.held[1] - r.held[0]).norm() < 1e-12);
  CHECK(bridge::reactions(cloth, gravity, one).weight.y() == Approx(-0.04 * g));
  CHECK_THROWS_AS(bridge::reactions(cloth, gravity, none_such), std::out_of_range);
}

TEST_CASE("mean_tension: of a band that is drawn to twice its length, its stiffness") {
  physics::Cloth ring;
  for (int i = 0; i < 12; ++i) {
    const double a = 2 * 3.14159265358979 * i / 12;
    ring.particles.x.emplace_back(std::cos(a), 0, std::sin(a));
  }
  std::vector<int> loop(12);
  for (int i = 0; i < 12; ++i) loop[std::size_t(i)] = i;
  physics::add_elastic_band(ring, loop, {.length = 0.5, .stiffness = 50});
  CHECK(bridge::mean_tension(ring.bending, ring.particles.x) == Approx(50));
  CHECK(bridge::mean_tension({}, ring.particles.x) == 0);
}
