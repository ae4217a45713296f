// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>
#include <limits>

#include "physics/cloth/pins.h"
#include "physics/contact/residual_force.h"
#include "physics/rest/settle.h"
#include "tests/physics/body/test_bodies.h"
#include "tests/physics/cloth/tension_cloths.h"

using namespace furrow::physics;
using namespace furrow::tests;

namespace {

constexpr double g = 9.81;
constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

/// Straight down (or along x) from a pin, or between two; all springs strained by `strain`.
Cloth straight_chain(int springs, double rest, double mass, double stretch, const Vec3& along,
                     double strain = 0, bool both_pinned = false) {
  Cloth cloth;
  for (int i = 0; i <= springs; ++i) {
    add_particle(cloth, i * rest * (1 + strain) * along, mass);
    if (i > 0) cloth.tension.push_back({i - 1, i, rest, stretch, 0});
  }
  pin(cloth.particles, both_pinned ? std::vector<int>{0, springs} : std::vector<int>{0});
  return cloth;
}

DisplaceOutcome outcome(Cloth cloth, const Collider* body, const DisplaceOptions& options) {
  return displace_by_force(cloth, body, options).outcome;
}

}  // namespace

TEST_CASE("displace_by_force: a vertical chain of tension comes to e = sqrt(T / c)", "[displace]") {
  const int n = 10;
  const double rest = 0.1, mass = 0.01, c = 10;
  Cloth cloth = straight_chain(n, rest, mass, c, -Vec3::UnitY());
  DisplaceOptions options;
  options.tolerance = 1e-9;
  const DisplaceReport report = displace_by_force(cloth, nullptr, options);
  CAPTURE(report.passes, report.rate, report.residual);
  CHECK(report.outcome == DisplaceOutcome::converged);
  CHECK(report.residual == residual_force(cloth, options.gravity, nullptr, 0, options.gap));
  for (int i = 0; i < n; ++i) {
    const double strain = (cloth.particles.x[i + 1] - cloth.particles.x[i]).norm() / rest - 1;
    CHECK(strain == Approx(std::sqrt((n - i) * mass * g / c)).epsilon(1e-7));
  }
}

TEST_CASE("displace_by_force: a level chain of tension has the exact sag", "[displace]") {
  // 0.8 m, 1 m long, 0.5 N/m, T = 10000 N/m^2 times the square of the elongation, by shooting.
  const int n = 20;
  const double rest = 1.0 / n, exact = 0.328488467273;
  Cloth cloth;
  for (int i = 0; i <= n; ++i) {
    const double t = double(i) / n;
    add_particle(cloth, {0.8 * t, -4 * 0.25 * t * (1 - t), 0}, 0.5 * rest / g);
    if (i > 0) cloth.tension.push_back({i - 1, i, rest, 1e4 * rest * rest, 0});
  }
  pin(cloth.particles, std::vector<int>{0, n});
  DisplaceOptions options;
  options.tolerance = 1e-7;
  options.max_passes = 200000;
  const DisplaceReport report = displace_by_force(cloth, nullptr, options);
  CAPTURE(report.passes, report.rate);
  CHECK(report.outcome == DisplaceOutcome::converged);
  CHECK(-cloth.particles.x[n / 2].y() == Approx(exact).margin(1e-6));
}

TEST_CASE("displace_by_force: an evenly strained chain is stable below alpha c e / L = 1/4", "[displace]") {
  const int n = 20;
  const double rest = 0.05, c = 10, strain = 0.1;
  Cloth cloth = straight_chain(n, rest, 0.01, c, Vec3::UnitX(), strain, true);
  for (int i = 1; i < n; ++i) cloth.particles.x[i].x() += i % 2 ? 1e-6 : -1e-6;
  DisplaceOptions options;
  options.gravity.setZero();
  options.tolerance = 1e-7;
  const auto at = [&](double number, bool cap) {
    options.cap = cap;
    options.rate = number * rest / (c * strain);
    return outcome(cloth, nullptr, options);
  };
  const double exact = 0.25 / std::pow(std::cos(1.5707963267948966 / n), 2);  // of n springs
  for (const bool cap : {false, true}) {
    CHECK(at(0.98 * exact, cap) == DisplaceOutcome::converged);
    CHECK(at(1.02 * exact, cap) == DisplaceOutcome::limit_cycle);  // slack springs let go
  }
  CHECK(at(1.6 * exact, false) == DisplaceOutcome::diverged);
  CHECK(at(1.6 * exact, true) == DisplaceOutcome::limit_cycle);
}

TEST_CASE("displace_by_force: a hanging chain is stable at 0.25, in a limit cycle at 0.3", "[displace]") {
  const int n = 20;
  const double rest = 0.1, mass = 0.01, c = 10, strain = std::sqrt(n * mass * g / c);  // the largest
  const Cloth cloth = straight_chain(n, rest, mass, c, -Vec3::UnitY());
  DisplaceOptions options;
  const auto at = [&](double number) {
    options.rate = number * rest / (c * strain);
    return outcome(cloth, nullptr, options);
  };
  for (const bool cap : {false, true}) {
    options.cap = cap;
    CHECK(at(0.25) == DisplaceOutcome::converged);
    CHECK(at(0.30) == DisplaceOutcome::limit_cycle);
  }
}

TEST_CASE("displace_by_force: a strained sheet of valence 6 is stable at 1/12", "[displace]") {
  const double strain = 0.05, c = 10, edge = 0.02;
  Cloth cloth = with_tension(sheet(12, 12, edge), c, 0);
  cloth.bending.clear();
  for (Vec3& x : cloth.particles.x) x *= 1 + strain;
  Noise noise(3);
  for (int i = 0; i < 144; ++i) {
    const int row = i / 12, column = i % 12;
    if (row % 11 == 0 || column % 11 == 0)
      cloth.particles.inv_mass[std::size_t(i)] = 0;
    else
      cloth.particles.x[std::size_t(i)] += 1e-5 * noise.vector();
  }
  DisplaceOptions options;
  options.gravity.setZero();
  options.cap = false;
  options.rate = edge / (c * strain) / 12;
  CHECK(outcome(cloth, nullptr, options) == DisplaceOutcome::converged);
  options.rate *= 2.2;  // the lattice's own limit is 1/6
  CHECK(outcome(cloth, nullptr, options) == DisplaceOutcome::diverged);
}

TEST_CASE("displace_by_force: a force above the limit is replaced, its direction kept", "[displace]") {
  const double mass = 0.2, k = 50, weight = mass * g;
  DisplaceOptions options;
  options.rate = 1e-3;
  options.limit = 1;  // in mean weights, which are two of the pendulum's
  options.replacement = 0.625;
  options.max_passes = 1;
  const auto move = [&](const Vec3& pull) {  // of the spring to the origin
    Cloth cloth = pendulum(mass, k, 1, -(1 + pull.norm() / k) * pull.normalized());
    add_particle(cloth, Vec3(9, 9, 9), 3 * mass);  // falls
    const Vec3 before = cloth.particles.x[1];
    const DisplaceReport report = displace_by_force(cloth, nullptr, options);
    CHECK(report.passes == 1);
    return std::pair(Vec3(cloth.particles.x[1] - before), report.capped);
  };
  const Vec3 down(0, -weight, 0), large(3 * weight, 5 * weight, 0), small(1.2 * weight, 2.5 * weight, 0);
  const auto [far, replaced] = move(large);
  CHECK(replaced == 2);
  CHECK((far - 1e-3 * 1.25 * weight * (large + down).normalized()).norm() < 1e-15);
  const auto [near, kept] = move(small);  // its sum is 1.92 weights
  CHECK(kept == 1);
  CHECK((near - 1e-3 * (small + down)).norm() < 1e-15);
  options.cap = false;
  CHECK((move(large).first - 1e-3 * (large + down)).norm() < 1e-15);
}

TEST_CASE("displace_by_force: deterministic, watched, stopped, and nothing to do", "[displace]") {
  const Sphere ball(Vec3(0, -0.11, 0), 0.1);
  Cloth cloth = sheet(8, 8, 0.02, 0.2);
  cloth.particles.v[3] = Vec3(1, 2, 3);
  DisplaceOptions options;
  options.max_passes = 300;
  Cloth a = cloth, b = cloth;
  int calls = 0;
  const DisplaceReport first = displace_by_force(a, &ball, options, [&](const SettleProgress& now) {
    CHECK(now.iteration == calls++);
    return true;
  });
  CHECK(calls == first.passes + 1);
  displace_by_force(b, &ball, options);
  CHECK(a.particles.x == b.particles.x);
  CHECK(a.particles.v[3] == Vec3::Zero());

  const DisplaceReport stopped =
      displace_by_force(b, &ball, options, [](const SettleProgress& now) { return now.iteration < 2; });
  CHECK(stopped.outcome == DisplaceOutcome::stopped);
  CHECK(stopped.passes == 2);
  Cloth empty;
  CHECK(displace_by_force(empty, nullptr, options).outcome == DisplaceOutcome::converged);
  Cloth falling;
  add_particle(falling, Vec3::Zero(), 1);
  CHECK(outcome(falling, nullptr, options) == DisplaceOutcome::unfinished);
}

TEST_CASE("displace_by_force: it refuses bad options and cloths, and changes nothing", "[displace]") {
  Cloth cloth = pendulum(0.2, 40, 1, {0, -1, 0}, {1, 0, 0});
  const auto refuses = [&](const Cloth& bad, const DisplaceOptions& options, const char* name) {
    Cloth copy = bad;
    CHECK_THROWS_WITH(displace_by_force(copy, nullptr, options), Catch::Contains(name));
    CHECK(copy.particles.v == bad.particles.v);
    CHECK(copy.particles.x.back().y() == -1);
  };
  const auto with = [&](auto change, const char* name) {
    DisplaceOptions options;
    change(options);
    refuses(cloth, options, name);
  };
  with([](auto& o) { o.gravity.y() = not_a_number; }, "gravity");
  with([](auto& o) { o.friction = -0.1; }, "friction");
  with([](auto& o) { o.gap = 0; }, "gap");
  with([](auto& o) { o.tolerance = not_a_number; }, "tolerance");
  with([](auto& o) { o.max_passes = -1; }, "max_passes");
  with([](auto& o) { o.rate = -1; }, "rate");
  with([](auto& o) { o.limit = 0; }, "limit");
  with([](auto& o) { o.replacement = 2; }, "replacement");
  Cloth bad = cloth;
  bad.particles.x[0].x() = not_a_number;
  refuses(bad, {}, "position");
  bad = cloth;
  bad.particles.mass[1] = 0;
  refuses(bad, {}, "mass");
  bad = cloth;
  bad.particles.mass.pop_back();
  refuses(bad, {}, "masses");
  bad = cloth;
  bad.structural[0].b = 7;
  CHECK_THROWS_AS(displace_by_force(bad, nullptr, {}), std::invalid_argument);
}
