// SPDX-License-Identifier: GPL-3.0-or-later
#include "bridge/draping/energy_parts.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "physics/cloth/elements.h"
#include "physics/cloth/patch_membrane.h"

using namespace furrow;
using physics::Vec3;

namespace {

/// Four particles, a unit square cut along 1-2, with all kinds of elements, pushed out of shape.
physics::Cloth square_of_cloth() {
  physics::Cloth cloth;
  physics::Particles& p = cloth.particles;
  p.x = {Vec3(0, 0, 0), Vec3(1.1, 0, 0), Vec3(0, 1, 0.1), Vec3(1, 1, 0.3)};
  p.v.assign(4, Vec3::Zero());
  p.mass = {0.5, 1, 2, 4};
  p.inv_mass = {2, 1, 0.5, 0};
  cloth.triangles = {{0, 1, 2}, {2, 1, 3}};
  const double d = std::sqrt(2.0);
  cloth.membrane = {{{0, 1, 2}, {d, 1, 1}, 30, 40}, {{2, 1, 3}, {1, 1, d}, 30, 40}};
  cloth.hinges = {{{1, 2, 0, 3}, 0.1, 0.7}};
  cloth.bending = {{0, 3, 1.2, 5}};
  return cloth;
}

}  // namespace

TEST_CASE("energy_parts: elements by kind sum up to their energy, and weight to the way down") {
  const physics::Cloth cloth = square_of_cloth();
  std::vector<Vec3> places = cloth.particles.x;
  for (Vec3& x : places) x.y() += 0.25;  // it fell by so much
  const bridge::EnergyParts parts = bridge::energy_parts(cloth, Vec3(0, -10, 0), places);
  CHECK(parts.stretch > 0);
  CHECK(parts.bending > 0);
  const double l = cloth.particles.x[3].norm() - 1.2;
  CHECK(parts.ties == Approx(0.5 * 5 * l * l));
  CHECK(parts.stretch + parts.bending + parts.ties ==
        Approx(physics::potential_energy(cloth, cloth.particles.x)));
  CHECK(parts.weight == Approx(-10 * 0.25 * 3.5));  // the fourth is held
  CHECK(parts.contact == 0);
  CHECK(parts.total() == Approx(parts.stretch + parts.bending + parts.ties + parts.weight));
  physics::Cloth across = cloth;
  across.hinges.clear();
  CHECK(bridge::energy_parts(across, Vec3::Zero(), places).bending == Approx(parts.ties));
  CHECK(bridge::energy_parts(across, Vec3::Zero(), places).ties == 0);
  physics::Cloth patched = across;
  CHECK(physics::join_patches(patched).patches == 4);
  const bridge::EnergyParts of_patches = bridge::energy_parts(patched, Vec3::Zero(), places);
  CHECK(of_patches.stretch == Approx(physics::potential_energy(patched, patched.particles.x) - parts.ties));
  CHECK(of_patches.stretch < parts.stretch);
  CHECK(of_patches.bending == Approx(parts.ties));
  places.pop_back();
  CHECK_THROWS_WITH(bridge::energy_parts(cloth, Vec3::Zero(), places), Catch::Contains("3 places"));
}
