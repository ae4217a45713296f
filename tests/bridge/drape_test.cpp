// SPDX-License-Identifier: GPL-3.0-or-later
#include "bridge/drape.h"

#include <catch2/catch.hpp>

#include "bridge/gather.h"
#include "geometry/mesh/property_names.h"
#include "geometry/mesh/sheet.h"
#include "geometry/rest/bending_springs.h"
#include "geometry/rest/masses.h"
#include "geometry/rest/rest_angles.h"
#include "geometry/rest/rest_metric.h"
#include "physics/cloth/pins.h"
#include "physics/contact/residual_force.h"
#include "tests/physics/body/test_bodies.h"

using namespace furrow;
using physics::Vec3;
using tests::Sphere;

namespace {

/// A square of cloth that lies across a ball, its middle in the ball.
geometry::Mesh across() {
  geometry::Mesh mesh = geometry::equilateral_sheet(0.3, 0.3, 0.04);
  for (const geometry::Vertex v : mesh.vertices()) {
    const geometry::Point p = mesh.point(v);
    mesh.point(v) = geometry::Point(p.x(), 0.098, p.y() - 0.15);
  }
  return mesh;
}

physics::Cloth make(geometry::Mesh& mesh) {
  geometry::ensure_rest_lengths(mesh);
  geometry::ensure_bending_springs(mesh);
  geometry::ensure_rest_angles(mesh);
  geometry::lump_masses(mesh, 0.15);
  bridge::GatherOptions options;
  options.membrane = bridge::Membrane::triangles;
  options.bending = bridge::Bending::hinge;
  options.rigidity = 1e-4;
  options.mean_structural_length = options.mean_bending_length = 0.04;
  return bridge::gather(mesh, options);
}

}  // namespace

TEST_CASE("drape: coarse to fine to rest on a ball, out of which it is brought first") {
  const Sphere ball(Vec3::Zero(), 0.1);
  geometry::Mesh mesh = across();
  const std::size_t coarse = mesh.number_of_vertices();
  physics::Cloth cloth;
  bridge::DrapeOptions options;
  options.refinements = 2;
  const bridge::DrapeReport report = bridge::drape(mesh, cloth, &ball, options, make);
  REQUIRE(report.levels.size() == 3);
  CHECK(report.levels[0].vertices == coarse);
  CHECK(report.levels[0].pushed.moved > 0);
  CHECK(report.levels[0].pushed.still_inside == 0);
  CHECK(report.levels[2].vertices == mesh.number_of_vertices());
  CHECK(mesh.number_of_vertices() > 12 * coarse);
  CHECK(report.levels[2].settle.converged);
  CHECK(report.levels[2].settle.iterations < 100);  // a shape that is carried wrongly does not get there
  const physics::SettleOptions& s = options.settle;
  CHECK(physics::residual_force(cloth, s.gravity, &ball, s.friction, s.gap) <= 1e-3);
  const auto rest = *geometry::find_map(mesh, geometry::attribute::rest_length);
  double strain = 0;
  for (const geometry::Edge e : mesh.edges())
    strain = std::max(strain, std::abs(std::sqrt(CGAL::squared_distance(mesh.point(mesh.vertex(e, 0)),
                                                                        mesh.point(mesh.vertex(e, 1)))) /
                                           rest[e] -
                                       1));
  CHECK(strain < 0.02);
  double lowest = 1;
  for (const geometry::Vertex v : mesh.vertices()) {
    const auto& p = mesh.point(v);
    const Vec3 x(p.x(), p.y(), p.z());
    CHECK((x - cloth.particles.x[std::size_t(v)]).norm() == 0);
    CHECK(x.norm() > 0.1);
    lowest = std::min(lowest, x.y());
  }
  CHECK(lowest < 0.06);  // it hangs down at the sides
}

TEST_CASE("drape: what falls past the body is not refined, what falls on it is") {
  const Sphere ball(Vec3::Zero(), 0.1);
  bridge::DrapeOptions options;
  options.refinements = 2;
  geometry::Mesh mesh = across();
  const std::size_t coarse = mesh.number_of_vertices();
  for (geometry::Point& p : mesh.points()) p = geometry::Point(p.x() + 1, p.y(), p.z());
  physics::Cloth cloth;
  const bridge::DrapeReport beside = bridge::drape(mesh, cloth, &ball, options, make);
  CHECK(beside.falls);
  CHECK_FALSE(beside.stopped);
  CHECK(beside.levels.size() == 1);
  CHECK(mesh.number_of_vertices() == coarse);
  CHECK(cloth.particles.size() == coarse);
  CHECK(mesh.point(*mesh.vertices().begin()).y() < 0);
  options.refinements = 1;
  geometry::Mesh other = across();
  for (geometry::Point& p : other.points()) p = geometry::Point(p.x(), p.y() + 0.05, p.z());
  const bridge::DrapeReport above = bridge::drape(other, cloth, &ball, options, make);
  CHECK_FALSE(above.falls);
  CHECK(above.levels.size() == 2);
  CHECK(above.levels[1].settle.converged);
}

TEST_CASE("drape: the plain scheme comes to a like rest, an observer stops it, bad options change nothing") {
  const Sphere ball(Vec3::Zero(), 0.1);
  geometry::Mesh mesh = across();
  physics::Cloth cloth;
  bridge::DrapeOptions options;
  options.plain = true;
  options.settle.max_iterations = 50;
  const bridge::DrapeReport plain = bridge::drape(mesh, cloth, &ball, options, make);
  CHECK(plain.levels[0].settle.iterations == 50);
  CHECK(plain.levels[0].settle.factorisations == 0);
  options.plain = false;
  options.refinements = 1;
  geometry::Mesh other = across();
  int calls = 0;
  const auto stop = [&](int level, const physics::SettleProgress&, const physics::Cloth&) {
    CHECK(level == 0);
    return ++calls < 2;
  };
  const bridge::DrapeReport stopped = bridge::drape(other, cloth, &ball, options, make, stop);
  CHECK(stopped.stopped);
  CHECK(stopped.levels.size() == 2);
  CHECK(cloth.particles.size() == other.number_of_vertices());
  options.refinements = -1;
  geometry::Mesh untouched = across();
  CHECK_THROWS_WITH(bridge::drape(untouched, cloth, &ball, options, make),
                    Catch::Contains("refinements = -1"));
  CHECK(untouched.number_of_vertices() == across().number_of_vertices());
}

TEST_CASE("drape: friction of bending bears what it can, and cloth hangs less for it", "[release]") {
  const Sphere ball(Vec3::Zero(), 0.1);
  const auto lowest = [&](double friction, double* slip) {
    geometry::Mesh mesh = across();
    physics::Cloth cloth;
    bridge::DrapeOptions options;
    options.refinements = 1;
    options.disturbance = 0;
    options.bending_friction = friction;
    const bridge::DrapeReport report = bridge::drape(mesh, cloth, &ball, options, make);
    CHECK(report.levels[1].settle.converged);
    CHECK((report.friction_rounds > 0) == (friction > 0));
    *slip = report.slip;
    double mean = 0;
    for (const Vec3& x : cloth.particles.x) mean += x.y() / double(cloth.particles.size());
    return mean;
  };
  double slip = 0;
  const double without = lowest(0, &slip);
  CHECK(slip == 0);
  const double little = lowest(1e-4, &slip);
  CHECK(slip <= 2e-3);
  const double much = lowest(1e-3, &slip);
  CHECK(little > without);
  CHECK(much > little + 0.001);
  geometry::Mesh mesh = across();
  physics::Cloth cloth;
  bridge::DrapeOptions options;
  options.bending_friction = -1;
  CHECK_THROWS_WITH(bridge::drape(mesh, cloth, &ball, options, make),
                    Catch::Contains("bending_friction = -1"));
  options.bending_friction = 1e-4;
  options.plain = true;
  CHECK_THROWS_WITH(bridge::drape(mesh, cloth, &ball, options, make), Catch::Contains("plain"));
}

TEST_CASE("drape: with a soft start cloth comes to the same rest where there is one alone") {
  geometry::Mesh sheet = geometry::equilateral_sheet(0.3, 0.3, 0.04), other = sheet;
  for (geometry::Mesh* mesh : {&sheet, &other})
    for (const geometry::Vertex v : mesh->vertices()) {
      const geometry::Point p = mesh->point(v);
      mesh->point(v) = geometry::Point(p.x(), 0.1, p.y());  // it swings down from its edge
    }
  const auto pinned = [](geometry::Mesh& mesh) {
    physics::Cloth cloth = make(mesh);
    for (const geometry::Vertex v : mesh.vertices())
      if (mesh.point(v).z() < 1e-9) physics::pin(cloth.particles, std::vector<int>{int(v)});
    return cloth;
  };
  bridge::DrapeOptions options;
  options.disturbance = 0;
  options.settle.tolerance = 1e-8;
  options.coarse_tolerance = 0.01;  // the sheet starts at 1
  physics::Cloth stiff, soft;
  const bridge::DrapeReport plain = bridge::drape(sheet, stiff, nullptr, options, pinned);
  options.soft_start = 30;
  const bridge::DrapeReport start = bridge::drape(other, soft, nullptr, options, pinned);
  CHECK(plain.levels[0].settle.converged);
  CHECK(plain.levels[0].soft.iterations == 0);
  CHECK(start.levels[0].settle.converged);
  CHECK(start.levels[0].soft.iterations > 0);
  CHECK(start.levels[0].settle.residual <= 1e-8);
  REQUIRE(soft.membrane.size() == stiff.membrane.size());
  for (std::size_t i = 0; i < soft.membrane.size(); ++i) CHECK(soft.membrane[i].mu == stiff.membrane[i].mu);
  for (std::size_t i = 0; i < soft.particles.size(); ++i)
    CHECK((soft.particles.x[i] - stiff.particles.x[i]).norm() < 1e-6);
  options.soft_start = 0.5;
  CHECK_THROWS_WITH(bridge::drape(other, soft, nullptr, options, pinned), Catch::Contains("soft_start"));
}
