// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/rest_angles.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "geometry/property_names.h"
#include "geometry/wrinkle.h"
#include "tests/test_meshes.h"

using namespace furrow::geometry;
using namespace furrow::tests;

namespace {

/// A strip bent to a roof of angle theta about the line x = 0.
Mesh roof(double theta) {
  const double c = std::cos(theta / 2), s = std::sin(theta / 2);
  Mesh mesh;
  const Vertex a = mesh.add_vertex(Point(0, 0, 0)), b = mesh.add_vertex(Point(0, 1, 0));
  const Vertex left = mesh.add_vertex(Point(-c, 0.4, -s)), right = mesh.add_vertex(Point(c, 0.7, -s));
  mesh.add_face(a, b, left);
  mesh.add_face(b, a, right);
  return mesh;
}
Edge ridge(const Mesh& mesh) { return mesh.edge(mesh.halfedge(Vertex(0), Vertex(1))); }

}  // namespace

TEST_CASE("the angle of a roof: positive for a ridge, negative for a valley, 0 flat and on the border") {
  for (double theta : {0.0, 0.1, 1.5, 3.0, -0.1, -3.0})
    CHECK(dihedral_angle(roof(theta), ridge(roof(theta))) == Approx(theta).margin(1e-14));
  const Mesh mesh = roof(1);
  for (Edge e : mesh.edges())
    if (mesh.is_border(e)) CHECK(dihedral_angle(mesh, e) == 0);
}

TEST_CASE("rest angles are measured where they are unset, and only there") {
  Mesh mesh = roof(0.7);
  ensure_rest_angles(mesh);
  const auto rest = *find_map(mesh, kRestAngle);
  CHECK(rest[ridge(mesh)] == Approx(0.7));
  mesh.point(Vertex(2)) = Point(-1, 0.4, 0);
  ensure_rest_angles(mesh);
  CHECK(rest[ridge(mesh)] == Approx(0.7));
}

TEST_CASE("lines of height 0 leave rest angles, drawn lines bring their own") {
  Mesh mesh = grid(12, 12);
  for (Vertex v : mesh.vertices()) {  // a cylinder
    const Point p = mesh.point(v);
    mesh.point(v) = Point(std::sin(p.x()), p.y(), std::cos(p.x()));
  }
  const Mesh before = mesh;
  Stroke stroke;
  stroke.points = {before.point(Vertex(30)), before.point(Vertex(130))};
  stroke.height = 0;
  WrinkleOptions options;
  options.insertion.max_distance = 0.2;
  wrinkle(mesh, std::span(&stroke, 1), options);
  auto rest = *find_map(mesh, kRestAngle);
  for (Edge e : mesh.edges())
    if (!mesh.is_border(e)) CHECK(rest[e] == Approx(dihedral_angle(mesh, e)).margin(1e-12));

  Mesh drawn = before, flat = before;
  stroke.height = 0.05;
  wrinkle(drawn, std::span(&stroke, 1), options);
  options.rest = RestRule::flat;
  wrinkle(flat, std::span(&stroke, 1), options);
  double largest = 0;
  for (Edge e : drawn.edges()) {
    if (drawn.is_border(e)) continue;
    const double angle = dihedral_angle(drawn, e);
    CHECK((*find_map(drawn, kRestAngle))[e] == Approx(angle).margin(1e-12));
    largest = std::max(largest, std::abs(angle - (*find_map(flat, kRestAngle))[e]));
  }
  CHECK(largest > 0.2);
}
