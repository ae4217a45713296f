// SPDX-License-Identifier: GPL-3.0-or-later
#include "physics/cloth/element_forces.h"

#include <catch2/catch.hpp>

#include "physics/cloth/elements.h"
#include "tests/physics/cloth/shell_cloths.h"

using namespace furrow::physics;
using namespace furrow::tests;

namespace {

Cloth all_kinds() {
  Cloth cloth = sheet(5, 4, 0.1, 0.2, 3, 300, 40);
  add_membrane(cloth, 300);
  add_hinges(cloth, 1e-4);
  for (const Spring& s : cloth.structural) cloth.tension.push_back({s.a, s.b, s.rest_length, 90, 20});
  Noise noise(8);
  for (Vec3& x : cloth.particles.x) x += 0.02 * noise.vector();
  return cloth;
}

}  // namespace

TEST_CASE("element_forces: all elements with their energy have the same bits on any number of threads") {
  const Cloth cloth = all_kinds();
  const std::vector<Vec3>& x = cloth.particles.x;
  std::vector<Vec3> whole(x.size(), Vec3::Zero()), first;
  add_forces(cloth, x, whole);
  double first_energy = 0;
  for (const int threads : {1, 2, 3}) {
    ThreadPool pool(threads);
    ElementForces elements(cloth);
    std::vector<Vec3> force(x.size(), Vec3::Constant(7));  // what stood there does not count
    const double energy = elements(x, force, pool);
    CHECK(energy == Approx(potential_energy(cloth, x)).epsilon(1e-12));
    for (std::size_t i = 0; i < x.size(); ++i)
      CHECK((force[i] - whole[i]).norm() < 1e-12 * (1 + whole[i].norm()));
    if (threads == 1) first = force, first_energy = energy;
    CHECK(force == first);
    CHECK(energy == first_energy);
    CHECK(elements(x, force, pool) == energy);  // nothing is left from the call before
    CHECK(force == first);
  }
}

TEST_CASE("element_forces: bad elements and lengths are refused") {
  Cloth cloth = all_kinds();
  ThreadPool pool(1);
  ElementForces elements(cloth);
  std::vector<Vec3> force(cloth.particles.size()), fewer(3);
  CHECK_THROWS_AS(elements(cloth.particles.x, fewer, pool), std::invalid_argument);
  CHECK_THROWS_AS(elements(fewer, force, pool), std::invalid_argument);
  CHECK_THROWS_AS(elements(fewer, fewer, pool), std::invalid_argument);
  cloth.membrane[1].vertices[2] = 9999;
  CHECK_THROWS_AS(ElementForces(cloth), std::invalid_argument);
}
