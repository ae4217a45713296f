// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>

#include "physics/cloth/elements.h"
#include "physics/linear/stable_step.h"
#include "physics/motion/leapfrog_step.h"
#include "tests/cases/flat_meshes.h"
#include "tests/cases/membrane_laws.h"
#include "tests/cases/twisted_ribbon.h"
#include "tests/physics/cloth/test_cloths.h"

using namespace furrow::physics;
using namespace furrow::cases;
using furrow::tests::Noise;

namespace {

/// A jittered sheet of 0.2 x 0.16 m with Y = 50 N/m that spins at 20 rad/s, drifts and is not quite at rest.
Cloth spinning_sheet(bool springs) {
  Cloth cloth = triangular_sheet(0.2, 0.16, 7, 6, 0.15, 0.2, 4);
  if (springs) {
    const std::vector<double> areas = rest_areas(cloth);
    set_membrane_stiffness(cloth, MembraneLaw::paper,
                           calibrated_stiffness(cloth, MembraneLaw::paper, 50, areas), areas);
  } else {
    cloth.structural.clear();
    add_flat_membrane(cloth, 50, 0.3);
    add_flat_hinges(cloth, 1e-5);
  }
  Noise noise(6);
  const Vec3 spin(4, 6, 19), centre(0.1, 0.08, 0);
  for (std::size_t i = 0; i < cloth.particles.size(); ++i) {
    Vec3& x = cloth.particles.x[i];
    cloth.particles.v[i] = spin.cross(x - centre) + Vec3(1, -0.5, 0.3);
    x += 5e-4 * noise.vector();
  }
  return cloth;
}

struct Invariants {
  Vec3 momentum = Vec3::Zero(), angular = Vec3::Zero();
  double momentum_scale = 0, angular_scale = 0, energy;
};

Invariants measure(const Cloth& cloth) {
  Invariants sum;
  const Particles& p = cloth.particles;
  sum.energy = potential_energy(cloth, p.x);
  for (std::size_t i = 0; i < p.size(); ++i) {
    sum.momentum += p.mass[i] * p.v[i];
    sum.angular += p.mass[i] * p.x[i].cross(p.v[i]);
    sum.momentum_scale += p.mass[i] * p.v[i].norm();
    sum.angular_scale += p.mass[i] * p.x[i].norm() * p.v[i].norm();
    sum.energy += 0.5 * p.mass[i] * p.v[i].squaredNorm();
  }
  return sum;
}

}  // namespace

TEST_CASE(
    "invariants: a free spinning sheet keeps momentum and angular momentum, and its energy stays in a band",
    "[release]") {
  const bool springs = GENERATE(true, false);
  Cloth cloth = spinning_sheet(springs);
  const Invariants start = measure(cloth);
  const double dt = 0.3 * stable_step(cloth).dt_limit;
  ThreadPool pool(1);
  Motion motion(cloth, {.gravity = Vec3::Zero()}, pool);
  double band[2] = {0, 0}, momentum = 0, angular = 0;
  const int steps = 20000;
  for (int i = 0; i < steps; ++i) {
    leapfrog_step(motion, dt);
    if (i % 10) continue;
    motion.unpack(cloth.particles);
    const Invariants now = measure(cloth);
    double& worst = band[i >= steps / 2];
    worst = std::max(worst, std::abs(now.energy / start.energy - 1));
    momentum = std::max(momentum, (now.momentum - start.momentum).norm() / start.momentum_scale);
    angular = std::max(angular, (now.angular - start.angular).norm() / start.angular_scale);
  }
  CAPTURE(springs, dt, band[0], band[1]);
  CHECK(momentum < 1e-12);
  CHECK(angular < 1e-12);
  CHECK(band[0] < 2e-3);
  CHECK(band[1] < 1.5 * band[0]);
}

TEST_CASE("invariants: a twisted ribbon of fibres pulls and turns as the integral over its width says",
          "[release]") {
  const RibbonLoad known = fibre_ribbon({0.2, 0.02});
  CHECK(known.force == Approx(0.0262994029273).epsilon(1e-10));
  CHECK(known.torque == Approx(0.00204589716483).epsilon(1e-10));
  for (const Twist& twist : {Twist{0.05, 0}, Twist{0.1, 0.05}, Twist{0.5, 0.01}}) {
    const RibbonLoad exact = fibre_ribbon(twist), coarse = spring_ribbon(twist, 20, 200),
                     fine = spring_ribbon(twist, 40, 400);
    CAPTURE(twist.tau, twist.end_strain);
    CHECK(std::abs(fine.force / exact.force - 1) < 1e-3);
    CHECK(std::abs(fine.torque / exact.torque - 1) < 3e-3);
    CHECK((coarse.force - exact.force) / (fine.force - exact.force) == Approx(4).margin(0.2));
    CHECK((coarse.torque - exact.torque) / (fine.torque - exact.torque) == Approx(4).margin(0.2));
  }
}

TEST_CASE("invariants: a twisted ribbon of membrane triangles comes near the fibres' force and torque",
          "[release]") {
  for (const Twist& twist : {Twist{0.1, 0.01}, Twist{0.1, 0.05}}) {
    const RibbonLoad exact = fibre_ribbon(twist, FibreStrain::green),
                     coarse = membrane_ribbon(twist, 0.1, 4, 40), fine = membrane_ribbon(twist, 0.1, 8, 80);
    CAPTURE(twist.end_strain, fine.force / exact.force, fine.torque / exact.torque);
    CHECK(std::abs(fine.force / exact.force - 1) < 0.005);
    CHECK(std::abs(fine.torque / exact.torque - 1) < 0.06);
    CHECK((coarse.force - exact.force) / (fine.force - exact.force) == Approx(4).margin(0.5));
    CHECK((coarse.torque - exact.torque) / (fine.torque - exact.torque) == Approx(4).margin(0.5));
  }
}
