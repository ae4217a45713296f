// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

#include "physics/body/distance_field.h"
#include "physics/body/posed_collider.h"
#include "tests/physics/body/field_inputs.h"

using namespace furrow::physics;
using furrow::tests::uniform;

namespace {

DistanceField ball() {
  DistanceFieldOptions options;
  options.tolerance = 1e-3;
  return DistanceField::build(furrow::tests::sphere(32, 0.4), options);
}

/// Near the surface; on faces of the finest lattice along those axes whose bit is set.
Vec3 near_surface(std::mt19937_64& random, const DistanceField& field, unsigned axes) {
  Vec3 x;
  do x = {uniform(random, -1, 1), uniform(random, -1, 1), uniform(random, -1, 1)};
  while (x.norm() > 1 || x.norm() < 0.1);
  x = uniform(random, 0.39, 0.42) * x.normalized();
  const double cell = field.size() / 1024;
  for (int k = 0; k < 3; ++k)
    if (axes >> k & 1) x[k] = field.low()[k] + cell * std::round((x[k] - field.low()[k]) / cell);
  return x;
}

double jump(const DistanceField& field, const Vec3& x, int axis, bool smooth) {
  const Vec3 e = 1e-12 * Vec3::Unit(axis);
  const auto gradient = [&](const Vec3& y) { return (smooth ? field.smooth_at(y) : field.at(y)).gradient; };
  return (gradient(x + e) - gradient(x - e)).norm();
}

}  // namespace

TEST_CASE("distance_field: a smooth distance has no kinks where the sampled one has") {
  const DistanceField field = ball();
  std::mt19937_64 random(3);
  double sampled = 0, smooth = 0, in_value = 0, border = 0;
  for (int i = 0; i < 4000; ++i) {
    const int axis = i % 3;
    const Vec3 x = near_surface(random, field, 1u << axis | unsigned(random() & 7));
    sampled = std::max(sampled, jump(field, x, axis, false));
    smooth = std::max(smooth, jump(field, x, axis, true));
    in_value = std::max(in_value, std::abs(field.smooth_at(x).value - field.at(x).value));
    for (const double side : {-5e-5, 5e-5})  // where averaging begins
      border = std::max(border, jump(field, x + side * Vec3::Unit(axis), axis, true));
  }
  CHECK(sampled > 0.01);
  CHECK(smooth < 1e-7);
  CHECK(border < 1e-7);
  CHECK(in_value < 1e-5);
  CHECK(in_value > 0);
}

TEST_CASE("distance_field: a smooth distance's gradient is its value's derivative, at faces, too") {
  const DistanceField field = ball();
  std::mt19937_64 random(4);
  for (int i = 0; i < 300; ++i) {
    const Vec3 x = near_surface(random, field, unsigned(i & 7)) +
                   2e-5 * Vec3(uniform(random, -1, 1), uniform(random, -1, 1), uniform(random, -1, 1));
    const Vec3 gradient = field.smooth_at(x).gradient;
    for (int k = 0; k < 3; ++k) {
      const Vec3 e = 1e-7 * Vec3::Unit(k);
      const double slope = (field.smooth_at(x + e).value - field.smooth_at(x - e).value) / 2e-7;
      REQUIRE(slope == Approx(gradient[k]).margin(2e-4));
    }
  }
}

TEST_CASE(
    "distance_field: a smooth distance is the sampled one's away from faces, and of no number for none") {
  const DistanceField field = ball();
  std::mt19937_64 random(5);
  const double cell = field.size() / 1024;
  for (int i = 0; i < 300; ++i) {
    const Vec3 x = near_surface(random, field, 7) + 0.3 * cell * Vec3(1, -1, 1);
    REQUIRE(field.smooth_at(x).value == field.at(x).value);
    REQUIRE(field.smooth_at(x).gradient == field.at(x).gradient);
  }
  CHECK(std::isnan(field.smooth_at({0, std::numeric_limits<double>::quiet_NaN(), 0}).value));
  const Vec3 far(30, 0, 0);
  CHECK(field.smooth_at(far).value == Approx(field.at(far).value));
}

TEST_CASE("distance_field: a posed body is as smooth as the body") {
  const DistanceField field = ball();
  const Pose pose{Eigen::Quaterniond(Eigen::AngleAxisd(0.5, Vec3::UnitZ())), Vec3(1, 2, 3)};
  const PosedCollider posed(field, pose);
  std::mt19937_64 random(6);
  for (int i = 0; i < 100; ++i) {
    const Vec3 x = near_surface(random, field, 7);
    const SignedDistance here = field.smooth_at(x),
                         there = posed.smooth_at(pose.rotation * x + Vec3(1, 2, 3));
    REQUIRE(there.value == Approx(here.value).margin(1e-12));
    REQUIRE((there.gradient - pose.rotation * here.gradient).norm() < 1e-6);
  }
}
