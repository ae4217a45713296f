// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/mesh/border_loops.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "geometry/mesh/property_names.h"
#include "tests/test_meshes.h"

using namespace furrow::geometry;
using namespace furrow::tests;

TEST_CASE("border_loops: a tube that widens has two circles, the longer first, found by name") {
  Mesh mesh = cylinder(0.5, 2, 40, 4);
  for (Vertex v : mesh.vertices()) {
    const Point p = mesh.point(v);
    mesh.point(v) = {p.x() * (1 + p.y()), p.y(), p.z() * (1 + p.y())};  // the top has three times the radius
  }
  const auto loops = border_loops(mesh);
  REQUIRE(loops.size() == 2);
  CHECK(loops[0].length == Approx(80 * 1.5 * std::sin(std::numbers::pi / 40)).epsilon(1e-12));
  CHECK(loops[0].mean_height == Approx(2));
  CHECK(loops[1].mean_height == Approx(0).margin(1e-15));
  CHECK(loops[0].mean_radius == Approx(1.5));
  CHECK(loops[1].mean_radius == Approx(0.5));
  CHECK(loops[1].vertices.front() == Vertex(0));
  CHECK(find_border_loop(loops, "top") == 0);
  CHECK(find_border_loop(loops, "bottom") == 1);
  CHECK(find_border_loop(loops, "1") == 1);
  for (const char* name : {"2", "-1", "middle", "", "1x", "99999999999999999999999"})
    CHECK_THROWS_AS(find_border_loop(loops, name), std::invalid_argument);
  for (const BorderLoop& loop : loops) {
    CHECK(loop.vertices.size() == 40);
    for (std::size_t i = 0; i < 40; ++i)  // neighbours, with the border on one side
      CHECK(mesh.is_border(mesh.halfedge(loop.vertices[i], loop.vertices[(i + 1) % 40])));
  }
}

TEST_CASE("border_loops: rest length of a loop counts what was set") {
  Mesh mesh = grid(3, 3);
  const auto loops = border_loops(mesh);
  REQUIRE(loops.size() == 1);
  CHECK(loops[0].length == Approx(4));
  CHECK(rest_length(mesh, loops[0]) == Approx(4));
  auto rest = ensure_map(mesh, attribute::rest_length);
  for (Edge e : mesh.edges()) rest[e] = 0.5;
  CHECK(rest_length(mesh, loops[0]) == Approx(6));
  CHECK_THROWS_AS(rest_length(mesh, BorderLoop{{Vertex(0), Vertex(15)}, 0, 0}), std::invalid_argument);
}

TEST_CASE("border_loops: a closed mesh has no border loops, and says so") {
  const auto loops = border_loops(icosphere(1));
  CHECK(loops.empty());
  CHECK_THROWS_WITH(find_border_loop(loops, "top"), Catch::Contains("no border"));
}
