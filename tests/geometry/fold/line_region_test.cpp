// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/fold/line_region.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <stdexcept>

#include "geometry/mesh/edge_metric.h"
#include "geometry/mesh/property_names.h"
#include "geometry/mesh/sheet.h"
#include "geometry/mesh/two_ring.h"
#include "geometry/mesh/vertex_attributes.h"
#include "geometry/rest/rest_metric.h"
#include "tests/test_meshes.h"

using namespace furrow::geometry;
using namespace furrow::tests;

namespace {

std::vector<Vertex> middle(const Mesh& mesh) {
  for (Vertex v : mesh.vertices())
    if (std::hypot(mesh.point(v).x(), mesh.point(v).y() - 0.5) < 0.02) return {v};
  return {};
}

}  // namespace

TEST_CASE("vertices_within: on a grid of one diagonal the ways along edges are known") {
  const Mesh mesh = grid(10, 10);
  const std::vector<double> lengths = rest_lengths(mesh);
  const Vertex centre(60);  // (0.5, 0.5)
  const auto within = [&](double reach) {
    return vertices_within(mesh, std::span(&centre, 1), reach, lengths);
  };
  CHECK(within(0) == std::vector<Vertex>{centre});
  CHECK(within(0.11).size() == 5);
  CHECK(within(0.15).size() == 7);    // and two along the diagonal
  CHECK(within(0.201).size() == 13);  // |dx| + |dy| <= 2
  CHECK(within(9).size() == mesh.number_of_vertices());
  CHECK_THROWS_AS(within(-1), std::invalid_argument);
  CHECK_THROWS_AS(within(NAN), std::invalid_argument);
  const Vertex none(500);
  CHECK_THROWS_AS(vertices_within(mesh, std::span(&none, 1), 1, lengths), std::invalid_argument);
}

TEST_CASE("line_region: all within half the width, none far beyond it, on a coarse mesh and a fine one") {
  for (double h : {0.04, 0.02, 0.01}) {
    const Mesh mesh = equilateral_sheet(1, 1, h);
    const auto line = middle(mesh);
    const Point centre = mesh.point(line[0]);
    std::vector<char> inside(mesh.num_vertices(), 0);
    for (Vertex v : line_region(mesh, line, 0.3, rest_lengths(mesh))) inside[v.idx()] = 1;
    for (Vertex v : mesh.vertices()) {
      const double d = std::sqrt(CGAL::squared_distance(mesh.point(v), centre));
      if (d <= 0.15) CHECK(inside[v.idx()]);
      if (d > largest_detour * 0.15 + 1e-9) CHECK_FALSE(inside[v.idx()]);
    }
  }
}

TEST_CASE("line_region: without a width, and where the mesh is coarser than it, two rings") {
  const Mesh mesh = equilateral_sheet(1, 1, 0.05);
  const auto line = middle(mesh);
  for (double width : {unset_value, 0.0, 0.01})
    CHECK(line_region(mesh, line, width, rest_lengths(mesh)) == two_ring(mesh, line));
}

TEST_CASE("line_region: it does not shrink with the cloth that its fold takes up") {
  Mesh mesh = equilateral_sheet(1, 1, 0.02);
  ensure_rest_positions(mesh);
  const auto line = middle(mesh);
  const auto before = line_region(mesh, line, 0.3, lengths_before_lines(mesh));
  lift(mesh, [](double x, double y) { return 0.2 * std::exp(-100 * (x * x + (y - 0.5) * (y - 0.5))); });
  ensure_rest_lengths(mesh);
  CHECK(line_region(mesh, line, 0.3, lengths_before_lines(mesh)) == before);
  CHECK(line_region(mesh, line, 0.3, rest_lengths(mesh)).size() < before.size());
}
