// SPDX-License-Identifier: GPL-3.0-or-later
#include "physics/plate/press.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <limits>

#include "physics/plate/plate_bending.h"
#include "physics/plate/recouple.h"
#include "tests/physics/cloth/shell_cloths.h"

using namespace furrow::physics;
using namespace furrow::tests;

TEST_CASE("press: hinges whose edge lies in the patch, and no others") {
  Cloth cloth = sheet(5, 5, 0.1);
  add_hinges(cloth, 1e-4);
  const Cloth before = cloth;
  CHECK(press(cloth, std::vector<int>{6, 7, 12, 7}, 10) == 3);  // a triangle
  int changed = 0;
  for (std::size_t i = 0; i < cloth.hinges.size(); ++i) {
    if (cloth.hinges[i].stiffness == before.hinges[i].stiffness) continue;
    CHECK(cloth.hinges[i].stiffness == 10 * before.hinges[i].stiffness);
    CHECK(cloth.hinges[i].rest_angle == before.hinges[i].rest_angle);
    ++changed;
  }
  CHECK(changed == 3);
  CHECK(press(cloth, {}, 10) == 0);
}

TEST_CASE("press: a plate's hinges count by the root, are told apart, and stay so when it is made anew") {
  Cloth cloth = sheet(5, 5, 0.1, 0.2);
  add_hinges(cloth, 1e-4);
  std::vector<std::array<double, 3>> lengths;
  for (const auto& t : cloth.triangles) {
    std::array<double, 3> l;
    for (std::size_t i = 0; i < 3; ++i)
      l[i] = (cloth.particles.x[t[(i + 2) % 3]] - cloth.particles.x[t[(i + 1) % 3]]).norm();
    lengths.push_back(l);
  }
  const Cloth hinges = cloth;
  const std::vector<char> apart(cloth.hinges.size(), 0);
  const auto coupled = [&](const std::vector<double>& presses) {
    Cloth result = hinges;
    couple_hinges(result, lengths, {isotropic_plate(1e-4)}, apart, presses);
    return result;
  };
  cloth = coupled(std::vector<double>(hinges.hinges.size(), 1));
  const std::vector<int> patch{6, 7, 12, 7};
  CHECK(press(cloth, patch, 10) == 3);
  std::vector<double> presses;
  for (const Hinge& h : hinges.hinges) {
    const auto on = [&](int v) { return std::find(patch.begin(), patch.end(), v) != patch.end(); };
    presses.push_back(on(h.vertices[0]) && on(h.vertices[1]) ? 10 : 1);
  }
  const Cloth wanted = coupled(presses);
  Noise noise(3);
  std::vector<Vec3> x = cloth.particles.x;
  for (Vec3& p : x) p += 0.01 * noise.vector();
  const auto energy = [&](const Cloth& c) { return c.energies[0]->energy(x); };
  CHECK(energy(cloth) == Approx(energy(wanted)).epsilon(1e-12));
  CHECK(energy(cloth) > 1.1 * energy(coupled({})));
  CHECK(recouple(cloth));
  CHECK(energy(cloth) == energy(wanted));
  CHECK(press_hinges(
            cloth, [](const Hinge&) { return true; }, 2) == int(hinges.hinges.size()));
  CHECK(energy(cloth) == Approx(2 * energy(wanted)).epsilon(1e-12));
}

TEST_CASE("press: what cannot be is refused and nothing changes") {
  Cloth cloth = sheet(5, 5, 0.1);
  add_hinges(cloth, 1e-4);
  const double k = cloth.hinges[0].stiffness;
  CHECK_THROWS_WITH(press(cloth, std::vector<int>{0, 1}, 0), Catch::Contains("factor = 0"));
  CHECK_THROWS_AS(press(cloth, std::vector<int>{0, 1}, std::numeric_limits<double>::infinity()),
                  std::invalid_argument);
  CHECK_THROWS_WITH(press(cloth, std::vector<int>{0, 1, 25}, 2), Catch::Contains("particle 25"));
  CHECK(cloth.hinges[0].stiffness == k);
}
