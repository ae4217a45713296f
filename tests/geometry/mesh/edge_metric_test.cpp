// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/mesh/edge_metric.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "geometry/mesh/errors.h"
#include "geometry/mesh/property_names.h"
#include "tests/test_meshes.h"

using namespace furrow::geometry;

TEST_CASE("triangle_area: known triangles, needles, and edges that close no triangle") {
  CHECK(triangle_area(3, 4, 5) == Approx(6).epsilon(1e-15));
  CHECK(triangle_area(5, 3, 4) == triangle_area(3, 4, 5));
  CHECK(triangle_area(1, 1, 3) == 0);
  // Isosceles needle of base 1e-8 and legs 1: area base / 2, which the textbook formula misses by far.
  CHECK(triangle_area(1, 1, 1e-8) == Approx(0.5e-8).epsilon(1e-14));
}

TEST_CASE("bounded_cotangents: right triangle, bound, and nothing without an area") {
  const auto cot = bounded_cotangents(3, 4, 5);  // opposite 5 lies the right angle
  CHECK(cot[0] == Approx(4. / 3));
  CHECK(cot[1] == Approx(3. / 4));
  CHECK(cot[2] == Approx(0).margin(1e-15));
  const auto needle = bounded_cotangents(1, 1, 1e-6);
  CHECK(needle[2] == Approx(100));
  CHECK(std::abs(needle[0]) < 1e-3);
  for (double c : bounded_cotangents(1, 1, 2)) CHECK(c == 0);
  for (double c : bounded_cotangents(0, 0, 0)) CHECK(c == 0);
}

TEST_CASE("rest_lengths: the map where it is set, the shape where it is not") {
  Mesh mesh = furrow::tests::single_triangle();
  const Edge first(0), second(1);
  CHECK(rest_lengths(mesh)[0] == spatial_length(mesh, first));
  ensure_map(mesh, attribute::rest_length)[first] = 7;
  CHECK(rest_lengths(mesh)[0] == 7);
  CHECK(rest_lengths(mesh)[1] == spatial_length(mesh, second));
  ensure_map(mesh, attribute::rest_length)[second] = -1;
  CHECK_THROWS_AS(rest_lengths(mesh), ContentError);
}
