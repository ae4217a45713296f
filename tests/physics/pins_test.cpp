// SPDX-License-Identifier: GPL-3.0-or-later
#include "physics/pins.h"

#include <catch2/catch.hpp>

#include "tests/physics/test_cloths.h"

using namespace furrow::physics;
using namespace furrow::tests;

TEST_CASE("pinned particles lose velocity and inverse mass and keep their mass") {
  Cloth cloth = sheet(3, 3, 0.1);
  for (Vec3& v : cloth.particles.v) v = Vec3(1, 2, 3);
  const Particles before = cloth.particles;
  pin(cloth.particles, std::vector<int>{3, 8, 3});
  CHECK(cloth.particles.mass == before.mass);
  for (int i = 0; i < 9; ++i) {
    const bool pinned = i == 3 || i == 8;
    CHECK(cloth.particles.inv_mass[i] == (pinned ? 0 : before.inv_mass[i]));
    CHECK(cloth.particles.v[i] == (pinned ? Vec3(Vec3::Zero()) : before.v[i]));
  }
}

TEST_CASE("a pin out of range is refused and pins nothing") {
  Cloth cloth = sheet(3, 3, 0.1);
  const Particles before = cloth.particles;
  for (const int bad : {-1, 9}) {
    CHECK_THROWS_AS(pin(cloth.particles, std::vector<int>{0, bad}), std::invalid_argument);
    CHECK(cloth.particles.inv_mass == before.inv_mass);
  }
}
