// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/mesh/two_ring.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <stdexcept>

#include "geometry/mesh/property_names.h"
#include "tests/test_meshes.h"

using namespace furrow::geometry;

TEST_CASE("vertices_within_rings: it counts hexagonal rings of 1, 7, 19, 37 on a six-valent lattice") {
  const Mesh mesh = furrow::tests::torus_lattice(12, 12);
  const std::vector<Vertex> seed = {Vertex(77)};
  const std::size_t expected[] = {1, 7, 19, 37};
  for (int rings = 0; rings < 4; ++rings) {
    const auto found = vertices_within_rings(mesh, seed, rings);
    CHECK(found.size() == expected[rings]);
    CHECK(std::is_sorted(found.begin(), found.end()));
  }
  CHECK(two_ring(mesh, seed) == vertices_within_rings(mesh, seed, 2));
}

TEST_CASE("vertices_within_rings: it takes each vertex once, stops at the border and knows lone vertices") {
  Mesh mesh = furrow::tests::grid(2, 2);
  const Vertex lone = mesh.add_vertex(Point(5, 5, 5));
  const std::vector<Vertex> seeds = {Vertex(4), Vertex(4), lone, Vertex(0)};
  CHECK(vertices_within_rings(mesh, seeds, 0) == std::vector<Vertex>{Vertex(0), Vertex(4), lone});
  CHECK(vertices_within_rings(mesh, seeds, 9).size() == 10);
  CHECK_THROWS_AS(vertices_within_rings(mesh, seeds, -1), std::invalid_argument);
  CHECK_THROWS_AS(vertices_within_rings(mesh, std::vector{Vertex(10)}, 1), std::invalid_argument);
}

TEST_CASE("line_vertices: it lists the vertices of all lines") {
  Mesh mesh = furrow::tests::grid(2, 2);
  CHECK(line_vertices(mesh).empty());
  auto line = ensure_map(mesh, attribute::line);
  line[Vertex(7)] = 0;
  line[Vertex(2)] = 3;
  CHECK(line_vertices(mesh) == std::vector<Vertex>{Vertex(2), Vertex(7)});
}
