// SPDX-License-Identifier: GPL-3.0-or-later
#include "physics/rest/stiffness_work.h"

#include <catch2/catch.hpp>

#include "physics/cloth/pins.h"
#include "physics/linear/free_stiffness.h"
#include "physics/rest/certificate.h"
#include "physics/rest/prestress.h"
#include "tests/physics/cloth/finite_differences.h"
#include "tests/physics/cloth/shell_cloths.h"

using namespace furrow::physics;
using namespace furrow::tests;

namespace {

/// A sheet that hangs by two corners, uneven, of this stiffness.
Cloth stretched_square(double stretch) {
  Cloth cloth = sheet(5, 5, 0.1, 0.2, 0, 0, 0);
  add_membrane(cloth, stretch);
  add_hinges(cloth, 0.01);
  pin(cloth.particles, std::vector<int>{0, 4});
  Noise noise(4);
  for (Vec3& x : cloth.particles.x) x += 0.002 * noise.vector();
  return cloth;
}

struct Kept {
  std::vector<double> rest;
  Certificate certificate;
};

Kept keep(Cloth cloth, StiffnessWork* work) {
  PrestressOptions bounds;
  bounds.work = work;
  prestress(cloth, bounds);
  Kept kept;
  for (const MembraneTriangle& t : cloth.membrane)
    kept.rest.insert(kept.rest.end(), t.rest_lengths.begin(), t.rest_lengths.end());
  for (const Hinge& h : cloth.hinges) kept.rest.push_back(h.rest_angle);
  kept.certificate = certify(cloth, {.work = work});
  return kept;
}

}  // namespace

TEST_CASE("stiffness_work: what solves share changes no bit of a rest state or a certificate") {
  StiffnessWork work;
  for (const double stretch : {500.0, 50.0, 5000.0}) {
    const Kept alone = keep(stretched_square(stretch), nullptr),
               shared = keep(stretched_square(stretch), &work);
    CHECK(shared.rest == alone.rest);
    CHECK(shared.certificate.negative_eigenvalues == alone.certificate.negative_eigenvalues);
    CHECK(shared.certificate.smallest_eigenvalue == alone.certificate.smallest_eigenvalue);
    CHECK(shared.certificate.mode == alone.certificate.mode);
  }
}

TEST_CASE("stiffness_work: it is taken where it fits, and made anew where it does not") {
  StiffnessWork work;
  const Cloth cloth = stretched_square(500);
  const auto first = stiffness_for(cloth, false, &work);
  CHECK(stiffness_for(stretched_square(50), false, &work) == first);
  CHECK(stiffness_for(cloth, false, nullptr) != first);
  CHECK(work.stiffness == first);
  CHECK(stiffness_for(cloth, true, &work) != first);
  Cloth freed = cloth;
  freed.particles.inv_mass[0] = freed.particles.inv_mass[1];
  const auto second = stiffness_for(freed, false, &work);
  CHECK(second != first);
  CHECK(second->free_particles() == first->free_particles() + 1);
  CHECK(work.stiffness == second);
}
