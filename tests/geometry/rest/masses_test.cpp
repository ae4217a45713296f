// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/rest/masses.h"

#include <catch2/catch.hpp>
#include <limits>
#include <stdexcept>

#include "geometry/mesh/edge_metric.h"
#include "geometry/mesh/property_names.h"
#include "geometry/rest/rest_state.h"
#include "tests/test_meshes.h"

using namespace furrow::geometry;
using namespace furrow::tests;

TEST_CASE("lump_masses: a third of each triangle at its corners") {
  Mesh mesh = single_triangle();
  CHECK(lump_masses(mesh, 0.6) == Approx(0.3).epsilon(1e-15));
  for (Vertex v : mesh.vertices()) CHECK((*find_map(mesh, attribute::mass))[v] == Approx(0.1).epsilon(1e-15));
}

TEST_CASE("masses: they sum to density times rest area, whatever the present shape") {
  Mesh mesh = jittered(9, 7, 0.3, 2, 2, 1);
  const Vertex lone = mesh.add_vertex(Point(1, 1, 1));
  auto rest = ensure_map(mesh, attribute::rest_length);
  for (Edge e : mesh.edges()) rest[e] = spatial_length(mesh, e);
  lift(mesh, [](double x, double y) { return x * y; });
  const double total = lump_masses(mesh, 0.15);
  CHECK(total == Approx(0.15 * 2).epsilon(1e-13));
  CHECK(total == Approx(0.15 * rest_area(mesh)).epsilon(1e-13));
  double sum = 0;
  for (Vertex v : mesh.vertices()) sum += (*find_map(mesh, attribute::mass))[v];
  CHECK(sum == Approx(total).epsilon(1e-13));
  CHECK((*find_map(mesh, attribute::mass))[lone] == 0);
}

TEST_CASE("lump_masses: it refuses a density that is none") {
  Mesh mesh = single_triangle();
  for (double density :
       {0., -1., std::numeric_limits<double>::infinity(), std::numeric_limits<double>::quiet_NaN()})
    CHECK_THROWS_AS(lump_masses(mesh, density), std::invalid_argument);
  CHECK_FALSE(find_map(mesh, attribute::mass));
}
