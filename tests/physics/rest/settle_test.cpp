// SPDX-License-Identifier: GPL-3.0-or-later
#include "physics/rest/settle.h"

#include <catch2/catch.hpp>
#include <limits>

#include "physics/base/cancel_scope.h"
#include "physics/cloth/elastic_band.h"
#include "physics/cloth/elements.h"
#include "physics/cloth/pins.h"
#include "physics/contact/residual_force.h"
#include "tests/physics/body/test_bodies.h"
#include "tests/physics/cloth/shell_cloths.h"
#include "tests/physics/cloth/test_cloths.h"

using namespace furrow::physics;
using namespace furrow::tests;

namespace {

/// A floor that falls by `slope` radians towards +x.
struct Incline : Collider {
  Vec3 normal;
  explicit Incline(double slope) : normal(std::sin(slope), std::cos(slope), 0) {}
  SignedDistance at(const Vec3& x) const override { return {x.dot(normal), normal}; }
};

/// One particle of 1 g on the incline, a little nearer than the gap.
Cloth lying(const Incline& incline) {
  Cloth cloth;
  add_particle(cloth, 0.0029 * incline.normal, 1e-3);
  return cloth;
}

/// Triangles and hinges, level, side by side with the origin.
Cloth membrane_sheet(int cells) {
  Cloth cloth = without_springs(sheet(cells, cells, 0.02));
  add_membrane(cloth, 300);
  add_hinges(cloth, 1e-5);
  for (Vec3& x : cloth.particles.x) x = Vec3(x.x() - 0.01 * cells, 0, x.y() + 0.0087 * cells);
  return cloth;
}

}  // namespace

TEST_CASE("settle: friction holds a particle on an incline up to its cone, and not beyond") {
  const double mu = 0.4;
  for (const double share : {0.5, 0.95, 1.05, 1.3}) {
    CAPTURE(share);
    const Incline incline(std::atan(share * mu));
    Cloth cloth = lying(incline);
    const SettleReport report =
        settle(cloth, &incline, {.friction = mu, .tolerance = 1e-6, .max_iterations = 100});
    CHECK(report.converged == (share < 1));
    if (share < 1) {
      CHECK(report.touching == 1);
      CHECK(cloth.particles.x[0].norm() < 0.004);  // it stays
    }
  }
}

TEST_CASE("settle: a cloth over a ball rests in the friction cone, the same bits on any number of threads",
          "[long]") {
  const Sphere ball(Vec3(0, -0.101, 0), 0.1);
  const auto run = [&](int threads) {
    Cloth cloth = membrane_sheet(12);
    SettleOptions o;
    o.threads = threads;
    o.max_iterations = 400;
    Noise noise(5);
    for (Vec3& x : cloth.particles.x) x += 1e-4 * noise.vector();
    const SettleReport report = settle(cloth, &ball, o);
    CHECK(report.converged);
    CHECK(report.residual == Approx(residual_force(cloth, o.gravity, &ball, o.friction, o.gap)).margin(1e-9));
    CHECK(report.touching > 3);
    for (const Vec3& x : cloth.particles.x) CHECK(ball.at(x).value > 0);
    return cloth.particles.x;
  };
  const auto one = run(1);
  CHECK(run(1) == one);
  CHECK(run(3) == one);
}

TEST_CASE("settle: a banner of so many particles that factors are of single precision hangs in balance",
          "[release]") {
  const auto run = [&](int threads) {
    Cloth cloth = membrane_sheet(102);
    std::vector<int> top;
    for (std::size_t i = 0; i < cloth.particles.size(); ++i) {
      Vec3& x = cloth.particles.x[i];
      x = Vec3(x.x(), x.z(), 0);
      top.push_back(int(i));
    }
    std::erase_if(top,
                  [&](int i) { return cloth.particles.x[i].y() < cloth.particles.x[top[0]].y() - 1e-9; });
    pin(cloth.particles, top);
    Noise noise(5);
    for (std::size_t i = 0; i < cloth.particles.size(); ++i)
      if (cloth.particles.inv_mass[i] > 0) cloth.particles.x[i] += 1e-4 * noise.vector();
    SettleOptions o;
    o.threads = threads;
    const SettleReport report = settle(cloth, nullptr, o);
    CHECK(report.converged);
    CHECK(residual_force(cloth, o.gravity, nullptr, o.friction, o.gap) <= o.tolerance);
    return cloth.particles.x;
  };
  const auto one = run(1);
  REQUIRE(one.size() > 10000);
  CHECK(run(2) == one);
}

TEST_CASE("settle: cloth between two limbs rests where there is less room than the gap") {
  struct Limbs : Collider {  // 2 mm apart at the origin: the distance has a ridge between them
    Sphere left{Vec3(-0.051, 0, 0), 0.05}, right{Vec3(0.051, 0, 0), 0.05};
    SignedDistance at(const Vec3& x) const override {
      const SignedDistance l = left.at(x), r = right.at(x);
      return l.value < r.value ? l : r;
    }
  } limbs;
  Cloth cloth = membrane_sheet(10);
  for (Vec3& x : cloth.particles.x) x = Vec3(0.0004 + 0.1 * x.y(), x.x(), x.z());  // upright, between them
  double top = 0;
  for (const Vec3& x : cloth.particles.x) top = std::max(top, x.y());
  for (std::size_t i = 0; i < cloth.particles.size(); ++i)
    if (cloth.particles.x[i].y() > top - 0.005) cloth.particles.inv_mass[i] = 0;
  const SettleReport report = settle(cloth, &limbs, {.friction = 0});
  CHECK(report.converged);
  double nearest = 1;
  for (const Vec3& x : cloth.particles.x) nearest = std::min(nearest, limbs.at(x).value);
  CHECK(nearest > 0);
  CHECK(nearest < 0.002);
}

TEST_CASE("settle: a tight ring on a pole keeps the energy that the gap gives it, as contact gets stiffer") {
  struct Pole : Collider {
    SignedDistance at(const Vec3& x) const override {
      const Vec3 out(x.x(), 0, x.z());
      return {out.norm() - 0.05, out.normalized()};
    }
  } pole;
  const int n = 40;
  const double radius = 0.053, chord = 2 * radius * std::sin(3.14159265358979 / n), k = 200,
               rest = 0.95 * chord;
  Cloth ring;
  for (int i = 0; i < n; ++i) {
    const double angle = 2 * 3.14159265358979 * i / n;
    add_particle(ring, 1.01 * Vec3(radius * std::cos(angle), 0, radius * std::sin(angle)), 1e-4);
  }
  for (int i = 0; i < n; ++i)
    ring.structural.push_back({std::min(i, (i + 1) % n), std::max(i, (i + 1) % n), rest, k});
  const double exact = n * 0.5 * k * (chord - rest) * (chord - rest);
  const SettleOptions o{.gravity = Vec3::Zero(), .friction = 0};
  const SettleReport as_it_comes = settle(ring, &pole, o);
  REQUIRE(as_it_comes.converged);
  CHECK(as_it_comes.deepest > 5e-5);
  const double soft = potential_energy(ring, ring.particles.x);
  CHECK(soft < 0.97 * exact);
  for (const double depth : {1e-5, 1e-7}) {
    SettleOptions stiff = o;
    stiff.contact_depth = depth;
    Cloth cloth = ring;
    const SettleReport report = settle(cloth, &pole, stiff);
    CHECK(report.converged);
    CHECK(report.touching == n);
    CHECK(report.deepest <= depth);
    CHECK(report.deepest > 0);
    const double lost = 1 - potential_energy(cloth, cloth.particles.x) / exact;
    const double chord_lost = chord * report.deepest / radius;  // what that depth takes from each spring
    CHECK(lost == Approx(2 * chord_lost / (chord - rest)).epsilon(0.02));
  }
}

TEST_CASE("settle: the observer stops it, and options out of range change nothing") {
  Cloth cloth = membrane_sheet(5);
  cloth.particles.inv_mass[0] = cloth.particles.inv_mass[4] = 0;
  Cloth copy = cloth;
  int calls = 0;
  const SettleReport stopped = settle(copy, nullptr, {}, [&](const SettleProgress& p) {
    CHECK(p.iteration == calls);
    return ++calls < 3;
  });
  CHECK(stopped.stopped);
  CHECK(stopped.iterations == 2);
  CHECK_FALSE(stopped.converged);
  const auto before = cloth.particles.x;
  CHECK_THROWS_WITH(settle(cloth, nullptr, {.friction = -1}), Catch::Contains("friction = -1"));
  CHECK_THROWS_WITH(settle(cloth, nullptr, {.gap = 0}), Catch::Contains("gap = 0"));
  CHECK_THROWS_WITH(settle(cloth, nullptr, {.contact_depth = 1e-8}), Catch::Contains("contact_depth"));
  CHECK_THROWS_WITH(settle(cloth, nullptr, {.tolerance = 0}), Catch::Contains("tolerance"));
  CHECK_THROWS_WITH(settle(cloth, nullptr, {.threads = 0}), Catch::Contains("threads"));
  cloth.particles.x[3].y() = std::numeric_limits<double>::quiet_NaN();
  CHECK_THROWS_WITH(settle(cloth, nullptr, {}), Catch::Contains("position"));
  cloth.particles.x[3] = before[3];
  CHECK(cloth.particles.x == before);
}

TEST_CASE(
    "settle: cancelled within an iteration it stays where the last move led, and goes on to rest from "
    "there") {
  const Sphere ball(Vec3(0, -0.1, 0), 0.097);
  const Cloth start = membrane_sheet(8);
  Cloth cloth = start;
  const SettleReport whole = settle(cloth, &ball, {.tolerance = 1e-6});
  REQUIRE(whole.converged);
  for (const int at : {1, 2, 3, 5, 12}) {
    CAPTURE(at);
    Cloth stopped = start;
    int questions = 0;
    const SettleReport report = [&] {
      const CancelScope scope([&] { return ++questions >= at; });
      return settle(stopped, &ball, {.tolerance = 1e-6});
    }();
    CHECK(report.stopped);
    CHECK_FALSE(report.converged);
    CHECK(questions <= at + 1);  // a move that follows another is broken off, then the search
    CHECK(report.iterations < whole.iterations);
    if (at <= 2) CHECK(stopped.particles.x == start.particles.x);  // 2: within the first factorisation
    CHECK(settle(stopped, &ball, {.tolerance = 1e-6}).converged);
  }
}

TEST_CASE("elastic_band: a ring of particles contracts to the band's length") {
  Cloth cloth;
  std::vector<int> ring;
  for (int i = 0; i < 12; ++i) {
    const double angle = 2 * 3.14159265358979 * i / 12;
    add_particle(cloth, {std::cos(angle), 0, std::sin(angle)}, 0.01);
    ring.push_back(i);
  }
  add_elastic_band(cloth, ring, {.length = 0.8, .stiffness = 50});
  REQUIRE(cloth.bending.size() == 12);
  for (std::size_t i = 1; i < 12; ++i)
    CHECK(std::pair(cloth.bending[i - 1].a, cloth.bending[i - 1].b) <
          std::pair(cloth.bending[i].a, cloth.bending[i].b));
  for (const Spring& s : cloth.bending) CHECK(s.rest_length * s.stiffness == Approx(50));
  settle(cloth, nullptr, {.gravity = Vec3::Zero(), .tolerance = 1e-9, .longest_move = 1});
  double length = 0;
  for (int i = 0; i < 12; ++i) length += (cloth.particles.x[i] - cloth.particles.x[(i + 1) % 12]).norm();
  CHECK(length == Approx(0.8 * 24 * std::sin(3.14159265358979 / 12)).epsilon(1e-6));
  CHECK_THROWS_WITH(add_elastic_band(cloth, std::vector<int>{0, 1}, {}), Catch::Contains("2 particles"));
  CHECK_THROWS_WITH(add_elastic_band(cloth, ring, {.length = 0}), Catch::Contains("length = 0"));
  CHECK_THROWS_WITH(add_elastic_band(cloth, std::vector<int>{0, 1, 99}, {}), Catch::Contains("99"));
  CHECK(cloth.bending.size() == 12);
}
