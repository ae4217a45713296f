// SPDX-License-Identifier: GPL-3.0-or-later
#include "physics/cloth/struts.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

#include "physics/cloth/elements.h"
#include "physics/cloth/pins.h"
#include "tests/physics/cloth/shell_cloths.h"

using namespace furrow::physics;
using namespace furrow::tests;

namespace {

bool sorted(const std::vector<Spring>& springs) {
  for (std::size_t i = 0; i + 1 < springs.size(); ++i) {
    if (!(std::pair(springs[i].a, springs[i].b) < std::pair(springs[i + 1].a, springs[i + 1].b)))
      return false;
  }
  return true;
}

}  // namespace

TEST_CASE("struts: along a row they join what is two to four edges apart") {
  Cloth cloth = sheet(7, 3, 0.1, 0, 1, 300, 0);
  cloth.bending.clear();
  const std::vector<int> row{7, 8, 9, 10, 11, 12, 13};
  CHECK(add_struts(cloth, row) == 5 + 4 + 3);
  CHECK(sorted(cloth.bending));
  for (const Spring& s : cloth.bending) {
    CHECK(s.a >= 7);
    CHECK(s.b <= 13);
    CHECK((s.b - s.a >= 2 && s.b - s.a <= 4));
    CHECK(s.rest_length == Approx(0.1 * (s.b - s.a)));
    CHECK(s.stiffness == 3);
  }
  CHECK(add_struts(cloth, row) == 0);  // they are there
  StrutOptions one;
  one.farthest = 2;
  cloth.bending.clear();
  pin(cloth.particles, std::vector<int>{7, 9, 11, 13});
  CHECK(add_struts(cloth, row, one) == 2);  // pinned pairs need none
}

TEST_CASE("struts: bending springs stay and no force appears") {
  Cloth cloth = sheet(6, 6, 0.1, 0.2);
  Noise noise(2);
  for (Vec3& x : cloth.particles.x) x += 0.01 * noise.vector();
  const Cloth before = cloth;
  std::vector<int> all;
  for (int i = 0; i < 36; ++i) all.push_back(i);
  const int added = add_struts(cloth, all);
  CHECK(added > 100);
  CHECK(cloth.bending.size() == before.bending.size() + std::size_t(added));
  CHECK(sorted(cloth.bending));
  std::vector<Vec3> a(36, Vec3::Zero()), b = a;
  add_forces(cloth, cloth.particles.x, a);
  add_forces(before, cloth.particles.x, b);
  for (int i = 0; i < 36; ++i) CHECK((a[i] - b[i]).norm() < 1e-12);
  CHECK(potential_energy(cloth, cloth.particles.x) ==
        Approx(potential_energy(before, cloth.particles.x)).epsilon(1e-12));
}

TEST_CASE("struts: those of a width are as long on a fine mesh as on a coarse one, and about as many") {
  std::vector<int> counts;
  for (const int n : {9, 17, 49}) {  // squares of an eighth of the width, and finer ones
    Cloth cloth = sheet(n, n, 0.8 / (n - 1), 0, 1, 300, 0);
    cloth.bending.clear();
    std::vector<int> all;
    for (int i = 0; i < n * n; ++i) all.push_back(i);
    counts.push_back(add_struts(cloth, all, {.width = 0.8}));
    CHECK(sorted(cloth.bending));
    for (const Spring& s : cloth.bending) {
      CHECK(s.rest_length >= 0.2 - 1e-9);
      CHECK(s.rest_length <= (n == 9 ? 4 * std::sqrt(2) * 0.1 : 0.4) + 1e-9);
    }
  }
  CHECK(counts[1] > 0.4 * counts[0]);
  CHECK(counts[2] > 0.4 * counts[0]);
  CHECK(counts[2] < 2 * counts[0]);
  // Where edges are longer than an eighth of the width the rings count, as without a width.
  Cloth coarse = sheet(9, 9, 0.1, 0, 1, 300, 0), rings = coarse;
  std::vector<int> all;
  for (int i = 0; i < 81; ++i) all.push_back(i);
  CHECK(add_struts(coarse, all, {.width = 0.1}) == add_struts(rings, all));
}

TEST_CASE("struts: what cannot be is refused and nothing changes") {
  Cloth cloth = sheet(4, 4, 0.1);
  const std::size_t n = cloth.bending.size();
  StrutOptions o;
  o.stiffness = -1;
  CHECK_THROWS_WITH(add_struts(cloth, std::vector<int>{0}, o), Catch::Contains("stiffness = -1"));
  o = {};
  o.nearest = 1;
  CHECK_THROWS_WITH(add_struts(cloth, std::vector<int>{0}, o), Catch::Contains("nearest = 1"));
  o = {};
  o.farthest = 1;
  CHECK_THROWS_WITH(add_struts(cloth, std::vector<int>{0}, o), Catch::Contains("farthest = 1"));
  o = {};
  o.width = -1;
  CHECK_THROWS_WITH(add_struts(cloth, std::vector<int>{0}, o), Catch::Contains("width = -1"));
  CHECK_THROWS_WITH(add_struts(cloth, std::vector<int>{16}), Catch::Contains("particle 16"));
  CHECK(cloth.bending.size() == n);
}
