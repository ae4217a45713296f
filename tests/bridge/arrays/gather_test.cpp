// SPDX-License-Identifier: GPL-3.0-or-later
#include "bridge/arrays/gather.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "geometry/mesh/errors.h"
#include "geometry/mesh/property_names.h"
#include "geometry/rest/bending_springs.h"
#include "geometry/rest/masses.h"
#include "geometry/rest/rest_angles.h"
#include "geometry/rest/rest_metric.h"
#include "physics/cloth/elements.h"

using namespace furrow;
using geometry::Mesh;
using geometry::Point;
using geometry::Vertex;

namespace {

/// Two triangles of a unit square, and a vertex that no face uses.
Mesh square() {
  Mesh mesh;
  const Vertex a = mesh.add_vertex(Point(0, 0, 0)), b = mesh.add_vertex(Point(1, 0, 0));
  const Vertex c = mesh.add_vertex(Point(1, 1, 0)), d = mesh.add_vertex(Point(0, 1, 0));
  mesh.add_vertex(Point(9, 9, 9));
  mesh.add_face(a, b, c);
  mesh.add_face(a, c, d);
  geometry::ensure_rest_lengths(mesh);
  geometry::rebuild_bending_springs(mesh);
  geometry::lump_masses(mesh, 0.6);
  return mesh;
}
const bridge::GatherOptions default_options{1000, 10, 0.5, 2};

}  // namespace

TEST_CASE("gather: it turns maps into masses and springs by the law of S1.7") {
  const physics::Cloth cloth = bridge::gather(square(), default_options);
  REQUIRE(cloth.particles.size() == 5);
  CHECK(cloth.particles.mass[0] == Approx(0.2));
  CHECK(cloth.particles.mass[1] == Approx(0.1));
  CHECK(cloth.particles.mass[4] == 0);
  CHECK(cloth.particles.inv_mass[4] == 0);
  REQUIRE(cloth.structural.size() == 5);
  for (std::size_t i = 1; i < 5; ++i) {
    const auto &s = cloth.structural[i - 1], &t = cloth.structural[i];
    CHECK((s.a < t.a || (s.a == t.a && s.b < t.b)));
  }
  for (const physics::Spring& s : cloth.structural) CHECK(s.stiffness == Approx(s.rest_length / 0.5 * 1000));
  REQUIRE(cloth.bending.size() == 1);
  CHECK(cloth.bending[0].a == 1);
  CHECK(cloth.bending[0].b == 3);
  CHECK(cloth.bending[0].rest_length == Approx(std::sqrt(2)));
  CHECK(cloth.bending[0].stiffness == Approx(std::sqrt(2) / 2 * 10));
  CHECK(cloth.triangles.size() == 2);
}

TEST_CASE("gather: it refuses a mesh that lacks what it needs") {
  Mesh bare;
  bare.add_vertex(Point(0, 0, 0));
  CHECK_THROWS_AS(bridge::gather(bare, default_options), std::invalid_argument);
  Mesh unset = square();
  (*geometry::find_map(unset, geometry::attribute::rest_length))[*unset.edges().begin()] = NAN;
  CHECK_THROWS_AS(bridge::gather(unset, default_options), geometry::ContentError);
  bridge::GatherOptions bad = default_options;
  bad.mean_structural_length = 0;
  CHECK_THROWS_AS(bridge::gather(square(), bad), std::invalid_argument);
}

TEST_CASE("gather: scatter writes back what gather read, and refuses another mesh") {
  Mesh mesh = square();
  physics::Cloth cloth = bridge::gather(mesh, default_options);
  for (physics::Vec3& x : cloth.particles.x) x *= 2;
  bridge::scatter(cloth.particles, mesh);
  CHECK(mesh.point(Vertex(2)) == Point(2, 2, 0));
  cloth.particles.x.pop_back();
  CHECK_THROWS_AS(bridge::scatter(cloth.particles, mesh), std::invalid_argument);
}

TEST_CASE("gather: it fills only what the options choose") {
  Mesh mesh = square();
  for (Vertex v : mesh.vertices())  // a ridge along the diagonal: its ends are 0 and 2
    if (v == Vertex(1) || v == Vertex(3)) mesh.point(v) = Point(mesh.point(v).x(), mesh.point(v).y(), -0.2);
  geometry::ensure_rest_angles(mesh);
  bridge::GatherOptions o = default_options;
  o.membrane = bridge::Membrane::triangles;
  o.bending = bridge::Bending::hinge;
  o.stretch = 300;
  o.poisson = 0;
  o.rigidity = 2e-5;
  const physics::Cloth plate = bridge::gather(mesh, o);
  CHECK(plate.structural.empty());
  CHECK(plate.bending.empty());
  REQUIRE(plate.membrane.size() == 2);
  CHECK(plate.membrane[0].vertices == std::array{0, 1, 2});
  CHECK(plate.membrane[0].rest_lengths[1] == Approx(std::sqrt(2)));  // opposite vertex 1
  CHECK(plate.membrane[0].mu == Approx(150));
  REQUIRE(plate.hinges.size() == 1);
  CHECK(plate.hinges[0].vertices[0] == 0);
  CHECK(plate.hinges[0].vertices[1] == 2);
  CHECK(plate.hinges[0].rest_angle > 0.5);
  CHECK(plate.hinges[0].stiffness == Approx(2e-5 * 2 / 1));        // B l^2 / (A1 + A2) of the square at rest
  CHECK(physics::potential_energy(plate, plate.particles.x) > 0);  // lifted, its lengths are no rest lengths
}

TEST_CASE("gather: an edge of length r gets what the springs' law says") {
  bridge::GatherOptions o = default_options;
  const auto stiffness = [&](bridge::Membrane law, int a, int b) {
    o.membrane = law;
    for (const physics::Spring& s : bridge::gather(square(), o).structural)
      if (s.a == a && s.b == b) return s.stiffness;
    return -1.0;
  };
  o.stretch = 60;
  const double diagonal = std::sqrt(2);
  CHECK(stiffness(bridge::Membrane::paper, 0, 2) == Approx(1000 * diagonal / 0.5));
  CHECK(stiffness(bridge::Membrane::uniform, 0, 2) == Approx(1000));
  CHECK(stiffness(bridge::Membrane::inverse, 0, 2) == Approx(1000 * 0.5 / diagonal));
  CHECK(stiffness(bridge::Membrane::van_gelder, 0, 2) == Approx(60 * 1.0 / 2));
  CHECK(stiffness(bridge::Membrane::van_gelder, 0, 1) == Approx(60 * 0.5 / 1));
}

TEST_CASE("gather: it presses the hinges of lines by their ids, and leaves stiffnesses that are stored") {
  Mesh mesh = square();
  geometry::ensure_map(mesh, geometry::attribute::line)[Vertex(0)] = 1;
  bridge::GatherOptions options = default_options;
  options.bending = bridge::Bending::hinge;
  const double plain = bridge::gather(mesh, options).hinges[0].stiffness;
  options.line_presses = {5, 30};
  CHECK(bridge::gather(mesh, options).hinges[0].stiffness == Approx(30 * plain));
  options.line_presses = {5};
  CHECK(bridge::gather(mesh, options).hinges[0].stiffness == plain);
  options.line_presses = {1, 30};
  for (geometry::Edge e : mesh.edges())
    geometry::ensure_map(mesh, geometry::attribute::hinge_stiffness)[e] = 7;
  CHECK(bridge::gather(mesh, options).hinges[0].stiffness == 7);
}
