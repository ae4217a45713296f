// SPDX-License-Identifier: GPL-3.0-or-later
#include "physics/cloth/pins.h"

#include <catch2/catch.hpp>

#include "physics/cloth/elements.h"
#include "tests/physics/cloth/test_cloths.h"

using namespace furrow::physics;
using namespace furrow::tests;

TEST_CASE("pins: pinned particles lose velocity and inverse mass and keep their mass") {
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

TEST_CASE("pins: a pin out of range is refused and pins nothing") {
  Cloth cloth = sheet(3, 3, 0.1);
  const Particles before = cloth.particles;
  for (const int bad : {-1, 9}) {
    CHECK_THROWS_AS(pin(cloth.particles, std::vector<int>{0, bad}), std::invalid_argument);
    CHECK(cloth.particles.inv_mass == before.inv_mass);
  }
}

TEST_CASE("pins: hinges between a held and a free flap count double, others do not") {
  // A row of triangles 0 1 2, 1 3 2, 3 5 2 ... : hinges over (1,2), (2,3), (3,4).
  Cloth cloth;
  cloth.particles.inv_mass.assign(6, 1);
  for (const std::array<int, 4>& v : {std::array{1, 2, 0, 3}, {2, 3, 1, 4}, {3, 4, 2, 5}})
    cloth.hinges.push_back({v, 0, 3});
  const auto stiffness = [&](const std::vector<int>& pinned) {
    Cloth copy = cloth;
    for (const int i : pinned) copy.particles.inv_mass[i] = 0;
    const Cloth before = copy;
    stiffen_clamps(copy);
    Cloth back = copy;
    soften_clamps(back);
    for (std::size_t i = 0; i < 3; ++i) CHECK(back.hinges[i].stiffness == before.hinges[i].stiffness);
    return std::array{copy.hinges[0].stiffness, copy.hinges[1].stiffness, copy.hinges[2].stiffness};
  };
  CHECK(stiffness({}) == std::array{3.0, 3.0, 3.0});
  CHECK(stiffness({1, 2}) == std::array{3.0, 3.0, 3.0});        // an axle, free on both sides
  CHECK(stiffness({0, 1, 2}) == std::array{6.0, 3.0, 3.0});     // a clamp
  CHECK(stiffness({0, 1, 2, 3}) == std::array{3.0, 6.0, 3.0});  // one flap further
  CHECK(stiffness({0, 1, 2, 3, 4, 5}) == std::array{3.0, 3.0, 3.0});
}

TEST_CASE("pins: elements that are held push nothing that moves, and can be left out") {
  Cloth cloth = sheet(5, 5, 0.1);
  for (std::size_t i = 0; i < cloth.particles.size(); ++i) cloth.particles.x[i] += Vec3(0, 0.01 * (i % 3), 0);
  std::vector<int> far;
  for (int i = 0; i < 25; ++i)
    if (i % 5 > 1) far.push_back(i);
  pin(cloth.particles, far);
  Cloth near = cloth;
  drop_held_elements(near);
  CHECK(near.membrane.size() + near.structural.size() + near.tension.size() <
        cloth.membrane.size() + cloth.structural.size() + cloth.tension.size());
  CHECK(near.hinges.size() + near.bending.size() < cloth.hinges.size() + cloth.bending.size());
  CHECK(near.triangles == cloth.triangles);
  std::vector<Vec3> all(25, Vec3::Zero()), some(25, Vec3::Zero());
  add_forces(cloth, cloth.particles.x, all);
  add_forces(near, cloth.particles.x, some);
  for (int i = 0; i < 25; ++i)
    if (i % 5 <= 1) CHECK((all[i] - some[i]).norm() <= 1e-12 * all[i].norm());
}
