// SPDX-License-Identifier: GPL-3.0-or-later
#include "physics/elements.h"

#include <catch2/catch.hpp>

#include "tests/physics/finite_differences.h"
#include "tests/physics/shell_cloths.h"

using namespace furrow::physics;
using namespace furrow::tests;

TEST_CASE("springs behind one door: derivatives agree with finite differences") {
  for (int seed = 1; seed <= 5; ++seed) {
    Cloth cloth = sheet(4, 3, 0.1, 0.2, seed, 300, 40);
    Noise noise(seed);
    for (Vec3& x : cloth.particles.x) x += 0.02 * noise.vector();
    const DerivativeErrors errors = derivative_errors(cloth, cloth.particles.x, 1e-4);
    CAPTURE(seed);
    CHECK(errors.force < 1e-8);
    CHECK(errors.stiffness < 1e-7);
    CHECK(errors.symmetry < 1e-14);
    const Eigen::MatrixXd part = stiffness_matrix(cloth, cloth.particles.x, Stiffness::positive_part),
                          exact = stiffness_matrix(cloth, cloth.particles.x, Stiffness::exact);
    CHECK(least_eigenvalue(part) > -1e-12 * part.norm());
    CHECK(least_eigenvalue(part - exact) > -1e-12 * part.norm());
  }
}

TEST_CASE("elements in two halves: energy and forces of the whole, the same bits on any number of threads") {
  Cloth cloth = sheet(5, 4, 0.1, 0.2, 3, 300, 40);
  add_membrane(cloth, 300);
  add_hinges(cloth, 1e-4);
  Noise noise(8);
  for (Vec3& x : cloth.particles.x) x += 0.02 * noise.vector();
  const std::span<const Vec3> x = cloth.particles.x;
  std::vector<Vec3> whole(x.size(), Vec3::Zero()), first;
  add_forces(cloth, x, whole);
  double first_energy = 0;
  for (const int threads : {1, 2, 3}) {
    ThreadPool pool(threads);
    std::vector<Vec3> force(x.size(), Vec3::Zero());
    add_forces(cloth, x, force, pool);
    const double energy = potential_energy(cloth, x, pool);
    CHECK(energy == Approx(potential_energy(cloth, x)).epsilon(1e-12));
    for (std::size_t i = 0; i < x.size(); ++i)
      CHECK((force[i] - whole[i]).norm() < 1e-12 * (1 + whole[i].norm()));
    if (threads == 1) first = force, first_energy = energy;
    CHECK(force == first);
    CHECK(energy == first_energy);
  }
}
