// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/mesh/sheet.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "geometry/mesh/edge_metric.h"
#include "geometry/mesh/measures.h"
#include "geometry/mesh/property_names.h"
#include "tests/test_meshes.h"
#include "tests/test_paths.h"

using namespace furrow::geometry;
using namespace furrow::tests;

TEST_CASE("equilateral_sheet: size, normal, corners and edges") {
  const Mesh mesh = equilateral_sheet(1, 1, 0.02);
  const MeshInfo info = measure(mesh);
  CHECK(info.vertices == 3038);
  CHECK(info.euler_characteristic == 1);
  CHECK(info.area == Approx(1).epsilon(1e-12));
  CHECK(info.box_min == Point(-0.5, 0, 0));
  CHECK(info.box_max == Point(0.5, 1, 0));
  CHECK(info.min_angle_deg > 29.8);
  for (const Point& corner : {Point(-0.5, 0, 0), Point(0.5, 0, 0), Point(-0.5, 1, 0), Point(0.5, 1, 0)})
    CHECK(std::count(mesh.points().begin(), mesh.points().end(), corner) == 1);
  std::size_t whole = 0;
  for (Edge e : mesh.edges()) whole += std::abs(spatial_length(mesh, e) - 0.02) < 1e-4;
  CHECK(whole > 0.95 * static_cast<double>(mesh.number_of_edges()));
  for (Face f : mesh.faces()) {
    const Halfedge h = mesh.halfedge(f);
    const Point &a = mesh.point(mesh.source(h)), &b = mesh.point(mesh.target(h)),
                &c = mesh.point(mesh.target(mesh.next(h)));
    REQUIRE(CGAL::cross_product(b - a, c - a).z() > 0);
  }
}

TEST_CASE("equilateral_sheet: it refuses lengths that are none") {
  for (double bad :
       {0., -1., std::numeric_limits<double>::infinity(), std::numeric_limits<double>::quiet_NaN()}) {
    CHECK_THROWS_AS(equilateral_sheet(bad, 1, 0.1), std::invalid_argument);
    CHECK_THROWS_AS(equilateral_sheet(1, bad, 0.1), std::invalid_argument);
    CHECK_THROWS_AS(equilateral_sheet(1, 1, bad), std::invalid_argument);
  }
  CHECK_THROWS_AS(equilateral_sheet(1, 1, 2), std::invalid_argument);
  CHECK_THROWS_AS(equilateral_sheet(1, 1, 1e-5), std::invalid_argument);
  CHECK(equilateral_sheet(1, 0.1, 0.5).number_of_faces() > 0);
}

TEST_CASE("sheet: meshes/sheet.obj is what equilateral_sheet makes") {
  const Mesh made = equilateral_sheet(1, 1, 0.02), read = read_plain_obj(source_dir() / "meshes/sheet.obj");
  REQUIRE(read.number_of_vertices() == made.number_of_vertices());
  REQUIRE(read.number_of_faces() == made.number_of_faces());
  for (Vertex v : made.vertices()) CHECK(read.point(v) == made.point(v));
}

TEST_CASE("woven_sheet: size, normal, cells and diagonals") {
  const Mesh mesh = woven_sheet(0.4, 0.31, 0.1);
  const MeshInfo info = measure(mesh);
  CHECK(info.vertices == 20);
  CHECK(info.area == Approx(0.124).epsilon(1e-12));
  CHECK(info.box_min == Point(-0.2, 0, 0));
  CHECK(info.box_max == Point(0.2, 0.31, 0));
  const auto diagonal = *find_map(mesh, attribute::diagonal);
  std::size_t diagonals = 0, valence_8 = 0;
  for (Edge e : mesh.edges()) diagonals += diagonal[e];
  for (Vertex v : mesh.vertices()) valence_8 += mesh.degree(v) == 8;
  CHECK(diagonals == 12);
  CHECK(valence_8 == 3);
  for (Face f : mesh.faces()) {
    const Halfedge h = mesh.halfedge(f);
    const Point &a = mesh.point(mesh.source(h)), &b = mesh.point(mesh.target(h)),
                &c = mesh.point(mesh.target(mesh.next(h)));
    CHECK(CGAL::cross_product(b - a, c - a).z() > 0);
    int of_face = 0;
    for (Halfedge side : mesh.halfedges_around_face(h)) of_face += diagonal[mesh.edge(side)];
    CHECK(of_face == 1);
  }
  CHECK_THROWS_AS(woven_sheet(0, 1, 0.1), std::invalid_argument);
  CHECK_THROWS_AS(woven_sheet(1, 0.05, 0.1), std::invalid_argument);
  CHECK_THROWS_AS(woven_sheet(1, 1, 1e-5), std::invalid_argument);
}
