// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/mesh/crossings.h"

#include <catch2/catch.hpp>

#include "geometry/mesh/self_intersections.h"
#include "tests/test_meshes.h"

using namespace furrow::geometry;
using namespace furrow::tests;

namespace {

/// A level grid of 4 x 4 squares below, and upright triangles that pass through it at x = 0.5 and at x = 2.5.
Mesh speared(int spears) {
  Mesh mesh = grid(4, 4);
  for (int i = 0; i < spears; ++i) {
    const double x = 0.125 + 0.5 * i;
    const Vertex a = mesh.add_vertex({x, 0.13, -0.1}), b = mesh.add_vertex({x + 0.01, 0.13, 0.1}),
                 c = mesh.add_vertex({x, 0.14, 0.1});
    mesh.add_face(a, b, c);
  }
  return mesh;
}

}  // namespace

TEST_CASE("find_parts: pieces come by size, each with its vertices, faces and centre") {
  const Mesh mesh = speared(2);
  const Parts parts = find_parts(mesh);
  REQUIRE(parts.list.size() == 3);
  CHECK(parts.list[0].vertices == 25);
  CHECK(parts.list[0].faces == 32);
  CHECK(parts.list[1].faces == 1);
  CHECK(parts.list[1].area >= parts.list[2].area);
  CHECK(parts.of_face[32] != parts.of_face[33]);
  CHECK(parts.of_face[0] == 0);
  CHECK(parts.of_vertex[25] == parts.of_face[32]);
  CHECK(find_parts(Mesh()).list.empty());
}

TEST_CASE("find_crossings: a sound mesh has none, two spears make two places between two parts each") {
  CHECK(find_crossings(grid(4, 4), find_parts(grid(4, 4))).pairs == 0);
  const Mesh mesh = speared(2);
  const Parts parts = find_parts(mesh);
  const Crossings found = find_crossings(mesh, parts);
  CHECK(found.pairs == count_self_intersections(mesh));
  REQUIRE(found.pairs >= 2);
  CHECK(found.from_start == 0);
  REQUIRE(found.places.size() == 2);
  CHECK(found.places[0].pairs + found.places[1].pairs == found.pairs);
  for (const CrossingPlace& place : found.places) {
    CHECK(place.parts[0] == 0);
    CHECK(place.parts[1] > 0);
    CHECK(std::abs(place.centre.z()) < 0.11);
    CHECK(place.extent < 0.6);
  }
  CHECK(std::is_sorted(found.faces.begin(), found.faces.end()));
}

TEST_CASE("find_crossings: what crossed before is told from what crosses anew") {
  const Mesh before = speared(1), after = speared(2);
  const std::vector<char> crossed = crossed_vertices(before, find_crossings(before, find_parts(before)));
  const Crossings found = find_crossings(after, find_parts(after), crossed);
  const std::size_t old = count_self_intersections(before);
  CHECK(old > 0);
  CHECK(found.from_start == old);
  CHECK(found.pairs > old);
}

TEST_CASE("self_intersections: its pairs are in order and as many as are counted") {
  const Mesh mesh = speared(2);
  const auto pairs = self_intersections(mesh);
  CHECK(pairs.size() == count_self_intersections(mesh));
  CHECK(std::is_sorted(pairs.begin(), pairs.end()));
  for (const auto& [f, g] : pairs) CHECK(f < g);
}
