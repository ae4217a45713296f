// SPDX-License-Identifier: GPL-3.0-or-later
#include "physics/rest/invert_elements.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <numbers>

#include "physics/cloth/carried_angle.h"
#include "physics/cloth/hinge_forces.h"
#include "physics/cloth/membrane.h"
#include "tests/physics/cloth/test_cloths.h"

using namespace furrow::physics;
using namespace furrow::tests;

namespace {

/// dW/d(l^2) of the triangle's edges as the membrane's forces tell.
Eigen::Vector3d tensions(const MembraneTriangle& t, const std::array<Vec3, 3>& x) {
  const MembraneConstants c = membrane_constants(t);
  Eigen::Vector3d d;
  for (int i = 0; i < 3; ++i) d[i] = (x[(i + 2) % 3] - x[(i + 1) % 3]).squaredNorm() - c.length2[i];
  return c.quadratic * d;
}

}  // namespace

TEST_CASE("invert_elements: a spring gets the length that makes its tension") {
  for (const double t : {-3.0, 0.0, 0.01, 40.0}) {
    const double rest = *rest_length_for(0.7, 100, t);
    CHECK(100 * (0.7 - rest) == Approx(t).margin(1e-12 * 70));
  }
  CHECK(*rest_length_for(0.7, 100, 0) == 0.7);
  CHECK_FALSE(rest_length_for(0.7, 100, 70));
  CHECK(*rest_length_for(0.7, 0, 0) == 0.7);
  CHECK_FALSE(rest_length_for(0.7, 0, 1));
}

TEST_CASE("invert_elements: a hinge gets the angle that makes its moment, by either law, across the jump") {
  const double k = 3e-5;
  for (const HingeLaw law : {HingeLaw::linear, HingeLaw::cosine}) {
    for (const double theta : {0.0, 0.4, -3.0, 3.1}) {
      for (const double share : {-1.9, -0.3, -1e-9, 0.0, 1e-9, 0.3, 1.9}) {
        const double rest = *rest_angle_for(law, k, theta, share * k);
        CHECK(std::abs(rest) <= std::numbers::pi);
        const double moment = hinge_moment(law, k, bend(theta, rest)).moment;
        // 1 - cos of an angle that is known to 1e-16 is known to 1e-16 times its slope.
        CHECK(std::abs(moment / k - share) <= 2e-15);
      }
      CHECK(*rest_angle_for(law, k, theta, 0) == theta);
    }
  }
  CHECK_FALSE(rest_angle_for(HingeLaw::cosine, k, 0, 2.001 * k));
  CHECK_FALSE(rest_angle_for(HingeLaw::linear, k, 0, -3.2 * k));
  CHECK_FALSE(rest_angle_for(HingeLaw::linear, 0, 0, 1e-9));
}

TEST_CASE("invert_elements: a triangle gets the lengths that make its tensions") {
  Noise noise(5);
  for (const double poisson : {-0.5, 0.0, 0.3, 0.9}) {
    const PlaneLame lame = plane_stress(300, poisson);
    for (int i = 0; i < 200; ++i) {
      const std::array<Vec3, 3> x{Vec3(0, 0, 0), Vec3(0.01, 0, 0) + 0.003 * noise.vector(),
                                  Vec3(0.004, 0.008, 0) + 0.003 * noise.vector()};
      MembraneTriangle start{{0, 1, 2}, {}, lame.lambda, lame.mu};
      for (int e = 0; e < 3; ++e)
        start.rest_lengths[e] = (x[(e + 2) % 3] - x[(e + 1) % 3]).norm() * (1 + 0.02 * noise());
      const Eigen::Vector3d wanted = tensions(start, x);
      const auto rest = rest_lengths_for(x, lame.lambda, lame.mu, wanted);
      REQUIRE(rest);
      MembraneTriangle found = start;
      found.rest_lengths = *rest;
      const double size = lame.lambda + 2 * lame.mu;
      CHECK((tensions(found, x) - wanted).norm() <= 1e-12 * std::max(size, wanted.norm()));
      // The metric is given back: the law is one to one near rest.
      for (int e = 0; e < 3; ++e) CHECK((*rest)[e] == Approx(start.rest_lengths[e]).epsilon(1e-9));
    }
  }
}

TEST_CASE("invert_elements: one axis bears compression to the law's limit and no further") {
  const std::array<Vec3, 3> x{Vec3(0, 0, 0), Vec3(0.01, 0, 0), Vec3(0, 0.01, 0)};
  // A stress along x alone: sigma A = 2 s e e^T of the edge along x, which is opposite corner 2.
  const PlaneLame lame = plane_stress(1, 0);
  const auto along_x = [&](double sigma) {
    return rest_lengths_for(x, lame.lambda, lame.mu, Eigen::Vector3d(0, 0, sigma * 0.25));
  };
  const double c = std::pow(0.01 / (*along_x(-0.15))[2], 2);
  CHECK(std::sqrt(c) * (c - 1) / 2 == Approx(-0.15));  // nu = 0
  CHECK((*along_x(-0.15))[1] == Approx(0.01).epsilon(1e-14));
  CHECK(along_x(-0.192));
  CHECK_FALSE(along_x(-0.193));  // its largest is 1 / sqrt(27)
  CHECK(along_x(0.5));
}

TEST_CASE("invert_elements: the law has an answer to all stresses that prestress may ask for") {
  Noise noise(8);
  for (const double poisson : {-0.5, 0.0, 0.3, 0.5}) {
    const PlaneLame lame = plane_stress(300, poisson);
    for (int i = 0; i < 300; ++i) {
      const std::array<Vec3, 3> x{Vec3(0, 0, 0), Vec3(0.01, 0, 0) + 0.003 * noise.vector(),
                                  Vec3(0.004, 0.008, 0) + 0.003 * noise.vector()};
      MembraneTriangle t{{0, 1, 2}, {}, lame.lambda, lame.mu};
      for (int e = 0; e < 3; ++e) t.rest_lengths[e] = (x[(e + 2) % 3] - x[(e + 1) % 3]).norm();
      const MembraneConstants c = membrane_constants(t);
      // The energy of a strain of 0.15 along one axis, as ClampedElements limits it.
      const Vec3 d = noise.vector();
      const double scale = 0.15 * std::sqrt(c.area * 300 / d.dot(c.quadratic * d));
      CHECK(rest_lengths_for(x, lame.lambda, lame.mu, scale * c.quadratic * d));
    }
  }
}

TEST_CASE("invert_elements: a triangle with threads gets the lengths and the angle that make its tensions") {
  Noise noise(11);
  for (const WovenModuli moduli :
       {WovenModuli{450, 450, 50, 0}, WovenModuli{1000, 500, 30, 0.2}, WovenModuli{300, 600, 40, 0.1}}) {
    const WovenSheet sheet = woven_sheet(moduli);
    for (int i = 0; i < 200; ++i) {
      const std::array<Vec3, 3> x{Vec3(0, 0, 0), Vec3(0.01, 0, 0) + 0.003 * noise.vector(),
                                  Vec3(0.004, 0.008, 0) + 0.003 * noise.vector()};
      const std::array<double, 3> lying{(x[2] - x[1]).norm(), (x[0] - x[2]).norm(), (x[1] - x[0]).norm()};
      MembraneTriangle start{{0, 1, 2}, {}, sheet.lame.lambda, sheet.lame.mu};
      start.threads = {3 * noise(), sheet.warp, sheet.weft};
      for (std::size_t e = 0; e < 3; ++e) start.rest_lengths[e] = lying[e] * (1 + 0.01 * noise());
      const Eigen::Vector3d wanted = tensions(start, x);
      const double along = carried_angle(start.threads.angle, start.rest_lengths, lying);
      const auto rest = rest_of_woven(x, start, along, wanted);
      REQUIRE(rest);
      MembraneTriangle found = start;
      found.rest_lengths = rest->lengths, found.threads.angle = rest->angle;
      CHECK((tensions(found, x) - wanted).norm() <= 1e-12 * std::max(moduli.warp, wanted.norm()));
      // The metric is given back, and the thread runs where it ran.
      for (std::size_t e = 0; e < 3; ++e)
        CHECK(rest->lengths[e] == Approx(start.rest_lengths[e]).epsilon(1e-9));
      CHECK(std::abs(std::sin(rest->angle - start.threads.angle)) < 1e-9);
      CHECK(carried_angle(rest->angle, rest->lengths, lying) == Approx(along).epsilon(1e-9));
      // Another first corner tells the same cloth.
      const std::array<Vec3, 3> turned{x[1], x[2], x[0]};
      const Vec3 first = (x[1] - x[0]).normalized(), second = (x[2] - x[1]).normalized();
      const double between = std::acos(std::clamp(first.dot(second), -1.0, 1.0));
      const auto same = rest_of_woven(turned, start, along - between, {wanted[1], wanted[2], wanted[0]});
      REQUIRE(same);
      for (std::size_t e = 0; e < 3; ++e)
        CHECK(same->lengths[e] == Approx(rest->lengths[(e + 1) % 3]).epsilon(1e-11));
    }
  }
}

TEST_CASE("invert_elements: threads under a known pull, and no threads as the law without them") {
  const std::array<Vec3, 3> x{Vec3(0, 0, 0), Vec3(0.01, 0, 0), Vec3(0.003, 0.01, 0)};
  const WovenSheet sheet = woven_sheet({1000, 500, 30, 0});
  MembraneTriangle t{{0, 1, 2}, {}, sheet.lame.lambda, sheet.lame.mu};
  t.threads = {0, sheet.warp, sheet.weft};
  // Pulled along x alone, which is the warp: sigma A = 2 s e e^T, and a (a^2 - 1) Y1 / 2 = sigma with c = 1.
  const double area = 5e-5, sigma = 40;
  const auto warp = rest_of_woven(x, t, 0, Eigen::Vector3d(0, 0, sigma * area / (2 * 1e-4)));
  REQUIRE(warp);
  const double a = 0.01 / warp->lengths[2];
  CHECK(1000 * a * (a * a - 1) / 2 == Approx(sigma).epsilon(1e-12));
  CHECK(warp->angle == Approx(0).margin(1e-15));
  CHECK(warp->lengths[0] == Approx(std::hypot(0.007 / a, 0.01)).epsilon(1e-12));
  // No tension: it lies at rest.
  const auto none = rest_of_woven(x, t, 0.7, Eigen::Vector3d::Zero());
  CHECK(none->angle == Approx(0.7).epsilon(1e-14));
  for (std::size_t e = 0; e < 3; ++e)
    CHECK(none->lengths[e] == Approx((x[(e + 2) % 3] - x[(e + 1) % 3]).norm()).epsilon(1e-14));
  // The same in all directions.
  const PlaneLame lame = plane_stress(300, 0.3);
  const MembraneTriangle plain{{0, 1, 2}, {}, lame.lambda, lame.mu};
  const Eigen::Vector3d tension(3, -2, 7);
  const auto straight = rest_lengths_for(x, lame.lambda, lame.mu, tension);
  const auto turned = rest_of_woven(x, plain, 1.1, tension);
  REQUIRE((straight && turned));
  for (std::size_t e = 0; e < 3; ++e) CHECK(turned->lengths[e] == Approx((*straight)[e]).epsilon(1e-12));
  // It bears no more compression than the law does.
  CHECK_FALSE(rest_of_woven(x, t, 0, Eigen::Vector3d(0, 0, -0.2 * 1000 * area / (2 * 1e-4))));
}
