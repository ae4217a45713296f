// SPDX-License-Identifier: GPL-3.0-or-later
#include "physics/cloth/elements.h"

#include <catch2/catch.hpp>

#include "tests/physics/cloth/finite_differences.h"
#include "tests/physics/cloth/shell_cloths.h"

using namespace furrow::physics;
using namespace furrow::tests;

TEST_CASE("elements: derivatives of springs agree with finite differences") {
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
