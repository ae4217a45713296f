// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/fold/line_height.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <stdexcept>
#include <vector>

#include "geometry/mesh/edge_metric.h"
#include "geometry/mesh/property_names.h"
#include "geometry/mesh/sheet.h"
#include "tests/test_meshes.h"

using namespace furrow::geometry;
using namespace furrow::tests;

namespace {

/// A flat sheet with a horizontal line of id 4 over |x| < half_width at mid height, lifted by k; rest lengths
/// are flat.
Mesh sheet_with_line(double k, double half_width = 0.31) {
  Mesh mesh = equilateral_sheet(1, 1, 0.05);
  auto rest = ensure_map(mesh, attribute::rest_length);
  for (Edge e : mesh.edges()) rest[e] = spatial_length(mesh, e);
  auto line = ensure_map(mesh, attribute::line);
  for (Vertex v : mesh.vertices())
    if (std::abs(mesh.point(v).y() - 0.52) < 0.02 && std::abs(mesh.point(v).x()) < half_width) {
      line[v] = 4;
      mesh.point(v) = mesh.point(v) + Vector(0, 0, k);
    }
  return mesh;
}
Mesh moved(Mesh mesh) {
  for (Vertex v : mesh.vertices()) {
    const Point p = mesh.point(v);
    mesh.point(v) = {0.36 * p.x() + 0.48 * p.y() - 0.8 * p.z() + 5, -0.8 * p.x() + 0.6 * p.y() - 2,
                     0.48 * p.x() + 0.64 * p.y() + 0.6 * p.z()};
  }
  return mesh;
}

}  // namespace

TEST_CASE("line_heights: a line lifted out of a plane has its k, also where it reaches the border") {
  for (double k : {0.02, -0.03, 0.})
    for (double half_width : {0.31, 0.01, 0.6}) {
      const auto heights = line_heights(sheet_with_line(k, half_width));
      REQUIRE(heights.size() == 1);
      CHECK(heights[0].line == 4);
      CHECK(heights[0].height == Approx(k).margin(1e-13));
    }
  CHECK(line_heights(sheet_with_line(0.02))[0].vertices == 13);
}

TEST_CASE("line_heights: the two-ring may be as bumpy as it likes, only its border counts") {
  Mesh mesh = sheet_with_line(0.02);
  for (Vertex v : mesh.vertices())
    if ((*find_map(mesh, attribute::line))[v] < 0 && std::abs(mesh.point(v).y() - 0.52) < 0.06 &&
        std::abs(mesh.point(v).x()) < 0.3)
      mesh.point(v) = mesh.point(v) + Vector(0, 0, 0.013);
  CHECK(line_heights(mesh)[0].height == Approx(0.02).margin(1e-13));
}

TEST_CASE("line_heights: it moves rigidly with the cloth") {
  Mesh mesh = sheet_with_line(0.02);
  lift(mesh, [](double x, double y) { return 0.1 * std::sin(3 * x) * y; });
  CHECK(line_heights(moved(mesh))[0].height == Approx(line_heights(mesh)[0].height).margin(1e-13));
}

TEST_CASE("line_heights: on a cylinder a line has k, plus the sag of the fill") {
  const double radius = 0.25, k = 0.02;
  Mesh mesh = cylinder(radius, 1, 64, 40);
  auto line = ensure_map(mesh, attribute::line);
  for (int j = 10; j <= 30; ++j) line[Vertex(static_cast<Vertex::size_type>(64 * j))] = 0;  // along the axis
  const double sag = line_heights(mesh)[0].height;
  const double half = 2 * 2 * 3.14159265 * radius / 64;  // two rings
  CHECK(sag > 0);
  CHECK(sag == Approx(half * half / (2 * radius)).epsilon(0.35));
  auto rest = ensure_map(mesh, attribute::rest_length);
  for (Edge e : mesh.edges()) rest[e] = spatial_length(mesh, e);
  for (Vertex v : mesh.vertices())
    if (line[v] == 0) mesh.point(v) = mesh.point(v) + Vector(0, 0, k);
  CHECK(line_heights(mesh)[0].height == Approx(k + sag).epsilon(1e-3));
}

TEST_CASE("line_heights: several lines by their ids, each among the others as they lie") {
  Mesh mesh = sheet_with_line(0.02, 0.16);
  auto line = *find_map(mesh, attribute::line);
  for (Vertex v : mesh.vertices())
    if (std::abs(mesh.point(v).y() - 0.1) < 0.03 && std::abs(mesh.point(v).x()) < 0.21) {
      line[v] = 1;
      mesh.point(v) = mesh.point(v) + Vector(0, 0, -0.01);
    }
  const auto heights = line_heights(mesh);
  REQUIRE(heights.size() == 2);
  CHECK(heights[0].line == 1);
  CHECK(heights[0].height == Approx(-0.01).margin(1e-13));
  CHECK(heights[1].height == Approx(0.02).margin(1e-13));
}

TEST_CASE("line_heights: no lines, nothing, a two-ring without a border has no height") {
  CHECK(line_heights(grid(3, 3)).empty());
  Mesh mesh = cube();
  ensure_map(mesh, attribute::line)[Vertex(0)] = 0;
  ensure_map(mesh, attribute::line)[Vertex(7)] = 0;
  REQUIRE(line_heights(mesh).size() == 1);
  CHECK(std::isnan(line_heights(mesh)[0].height));
}
