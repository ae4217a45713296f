// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/mesh/measures.h"

#include <CGAL/Polygon_mesh_processing/measure.h>

#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <numbers>

#include "geometry/mesh/errors.h"
#include "tests/test_meshes.h"

using namespace furrow::geometry;
using namespace furrow::tests;

TEST_CASE("measure: a cube") {
  const MeshInfo info = measure(cube());
  CHECK(info.vertices == 8);
  CHECK(info.edges == 18);
  CHECK(info.faces == 12);
  CHECK(info.components == 1);
  CHECK(info.boundary_loops == 0);
  CHECK(info.euler_characteristic == 2);
  CHECK(info.closed);
  CHECK(info.manifold);
  CHECK(info.degenerate_faces == 0);
  CHECK(info.area == Approx(6));
  CHECK(info.volume.value() == Approx(1));
  CHECK(info.box_min == Point(0, 0, 0));
  CHECK(info.box_max == Point(1, 1, 1));
  CHECK(info.mean_edge_length == Approx((12 + 6 * std::sqrt(2)) / 18));
  CHECK(info.min_angle_deg == Approx(45));
}

TEST_CASE("measure: torus, sheet, parts, and a body turned inside out far from the origin") {
  CHECK(measure(torus_lattice(20, 12)).euler_characteristic == 0);
  const MeshInfo sheet = measure(grid(4, 3, 2, 1));
  CHECK(sheet.boundary_loops == 1);
  CHECK_FALSE(sheet.closed);
  CHECK_FALSE(sheet.volume);
  CHECK(sheet.area == Approx(2));
  const MeshInfo tube = measure(cylinder(1, 1, 12, 3));
  CHECK(tube.boundary_loops == 2);
  CHECK(tube.euler_characteristic == 0);
  Mesh parts = icosphere(3);
  append(parts, icosphere(1, 0.5, {4, 0, 0}));
  parts.add_vertex(Point(9, 9, 9));
  const MeshInfo two = measure(parts);
  CHECK(two.components == 2);
  CHECK(two.isolated_vertices == 1);
  CHECK(two.euler_characteristic == 4);
  CHECK(two.area == Approx(CGAL::Polygon_mesh_processing::area(parts)).epsilon(1e-13));
  CHECK(two.volume.value() == Approx(CGAL::Polygon_mesh_processing::volume(parts)).epsilon(1e-12));
  const Mesh ball = icosphere(4, 1, {1e6, 0, 0});
  CHECK(measure(ball).volume.value() == Approx(4 * std::numbers::pi / 3).epsilon(0.01));
  std::vector<Point> points(ball.points().begin(), ball.points().end());
  std::vector<std::array<int, 3>> faces;
  for (Face f : ball.faces()) {
    const Halfedge h = ball.halfedge(f);
    faces.push_back({static_cast<int>(ball.source(h).idx()),
                     static_cast<int>(ball.target(ball.next(h)).idx()),
                     static_cast<int>(ball.target(h).idx())});
  }
  CHECK(measure(mesh_of(points, faces)).volume.value() == Approx(-*measure(ball).volume).epsilon(1e-12));
}

TEST_CASE("measure: degenerate faces, two fans at one vertex, and nothing at all") {
  const Mesh needles = mesh_of({{0, 0, 0}, {1, 0, 0}, {0.5, 0, 0}, {0.5, -1, 0}, {0, 1e-3, 0}},
                               {{0, 1, 2}, {1, 0, 3}, {0, 2, 4}});
  CHECK(measure(needles).degenerate_faces == 1);
  CHECK(measure(needles).min_angle_deg == 0);
  const Mesh bow_tie =
      mesh_of({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}}, {{0, 1, 2}, {0, 3, 4}});
  CHECK_FALSE(measure(bow_tie).manifold);
  CHECK(measure(bow_tie).components == 2);
  const MeshInfo none = measure(Mesh());
  CHECK(none.faces == 0);
  CHECK_FALSE(none.closed);
  CHECK(none.min_angle_deg == 0);
  Mesh bad = cube();
  bad.point(Vertex(1)) = Point(0, std::numeric_limits<double>::quiet_NaN(), 0);
  CHECK_THROWS_AS(measure(bad), ContentError);
}

TEST_CASE("length_text: lengths stand as people write them") {
  for (const auto& [metres, text] : {std::pair(0.13, "130 mm"),
                                     {0.0036, "3.6 mm"},
                                     {0.003, "3 mm"},
                                     {4e-5, "0.04 mm"},
                                     {0.1296, "130 mm"},
                                     {0.99996, "1 m"},
                                     {0.9994, "999 mm"},
                                     {1.7499, "1.75 m"},
                                     {80, "80 m"},
                                     {1700, "1700 m"},
                                     {12345.6, "12346 m"},
                                     {0, "0 mm"},
                                     {-0.05, "-50 mm"},
                                     {-2.5, "-2.5 m"},
                                     {1e-9, "1e-09 m"}}) {
    INFO(metres);
    CHECK(length_text(metres) == text);
  }
}
