// SPDX-License-Identifier: GPL-3.0-or-later
#include "physics/packed/packed_cloth.h"

#include <catch2/catch.hpp>
#include <limits>

#include "physics/cloth/pins.h"
#include "physics/packed/packed_forces.h"
#include "tests/physics/cloth/one_kind.h"
#include "tests/physics/cloth/test_cloths.h"

using namespace furrow::physics;
using namespace furrow::tests;

TEST_CASE("packed_cloth: packed springs exert the same force as plain ones") {
  Cloth cloth = sheet(61, 53, 0.02, 0.25);  // more than one block
  Noise noise(5);
  for (Vec3& x : cloth.particles.x) x += 0.005 * noise.vector();
  std::vector<Vec3> force(cloth.particles.size(), Vec3::Zero());
  add_forces(only(cloth.structural), cloth.particles.x, force);
  add_forces(only(cloth.bending), cloth.particles.x, force);
  PackedCloth packed = pack(cloth);
  REQUIRE(packed.sweep.blocks() > 1);
  ThreadPool pool(1);
  update_spring_forces(packed, pool);
  double largest = 0, difference = 0;
  for (int i = 0; i < packed.particles(); ++i) {
    const Vec3& f = force[packed.particle[i]];
    largest = std::max(largest, f.norm());
    difference =
        std::max(difference, (Vec3(packed.force[i].x, packed.force[i].y, packed.force[i].z) - f).norm());
  }
  CHECK(largest > 1);
  CHECK(difference < 1e-13 * largest);
  CHECK(packed.springs() == int(cloth.structural.size() + cloth.bending.size()));
}

TEST_CASE("packed_cloth: packing and unpacking gives the particles back bit by bit") {
  Cloth cloth = sheet(7, 9, 0.1, 0.2);
  Noise noise(6);
  for (Vec3& v : cloth.particles.v) v = noise.vector();
  pin(cloth.particles, std::vector<int>{3, 8, 3});
  Particles copy = cloth.particles;
  unpack(pack(cloth), copy);
  CHECK(copy.x == cloth.particles.x);
  CHECK(copy.v == cloth.particles.v);
}

TEST_CASE("packed_cloth: broken arrays are refused") {
  const Cloth good = sheet(3, 3, 0.1);
  const auto refused = [&](auto change) {
    Cloth cloth = good;
    change(cloth);
    CHECK_THROWS_AS(pack(cloth), std::invalid_argument);
  };
  refused([](Cloth& c) { c.particles.v.pop_back(); });
  refused([](Cloth& c) { c.structural[2].b = 99; });
  refused([](Cloth& c) { c.structural[2].b = c.structural[2].a; });
  refused([](Cloth& c) { c.bending[0].rest_length = 0; });
  refused([](Cloth& c) { c.bending[0].stiffness = -1; });
  refused([](Cloth& c) { c.particles.x[1].y() = std::numeric_limits<double>::quiet_NaN(); });
  refused([](Cloth& c) { c.particles.inv_mass[1] = std::numeric_limits<double>::infinity(); });
  CHECK_NOTHROW(pack(Cloth{}));
}
