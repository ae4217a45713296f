// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>
#include <cmath>

#include "tests/physics/pairs/random_pairs.h"

using namespace furrow::physics;
using namespace furrow::tests;

TEST_CASE("pair_mesh: cloth is as thick as was asked, less where a triangle is thin at rest") {
  Cloth cloth = rough_sheet(10, 0, 1);
  const PairMesh thin = pair_mesh(cloth, 0.001);
  CHECK(thin.edges.size() == 320);
  for (const double r : thin.radius) CHECK(r == 0.0005);
  const PairMesh thick = pair_mesh(cloth, 0.3);
  for (const double r : thick.radius) CHECK(r == Approx(0.25 * 0.1 / std::sqrt(2)));
  CHECK(thick.largest_radius == Approx(0.25 * 0.1 / std::sqrt(2)));
  // The rest state counts, not how it lies.
  for (Vec3& x : cloth.particles.x) x *= 0.01;
  CHECK(pair_mesh(cloth, 0.3).radius == thick.radius);
  cloth.membrane.clear();
  CHECK(pair_mesh(cloth, 0.3).radius[0] == Approx(0.01 * thick.radius[0]));
  CHECK_THROWS_AS(pair_mesh(cloth, 0), std::invalid_argument);
  std::vector<double> own(cloth.particles.size(), 1e-4);
  own[2] = 2e-4;
  const PairMesh mixed = pair_mesh(cloth, 0.3, own);
  CHECK(mixed.radius[1] == 0.5e-4);
  CHECK(mixed.radius[2] == 1e-4);
  own[2] = 0;
  CHECK_THROWS_AS(pair_mesh(cloth, 0.3, own), std::invalid_argument);
  own.pop_back();
  CHECK_THROWS_AS(pair_mesh(cloth, 0.3, own), std::invalid_argument);
  cloth.triangles[0][1] = 500;
  CHECK_THROWS_AS(pair_mesh(cloth, 0.1), std::invalid_argument);
}

TEST_CASE("pair_mesh: what springs without length join is one vertex to contact, through others, too") {
  Cloth cloth = rough_sheet(4, 0, 1);
  const PairMesh plain = pair_mesh(cloth, 0.001);
  for (std::size_t v = 0; v < plain.knot.size(); ++v) CHECK(plain.knot[v] == int(v));
  CHECK_FALSE(are_neighbours(plain, std::array{0}, std::array{9, 12}));
  cloth.bending = {{3, 7, 1e-9, 10}, {7, 12, 1e-9, 10}, {0, 24, 2e-9, 10}};
  const PairMesh tied = pair_mesh(cloth, 0.001);
  CHECK(tied.knot[12] == 3);
  CHECK(tied.knot[7] == 3);
  CHECK(tied.knot[24] == 24);
  CHECK(are_neighbours(tied, std::array{3}, std::array{9, 12}));
  CHECK_FALSE(are_neighbours(tied, std::array{0}, std::array{9, 24}));
}

TEST_CASE("pair_mesh: structural springs tell the lengths at rest where there is no membrane") {
  Cloth cloth = rough_sheet(4, 0, 1);
  cloth.membrane.clear();
  for (const auto& e : pair_mesh(cloth, 0.001).edges) {
    const double l = (cloth.particles.x[std::size_t(e[1])] - cloth.particles.x[std::size_t(e[0])]).norm();
    cloth.structural.push_back({e[0], e[1], 0.5 * l, 10});
  }
  CHECK(pair_mesh(cloth, 1).radius[0] == Approx(0.5 * 0.25 * 0.25 / std::sqrt(2)));
}
