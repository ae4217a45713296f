// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>
#include <limits>

#include "physics/body/moving_body.h"
#include "tests/physics/body/test_bodies.h"
#include "tests/physics/cloth/test_cloths.h"

using namespace furrow::physics;
using namespace furrow::tests;

namespace {

constexpr double pi = 3.14159265358979323846;

bool equal(const Pose& a, const Pose& b, double tolerance) {
  return (a.rotation.toRotationMatrix() - b.rotation.toRotationMatrix()).norm() < tolerance &&
         (a.translation - b.translation).norm() < tolerance;
}

RigidMotion tumble() {
  RigidMotion motion;
  motion.pivot = Vec3(0.1, 0.2, 0.3);
  Noise noise(4);
  for (const double t : {0.0, 0.3, 0.5, 1.4, 2.0})
    motion.keyframes.push_back({t, noise.vector(), noise.vector()});
  motion.spin = Spin{Vec3(0, 1, 0), Vec3(1, 2, 0), 3, 0.2, 0.5};
  return motion;
}

}  // namespace

TEST_CASE("rigid_motion: no motion is the identity, and a keyframe holds before and after") {
  CHECK(equal(pose({}, 7), Pose{}, 1e-300));
  CHECK(at_rest({}));
  CHECK(is_identity({}));
  RigidMotion motion;
  motion.keyframes = {{1, {1, 2, 3}, {0, pi / 2, 0}}};
  CHECK(at_rest(motion));
  CHECK_FALSE(is_identity(motion));
  for (const double t : {-3.0, 1.0, 5.0}) {
    // A quarter turn about y takes z to x.
    CHECK((pose(motion, t).to_world({0, 0, 2}) - Vec3(3, 2, 3)).norm() < 1e-14);
    CHECK((pose(motion, t).to_body({3, 2, 3}) - Vec3(0, 0, 2)).norm() < 1e-14);
  }
  motion.keyframes.push_back({2, {1, 2, 4}, {0, pi / 2, 0}});
  CHECK_FALSE(at_rest(motion));
  CHECK(pose(motion, 1.5).translation.z() == 3.5);
}

TEST_CASE("rigid_motion: keyframes are met, a uniform motion stays uniform and no coordinate overshoots") {
  const RigidMotion motion = tumble();
  RigidMotion keys = motion;
  keys.spin.reset();
  for (const Keyframe& k : motion.keyframes) {
    const Pose p = pose(keys, k.time);
    CHECK((p.to_world(motion.pivot) - motion.pivot - k.translation).norm() < 1e-14);
    const Eigen::AngleAxisd turn(k.rotation.norm(), k.rotation.normalized());
    CHECK((p.rotation.toRotationMatrix() - turn.toRotationMatrix()).norm() < 1e-14);
  }
  const Vec3 v(1, -2, 0.5);
  for (const double t : {-1.0, -0.3, 0.2, 1.7, 2.99}) {
    CHECK((pose(uniform_motion(v, 3), t).translation - t * v).norm() < 1e-14);
  }
  for (int i = 0; i <= 400; ++i) {
    const double t = i / 200.0;
    const Vec3 at = pose(keys, t).to_world(keys.pivot) - keys.pivot;
    const auto next = std::find_if(keys.keyframes.begin(), keys.keyframes.end() - 1,
                                   [&](const Keyframe& k) { return k.time > t; });
    const Vec3 a = (next - 1)->translation, b = next->translation;
    for (int c = 0; c < 3; ++c) {
      CHECK(at[c] >= std::min(a[c], b[c]) - 1e-14);
      CHECK(at[c] <= std::max(a[c], b[c]) + 1e-14);
    }
  }
}

TEST_CASE("rigid_motion: the velocity has no jumps") {
  const RigidMotion motion = tumble();
  const Vec3 x(0.3, -0.2, 0.5);
  const double h = 1e-6;
  const auto velocity = [&](double t) {
    return Vec3((pose(motion, t + h).to_world(x) - pose(motion, t - h).to_world(x)) / (2 * h));
  };
  for (const double t : {0.0, 0.2, 0.3, 0.5, 0.7, 1.4, 2.0}) {
    CHECK((velocity(t + 3 * h) - velocity(t - 3 * h)).norm() < 2e-3);  // accelerations stay below 300 m/s^2
  }
}

TEST_CASE("rigid_motion: free ends run uniformly between two keyframes and meet a parabola's speed") {
  RigidMotion two;
  two.ends = EndSpeeds::free;
  two.keyframes = {{1, {1, 0, 0}, {0, 0, 0}}, {3, {2, -1, 4}, {0, 0.5, 0}}};
  for (const double t : {1.0, 1.3, 2.0, 2.9, 3.0})
    CHECK((pose(two, t).translation - Vec3(1 + (t - 1) / 2, -(t - 1) / 2, 2 * (t - 1))).norm() < 1e-14);
  CHECK(pose(two, 0).translation == Vec3(1, 0, 0));
  CHECK(pose(two, 4).translation == Vec3(2, -1, 4));
  RigidMotion parabola;  // x = t^2, y = (2 - t)^2, z turns back sharply
  parabola.ends = EndSpeeds::free;
  for (const double t : {0.5, 1.0, 1.8})
    parabola.keyframes.push_back({t, {t * t, (2 - t) * (2 - t), 0}, {0, 0, 0}});
  parabola.keyframes[1].translation.z() = 1;
  const double h = 1e-6;
  const Vec3 first = (pose(parabola, 0.5 + h).translation - pose(parabola, 0.5).translation) / h;
  const Vec3 last = (pose(parabola, 1.8).translation - pose(parabola, 1.8 - h).translation) / h;
  CHECK(first.x() == Approx(1).epsilon(1e-4));
  CHECK(first.y() == Approx(-3).epsilon(1e-4));
  CHECK(last.x() == Approx(3.6).epsilon(1e-4));
  CHECK(last.y() == Approx(-0.4).epsilon(1e-4));
  CHECK(first.z() > 2);  // steeper than the secant, which is 2
  parabola.ends = EndSpeeds::rest;
  CHECK((pose(parabola, 0.5 + h).translation - pose(parabola, 0.5).translation).norm() / h < 1e-4);
}

TEST_CASE("rigid_motion: with free ends no coordinate overshoots either") {
  RigidMotion keys = tumble();
  keys.spin.reset();
  keys.ends = EndSpeeds::free;
  for (int i = 0; i < 400; ++i) {
    const double t = i / 200.0;
    const Vec3 at = pose(keys, t).translation + pose(keys, t).rotation * keys.pivot - keys.pivot;
    const auto next = std::find_if(keys.keyframes.begin(), keys.keyframes.end() - 1,
                                   [&](const Keyframe& k) { return k.time > t; });
    const Vec3 a = (next - 1)->translation, b = next->translation;
    CHECK(((at.array() >= a.cwiseMin(b).array() - 1e-14) && (at.array() <= a.cwiseMax(b).array() + 1e-14))
              .all());
  }
}

TEST_CASE("rigid_motion: a spin runs up over its ramp, turns about its axis and is carried along") {
  const Spin spin{Vec3(1, 0, 0), Vec3(0, 3, 0), 2, 0.5, 1};
  CHECK(spin_angle(spin, 0.5) == 0);
  CHECK(spin_rate(spin, 0.4) == 0);
  CHECK(spin_rate(spin, 1) == 1);
  CHECK(spin_angle(spin, 1) == 0.25);
  CHECK(spin_angle(spin, 1.5) == 1);
  CHECK(spin_angle(spin, 2.5) == 3);
  for (const double t : {0.7, 1.2, 1.5 + 1e-9, 3.0}) {
    const double slope = (spin_angle(spin, t + 1e-6) - spin_angle(spin, t - 1e-6)) / 2e-6;
    CHECK(slope == Approx(spin_rate(spin, t)).epsilon(1e-6));
  }
  RigidMotion motion;
  motion.spin = spin;
  CHECK_FALSE(at_rest(motion));
  CHECK((pose(motion, 2.5).to_world({1, 7, 0}) - Vec3(1, 7, 0)).norm() < 1e-14);
  // counter-clockwise seen against the axis: about y from z towards x
  CHECK((pose(motion, 2.5).to_world({1, 0, 1}) - Vec3(1 + std::sin(3.0), 0, std::cos(3.0))).norm() < 1e-14);
  motion.keyframes = {{0, {0, 0, 5}, {0, 0, 0}}};
  CHECK((pose(motion, 2.5).to_world({1, 7, 0}) - Vec3(1, 7, 5)).norm() < 1e-14);
}

TEST_CASE("rigid_motion: a broken rigid motion is refused") {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto refused = [](RigidMotion motion, const char* text) {
    CHECK_THROWS_WITH(check(motion), Catch::Contains(text));
  };
  RigidMotion motion;
  motion.keyframes = {{0}, {0}};
  refused(motion, "keyframe 1: time");
  motion.keyframes = {{0}, {1, Vec3(0, nan, 0)}};
  refused(motion, "keyframe 1 is not finite");
  motion.keyframes.clear();
  motion.pivot.x() = nan;
  refused(motion, "pivot");
  motion.pivot.setZero();
  motion.spin = Spin{};
  motion.spin->axis.setZero();
  refused(motion, "axis");
  motion.spin = Spin{};
  motion.spin->ramp = -1;
  refused(motion, "ramp = -1");
  motion.spin = Spin{};
  motion.spin->rate = nan;
  refused(motion, "rate");
  CHECK_NOTHROW(check(tumble()));
}
