// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/figure/skeleton.h"

#include <catch2/catch.hpp>
#include <numbers>

#include "geometry/mesh/errors.h"
#include "tests/geometry/figure/posed_figure.h"

using namespace furrow::geometry;
using namespace furrow::tests;

TEST_CASE("find_skeleton: our mannequin's landmarks lie upon each other, its limbs mirror each other") {
  const Skeleton s = skeleton_of(our_mannequin());
  const double heights[] = {s.low, s.crotch, s.waist, s.armpits, s.shoulders, s.neck, s.high};
  CHECK(std::is_sorted(std::begin(heights), std::end(heights)));
  CHECK(s.high - s.low == Approx(1.70).margin(1e-3));
  CHECK(s.armpits == Approx(1.27).margin(0.04));
  CHECK(s.faces == 1);
  REQUIRE(s.arms[0]);
  REQUIRE(s.arms[1]);
  CHECK(s.arms[0]->axis.x() > 0.4);
  CHECK(s.arms[0]->axis.x() == Approx(-s.arms[1]->axis.x()).margin(0.02));
  CHECK(s.arms[0]->length == Approx(s.arms[1]->length).margin(0.015));
  CHECK(s.arms[0]->length == Approx(0.46).margin(0.04));
  for (std::size_t i = 1; i < s.arms[0]->rings.size(); ++i)
    CHECK(s.arms[0]->rings[i - 1].along < s.arms[0]->rings[i].along);
  CHECK(s.legs[0].slices.back().centre[0] > 0.05);
  CHECK(s.legs[1].slices.back().centre[0] < -0.05);
}

TEST_CASE("find_skeleton: arms that are raised are found where they are held") {
  const Skeleton before = skeleton_of(our_mannequin());
  for (const double degrees : {20.0, 40.0, -25.0}) {
    const Skeleton s = skeleton_of(with_raised_arms(our_mannequin(), degrees * std::numbers::pi / 180));
    for (std::size_t side = 0; side < 2; ++side) {
      REQUIRE(s.arms[side]);
      const Vector &a = before.arms[side]->axis, &b = s.arms[side]->axis;
      const double turn = std::atan2(std::sqrt(CGAL::cross_product(a, b).squared_length()), a * b);
      CHECK(turn * 180 / std::numbers::pi == Approx(std::abs(degrees)).margin(5));
      CHECK(std::sqrt((before.arms[side]->rings.front().centre - s.arms[side]->rings.front().centre)
                          .squared_length()) < 0.05);
      CHECK(s.arms[side]->length == Approx(before.arms[side]->length).margin(0.05));
    }
  }
}

TEST_CASE("find_skeleton: a body without a torso or without legs is refused, and says what is missing") {
  CHECK_THROWS_AS(skeleton_of(icosphere(3, 0.8)), ContentError);
  CHECK_THROWS_WITH(skeleton_of(scaled(our_mannequin(), 100)), Catch::Contains("no torso"));
  Mesh column = cylinder(0.15, 1.7, 48, 100);
  CHECK_THROWS_WITH(skeleton_of(column), Catch::Contains("legs"));
  CHECK_THROWS_WITH(find_skeleton({}, {}), Catch::Contains("empty"));
}
