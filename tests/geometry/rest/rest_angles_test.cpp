// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/rest/rest_angles.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "geometry/fold/wrinkle.h"
#include "geometry/mesh/property_names.h"
#include "tests/cases/safe_rule.h"
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

TEST_CASE("rest_angles: a ridge is positive, a valley negative, flat and border are 0") {
  for (double theta : {0.0, 0.1, 1.5, 3.0, -0.1, -3.0})
    CHECK(dihedral_angle(roof(theta), ridge(roof(theta))) == Approx(theta).margin(1e-14));
  const Mesh mesh = roof(1);
  for (Edge e : mesh.edges())
    if (mesh.is_border(e)) CHECK(dihedral_angle(mesh, e) == 0);
}

TEST_CASE("rest_angles: rest angles are measured where they are unset, and only there") {
  Mesh mesh = roof(0.7);
  ensure_rest_angles(mesh);
  const auto rest = *find_map(mesh, attribute::rest_angle);
  CHECK(rest[ridge(mesh)] == Approx(0.7));
  mesh.point(Vertex(2)) = Point(-1, 0.4, 0);
  ensure_rest_angles(mesh);
  CHECK(rest[ridge(mesh)] == Approx(0.7));
}

TEST_CASE(
    "rest_angles: lines of height 0 leave rest angles, copied lines bring their own, drawn and flat ones do "
    "not") {
  Mesh mesh = grid(12, 12);
  for (Vertex v : mesh.vertices()) {  // a cylinder
    const Point p = mesh.point(v);
    mesh.point(v) = Point(std::sin(p.x()), p.y(), std::cos(p.x()));
  }
  const Mesh before = mesh;
  Stroke stroke;
  stroke.points = {before.point(Vertex(30)), before.point(Vertex(130))};
  stroke.height = 0;
  WrinkleOptions options = furrow::tests::safe_rule();
  options.insertion.max_distance = 0.2;
  wrinkle(mesh, std::span(&stroke, 1), options);
  auto rest = *find_map(mesh, attribute::rest_angle);
  for (Edge e : mesh.edges())
    if (!mesh.is_border(e)) CHECK(rest[e] == Approx(dihedral_angle(mesh, e)).margin(1e-12));

  stroke.height = 0.05;
  const auto with = [&](RestRule rule) {
    Mesh drawn = before;
    options.rest = rule;
    wrinkle(drawn, std::span(&stroke, 1), options);
    return drawn;
  };
  const Mesh copied = with(RestRule::copied), drawn = with(RestRule::drawn), flat = with(RestRule::flat);
  double largest = 0;
  for (Edge e : copied.edges()) {
    const auto of = [&](const Mesh& m, const auto& name) { return (*find_map(m, name))[e]; };
    CHECK(of(copied, attribute::rest_length) == of(drawn, attribute::rest_length));
    if (!std::isnan(of(copied, attribute::bending_rest_length)))
      CHECK(of(copied, attribute::bending_rest_length) == of(drawn, attribute::bending_rest_length));
    if (copied.is_border(e)) continue;
    const double angle = dihedral_angle(copied, e);
    CHECK(of(copied, attribute::rest_angle) == Approx(angle).margin(1e-12));
    CHECK(of(drawn, attribute::rest_angle) == of(flat, attribute::rest_angle));
    largest = std::max(largest, std::abs(angle - of(drawn, attribute::rest_angle)));
  }
  CHECK(largest > 0.2);
}
