// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/fold/cloth_ways.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "geometry/mesh/sheet.h"
#include "tests/test_meshes.h"

using namespace furrow::geometry;
using namespace furrow::tests;

namespace {

/// Vertices with x = 0.
std::vector<Vertex> column(const Mesh& mesh) {
  std::vector<Vertex> seeds;
  for (Vertex v : mesh.vertices())
    if (std::abs(mesh.point(v).x()) < 1e-9) seeds.push_back(v);
  return seeds;
}

}  // namespace

TEST_CASE("ways_along_cloth: from a straight chain on a flat sheet they are the distances") {
  const Mesh sheet = grid(20, 20, 0.5, 0.5);
  const auto seeds = column(sheet);
  REQUIRE(seeds.size() == 21);
  std::size_t within = 0;
  for (const auto& [v, way] : ways_along_cloth(sheet, seeds, 0.21)) {
    CHECK(way == Approx(sheet.point(v).x()).margin(1e-12));
    ++within;
  }
  CHECK(within == 9 * 21);  // x = 0, 25, ... 200 mm
}

TEST_CASE("ways_along_cloth: from a point they are an eighth too long at most") {
  const Mesh sheet = jittered(30, 30, 0.3, 3, 0.6, 0.6);
  Vertex centre(0);
  const Point middle(0.3, 0.3, 0);
  for (Vertex v : sheet.vertices())
    if (CGAL::squared_distance(sheet.point(v), middle) < CGAL::squared_distance(sheet.point(centre), middle))
      centre = v;
  double most = 1;
  for (const auto& [v, way] : ways_along_cloth(sheet, std::vector<Vertex>{centre}, 0.25)) {
    const double straight = std::sqrt(CGAL::squared_distance(sheet.point(v), sheet.point(centre)));
    CHECK(way >= straight * (1 - 0.01));
    if (straight > 0.1) most = std::max(most, way / straight);
  }
  CHECK(most < 1.125);
}

TEST_CASE("ways_along_cloth: on a tube they go round, and layers that lie close are far") {
  const double radius = 0.05;
  const Mesh tube = cylinder(radius, 0.2, 48, 20);
  std::vector<Vertex> seeds;
  for (Vertex v : tube.vertices())
    if (std::abs(tube.point(v).x()) < 1e-9 && tube.point(v).z() > 0) seeds.push_back(v);
  REQUIRE(!seeds.empty());
  for (const auto& [v, way] : ways_along_cloth(tube, seeds, 1)) {
    const double angle = std::abs(std::atan2(tube.point(v).x(), tube.point(v).z()));
    CHECK(way == Approx(radius * angle).epsilon(0.01).margin(1e-9));
  }
  Mesh flat = tube;  // pressed flat, its layers a millimetre apart
  for (Vertex v : flat.vertices()) {
    const Point p = flat.point(v);
    flat.point(v) = Point(p.x(), p.y(), p.z() > 0 ? 0.001 : 0);
  }
  for (const auto& [v, way] : ways_along_cloth(flat, seeds, 1))
    if (tube.point(v).z() < -0.9 * radius) CHECK(way > 1.5 * radius);
}

TEST_CASE("ways_along_cloth: a seed that is not there and a negative reach are refused") {
  const Mesh sheet = grid(2, 2, 1, 1);
  CHECK_THROWS_AS(ways_along_cloth(sheet, std::vector<Vertex>{Vertex(99)}, 1), std::invalid_argument);
  CHECK_THROWS_AS(ways_along_cloth(sheet, std::vector<Vertex>{Vertex(0)}, -1), std::invalid_argument);
}
