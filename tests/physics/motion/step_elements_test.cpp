// SPDX-License-Identifier: GPL-3.0-or-later
#include "physics/motion/step_elements.h"

#include <catch2/catch.hpp>

#include "physics/cloth/elements.h"
#include "tests/cases/flat_meshes.h"
#include "tests/cases/plates.h"
#include "tests/physics/cloth/test_cloths.h"

using namespace furrow::physics;
using namespace furrow::tests;

namespace {

/// Springs, triangles, tension and hinges at once, crumpled, one particle held.
Cloth all_kinds(HingeLaw law) {
  namespace cases = furrow::cases;
  Cloth cloth = cases::triangular_sheet(0.3, 0.3, 7, cases::equilateral_rows(0.3, 0.3, 7), 0.12, 0.15, 3);
  cases::add_flat_membrane(cloth, 1000);
  cases::add_flat_hinges(cloth, 1e-4);
  cloth.hinge_law = law;
  for (const auto& t : cloth.triangles) cloth.tension.push_back({t[0], t[1], 0.04, 50, 10});
  Noise noise(5);
  for (Vec3& x : cloth.particles.x) x += 0.01 * noise.vector();
  cloth.particles.inv_mass[0] = 0;
  sort_elements(cloth);
  return cloth;
}

double largest(const std::vector<Vec3>& a) {
  double most = 0;
  for (const Vec3& v : a) most = std::max(most, v.norm());
  return most;
}

}  // namespace

TEST_CASE("step_elements: energy, forces and stiffness are those of the elements") {
  const HingeLaw law = GENERATE(HingeLaw::linear, HingeLaw::cosine);
  const Cloth cloth = all_kinds(law);
  const std::vector<Vec3>& x = cloth.particles.x;
  ThreadPool pool(1), two(2);
  StepElements elements(cloth), other(cloth);
  std::vector<Vec3> force(x.size()), again = force, plain(x.size(), Vec3::Zero());
  const double energy = elements(x, force, pool);
  CHECK(energy == Approx(potential_energy(cloth, x)).epsilon(1e-12));
  CHECK(other(x, again, two) == energy);
  CHECK(again == force);
  add_forces(cloth, x, plain);
  const double scale = largest(plain);
  for (std::size_t i = 0; i < x.size(); ++i) CHECK((force[i] - plain[i]).norm() < 1e-11 * scale);

  FreeStiffness lanes(cloth), generic(cloth);
  elements.assemble(lanes, x, pool);
  generic.assemble(cloth, x, Stiffness::positive_part);
  Noise noise(8);
  std::vector<Vec3> v;
  for (std::size_t i = 0; i < x.size(); ++i) v.push_back(noise.vector());
  const std::vector<Vec3> a = lanes.times(v), b = generic.times(v);
  const double most = largest(b);
  for (std::size_t i = 0; i < x.size(); ++i) CHECK((a[i] - b[i]).norm() < 1e-11 * most);
}

TEST_CASE("step_elements: the stiffness of a plate couples it hinge by hinge") {
  Cloth cloth = all_kinds(HingeLaw::linear);
  furrow::cases::add_plate(cloth, isotropic_plate(1e-4));
  REQUIRE(cloth.energies.size() == 1);
  const std::vector<Vec3>& x = cloth.particles.x;
  ThreadPool pool(1);
  FreeStiffness lanes(cloth, StepElements::part.narrow), narrow(cloth, true), whole(cloth);
  StepElements(cloth).assemble(lanes, x, pool);
  narrow.assemble(cloth, x, Stiffness::positive_part);
  whole.assemble(cloth, x, Stiffness::positive_part);
  Noise noise(8);
  std::vector<Vec3> v;
  for (std::size_t i = 0; i < x.size(); ++i) v.push_back(noise.vector());
  const std::vector<Vec3> a = lanes.times(v), b = narrow.times(v), c = whole.times(v);
  const double most = largest(b);
  double apart = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    CHECK((a[i] - b[i]).norm() < 1e-11 * most);
    apart = std::max(apart, (a[i] - c[i]).norm());
  }
  CHECK(apart > 1e-6 * most);
}

TEST_CASE("step_elements: factors of single precision solve to a small part of the force") {
  const Cloth cloth = all_kinds(HingeLaw::linear);
  const std::vector<Vec3>& x = cloth.particles.x;
  ThreadPool pool(1), two(2);
  StepElements elements(cloth);
  FreeStiffness matrix(cloth);
  elements.assemble(matrix, x, pool);
  for (std::size_t i = 0; i < x.size(); ++i)
    if (cloth.particles.inv_mass[i] > 0) matrix.add(int(i), Mat3::Identity());
  Noise noise(9);
  std::vector<Vec3> b;
  for (std::size_t i = 0; i < x.size(); ++i) b.push_back(noise.vector());
  b[0].setZero();
  REQUIRE(matrix.factorise_single(&pool));
  std::vector<Vec3> once = b, twice = b;
  matrix.solve(once, &pool);
  REQUIRE(matrix.factorise_single(&two));
  matrix.solve(twice, &two);
  CHECK(once == twice);
  const std::vector<Vec3> back = matrix.times(once);
  double apart = 0;
  for (std::size_t i = 0; i < x.size(); ++i) apart = std::max(apart, (back[i] - b[i]).norm());
  CHECK(apart < 1e-3);
  CHECK(apart > 1e-12);
  REQUIRE(matrix.factorise_definite(0, &pool));
  std::vector<Vec3> exact = b;
  matrix.solve(exact, &pool);
  for (std::size_t i = 0; i < x.size(); ++i) CHECK((exact[i] - once[i]).norm() < 1e-3 * largest(exact));
}
