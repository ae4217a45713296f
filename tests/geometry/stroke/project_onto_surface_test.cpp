// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/stroke/project_onto_surface.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include "tests/test_meshes.h"

using namespace furrow::geometry;
using namespace furrow::tests;

namespace {

Point random_point(std::mt19937& random) {
  std::uniform_real_distribution<double> x(-1.5, 1.5);
  return {x(random), x(random), x(random)};
}

void check_closest(const Mesh& mesh, int queries) {
  const SurfaceProjector projector(mesh);
  const std::vector<Face> all(mesh.faces().begin(), mesh.faces().end());
  std::mt19937 random(3);
  for (int k = 0; k < queries; ++k) {
    const Point query = random_point(random);
    CHECK(projector.closest(query).distance ==
          Approx(projector.closest_among(query, all).distance).margin(1e-12));
  }
}

/// Triangles whose corners lie on a circle but for one, which all have at the origin.
Mesh rosette(int triangles) {
  Mesh mesh;
  for (int i = 0; i < triangles; ++i) {
    const auto at = [&](double k) {
      const double angle = 2 * std::numbers::pi * k / triangles;
      return mesh.add_vertex(Point(std::cos(angle), std::sin(angle), 0.1 * (i % 7)));
    };
    const Vertex centre = mesh.add_vertex(Point(0, 0, 0)), a = at(i), b = at(i + 0.5);
    mesh.add_face(a, b, centre);
    // Each face's reference point is where its halfedge ends.
    mesh.set_halfedge(Face(i), mesh.halfedge(b, centre));
  }
  return mesh;
}

}  // namespace

TEST_CASE("project_onto_surface: the closest point is the closest of all faces") {
  check_closest(icosphere(3, 1), 200);
  check_closest(jittered(12, 12, 0.2, 5), 200);
}

TEST_CASE("project_onto_surface: 60,000 faces that meet at one place do not exhaust the stack") {
  check_closest(rosette(60000), 3);
}
