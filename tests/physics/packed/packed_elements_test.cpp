// SPDX-License-Identifier: GPL-3.0-or-later
#include "physics/packed/packed_elements.h"

#include <catch2/catch.hpp>

#include "physics/base/lanes_geometry.h"
#include "physics/cloth/elements.h"
#include "physics/cloth/pins.h"
#include "physics/motion/leapfrog_step.h"
#include "tests/physics/cloth/shell_cloths.h"
#include "tests/physics/motion/stepper_runs.h"

using namespace furrow::physics;
using namespace furrow::tests;

namespace {

Cloth shell(int columns, int rows, HingeLaw law, bool springs) {
  Cloth cloth = sheet(columns, rows, 0.02, 0.25);
  if (!springs) cloth = without_springs(cloth);
  add_membrane(cloth, 300);
  add_hinges(cloth, 1e-4);
  cloth.hinge_law = law;
  Noise noise(5);
  for (Hinge& h : cloth.hinges) h.rest_angle = 3 * noise();
  for (Vec3& x : cloth.particles.x) x += 0.006 * noise.vector();
  return cloth;
}

}  // namespace

TEST_CASE("packed_elements: arc tangents of four at once are those of the standard library") {
  double worst = 0;
  for (int i = 0; i <= 20000; ++i) {
    const double angle = -3.14159265358979 + i * 6.28318530717958 / 20000, size = std::exp(i % 41 - 20);
    const double y = size * std::sin(angle), x = size * std::cos(angle);
    const Lanes ys{y, y, -y, 0}, xs{x, -x, x, 0};
    Lanes result;
    arc_tangent(ys, xs, result);
    worst = std::max({worst, std::abs(result[0] - std::atan2(y, x)), std::abs(result[1] - std::atan2(y, -x)),
                      std::abs(result[2] - std::atan2(-y, x)), std::abs(result[3])});
  }
  CAPTURE(worst);
  CHECK(worst < 9e-16);
}

TEST_CASE("packed_elements: packed elements exert the same force as plain ones") {
  const Cloth cloth = shell(31, 23, GENERATE(HingeLaw::linear, HingeLaw::cosine), GENERATE(true, false));
  std::vector<Vec3> force(cloth.particles.size(), Vec3::Zero());
  add_forces(cloth, cloth.particles.x, force);
  ThreadPool pool(1);
  Motion motion(cloth, {}, pool);
  const PackedCloth& packed = motion.cloth();
  double largest = 0, difference = 0;
  for (int i = 0; i < packed.particles(); ++i) {
    const Vec3& f = force[std::size_t(packed.particle[std::size_t(i)])];
    const Vec4& p = packed.force[std::size_t(i)];
    largest = std::max(largest, f.norm());
    difference = std::max(difference, (Vec3(p.x, p.y, p.z) - f).norm());
    CHECK(p.w == 0);
  }
  CAPTURE(largest, difference);
  CHECK(largest > 0.01);
  CHECK(difference < 1e-13 * largest);
  CHECK(motion.work().triangle_evaluations == std::int64_t(cloth.membrane.size()));
  CHECK(motion.work().hinge_evaluations == std::int64_t(cloth.hinges.size()));
  CHECK(motion.work().spring_evaluations == std::int64_t(cloth.structural.size() + cloth.bending.size()));
}

TEST_CASE("packed_elements: membrane and hinges move alike with any number of threads", "[long]") {
  Cloth cloth = shell(61, 53, GENERATE(HingeLaw::linear, HingeLaw::cosine), false);
  pin(cloth.particles, std::vector<int>{0, 60});
  const auto run = [&](int threads) {
    return after(cloth, {.air_drag = 1, .spring_damping = 0.05}, {}, 5e-5, 40, threads);
  };
  const Particles one = run(1);
  for (const int threads : {2, 3, 7}) {
    const Particles other = run(threads);
    CHECK(one.x == other.x);
    CHECK(one.v == other.v);
  }
}

TEST_CASE("packed_elements: broken elements are refused before anything moves") {
  const Cloth good = shell(4, 4, HingeLaw::linear, false);
  const auto refused = [&](auto change) {
    Cloth cloth = good;
    change(cloth);
    CHECK_THROWS_AS(pack(cloth), std::invalid_argument);
  };
  refused([](Cloth& c) { c.membrane[2].vertices[1] = 99; });
  refused([](Cloth& c) { c.membrane[2].vertices[1] = c.membrane[2].vertices[0]; });
  refused([](Cloth& c) { c.membrane[2].rest_lengths[1] = 9; });
  refused([](Cloth& c) { c.hinges[1].vertices[3] = -1; });
  refused([](Cloth& c) { c.hinges[1].stiffness = -1; });
  CHECK(pack(good).dashpots == int(good.particles.size() + good.membrane.size()) - 1);  // Euler
  CHECK(pack(good, false).dashpots == 0);
}
