// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/figure/close_holes.h"

#include <CGAL/boost/graph/Euler_operations.h>

#include <catch2/catch.hpp>

#include "geometry/mesh/measures.h"
#include "tests/test_meshes.h"

using namespace furrow;
using namespace furrow::geometry;

namespace {

/// Without every n-th face that does not lie on the border.
Mesh holed(Mesh mesh, std::size_t n) {
  std::size_t count = 0;
  for (const Face f : std::vector<Face>(mesh.faces().begin(), mesh.faces().end())) {
    bool inner = true;
    for (const Vertex v : mesh.vertices_around_face(mesh.halfedge(f))) inner = inner && !mesh.is_border(v);
    if (inner && ++count % n == 0) CGAL::Euler::remove_face(mesh.halfedge(f), mesh);
  }
  mesh.collect_garbage();
  return mesh;
}

}  // namespace

TEST_CASE("close_holes: triangles that were taken out come back, and the garment's own border stays") {
  const Mesh whole = tests::grid(12, 12);
  Mesh mesh = holed(whole, 40);
  const std::size_t loops = measure(mesh).boundary_loops;
  REQUIRE(loops > 2);
  CHECK(close_small_holes(mesh, 3) == loops - 1);
  CHECK(measure(mesh).boundary_loops == 1);
  CHECK(mesh.number_of_faces() == whole.number_of_faces());
  CHECK(measure(mesh).area == Approx(measure(whole).area));
  CHECK(mesh.is_valid(false));
}

TEST_CASE("close_holes: the outline of a flat piece is none, a hole in it is") {
  Mesh sheet = tests::grid(2, 2);
  CHECK(close_small_holes(sheet, 8) == 0);
  Mesh frame = tests::grid(3, 3);  // without its middle: both borders are small
  for (const Face f : std::vector<Face>(frame.faces().begin(), frame.faces().end())) {
    bool inner = true;
    for (const Vertex v : frame.vertices_around_face(frame.halfedge(f))) inner = inner && !frame.is_border(v);
    if (inner) CGAL::Euler::remove_face(frame.halfedge(f), frame);
  }
  frame.collect_garbage();
  REQUIRE(measure(frame).boundary_loops == 2);
  CHECK(small_holes(frame, 12).size() == 1);
  CHECK(close_small_holes(frame, 12) == 1);
  CHECK(measure(frame).area == Approx(1));
}

TEST_CASE("close_holes: wider holes, loose triangles and closed meshes are left alone") {
  Mesh tube = tests::cylinder(1, 2, 9, 4), ball = tests::icosphere(1), triangle = tests::single_triangle();
  CHECK(close_small_holes(tube, 8) == 0);
  CHECK(close_small_holes(ball, 8) == 0);
  CHECK(close_small_holes(triangle, 8) == 0);
  CHECK(triangle.number_of_faces() == 1);
  CHECK(close_small_holes(tube, 9) == 2);
  CHECK(measure(tube).closed);
}
