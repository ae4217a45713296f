// SPDX-License-Identifier: GPL-3.0-or-later
#include "bridge/draping/drape.h"

#include <algorithm>
#include <catch2/catch.hpp>

#include "bridge/arrays/gather.h"
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

/// The same mesh from another exporter: other numbers of vertices, faces in another order that begin at other
/// corners.
geometry::Mesh renumbered(const geometry::Mesh& mesh, const Vec3& away = Vec3::Zero()) {
  const std::size_t n = mesh.number_of_vertices(), m = mesh.number_of_faces();
  std::vector<geometry::Vertex> now(n);
  geometry::Mesh other;
  for (std::size_t i = 0; i < n; ++i) {
    const geometry::Vertex old(geometry::Vertex::size_type((7 * i + 3) % n));
    const geometry::Point p = mesh.point(old);
    now[std::size_t(old)] = other.add_vertex({p.x() + away.x(), p.y() + away.y(), p.z() + away.z()});
  }
  for (std::size_t i = 0; i < m; ++i) {
    const geometry::Face f(geometry::Face::size_type((11 * i + 5) % m));
    std::vector<geometry::Vertex> corners;
    for (const geometry::Vertex v : mesh.vertices_around_face(mesh.halfedge(f)))
      corners.push_back(now[std::size_t(v)]);
    std::rotate(corners.begin(), corners.begin() + std::ptrdiff_t(i % 3), corners.end());
    REQUIRE(other.add_face(corners) != geometry::Mesh::null_face());
  }
  return other;
}

/// Where a garment starts, and where its own vertices rest.
struct Draped {
  std::vector<Vec3> start, rest;
};
Draped draped_with(geometry::Mesh mesh, const Sphere* ball, const bridge::MakeCloth& make_cloth,
                   std::uint64_t seed = 0) {
  bridge::DrapeOptions options;
  options.refinements = 1;
  options.settle.tolerance = 1e-6;
  options.seed = seed;
  Draped result;
  const auto observe = [&](int level, const physics::SettleProgress& p, const physics::Cloth& cloth) {
    if (level == 0 && p.iteration == 0) result.start = cloth.particles.x;
    return true;
  };
  physics::Cloth cloth;
  CHECK(bridge::drape(mesh, cloth, ball, options, make_cloth, observe).levels[1].settle.converged);
  result.rest.assign(cloth.particles.x.begin(),
                     cloth.particles.x.begin() + std::ptrdiff_t(result.start.size()));
  return result;
}

/// Held at the border's vertices beside two corners.
bridge::MakeCloth hung_at(const Vec3& away) {
  return [away](geometry::Mesh& mesh) {
    physics::Cloth cloth = make(mesh);
    for (std::size_t i = 0; i < cloth.particles.size(); ++i) {
      const Vec3 x = cloth.particles.x[i] - away;
      if (std::abs(x.z() + 0.15) < 1e-6 && std::abs(std::abs(x.x() - 0.16) - 0.16) < 0.03)
        physics::pin(cloth.particles, std::vector<int>{int(i)});
    }
    return cloth;
  };
}

/// The farthest that a vertex of the renumbered mesh lies from its own.
double farthest(const std::vector<Vec3>& a, const std::vector<Vec3>& renumbered, const Vec3& away) {
  double most = 0;
  for (std::size_t i = 0; i < a.size(); ++i)
    most = std::max(most, (renumbered[i] - away - a[(7 * i + 3) % a.size()]).norm());
  return most;
}

}  // namespace

TEST_CASE("drape: numbers of vertices and places do not change a start, nor where held cloth rests",
          "[long]") {
  const geometry::Mesh mesh = across();
  REQUIRE(mesh.number_of_vertices() % 7 != 0);
  REQUIRE(mesh.number_of_faces() % 11 != 0);
  const Sphere ball(Vec3::Zero(), 0.1);
  const Draped given = draped_with(mesh, &ball, make),
               hung = draped_with(mesh, nullptr, hung_at(Vec3::Zero()));
  for (const Vec3& away : {Vec3(0, 0, 0), Vec3(0.5, -2, 1.25)}) {
    const geometry::Mesh other = renumbered(mesh, away);
    const Sphere there(away, 0.1);
    CHECK(farthest(given.start, draped_with(other, &there, make).start, away) < 1e-12);
    const Draped hung_there = draped_with(other, nullptr, hung_at(away));
    CHECK(farthest(hung.start, hung_there.start, away) < 1e-12);
    CHECK(farthest(hung.rest, hung_there.rest, away) < 1e-6);
  }
  const Draped seeded = draped_with(mesh, &ball, make, 1);
  double most = 0;
  for (std::size_t i = 0; i < given.rest.size(); ++i)
    most = std::max(most, (seeded.rest[i] - given.rest[i]).norm());
  CHECK(most > 1e-4);  // cloth on a ball has many rests
}

TEST_CASE("drape: coarse to fine to rest on a ball, out of which it is brought first", "[long]") {
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

TEST_CASE("drape: what falls past the body is not refined, what falls on it is", "[long]") {
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
  REQUIRE(above.levels.size() == 2);
  CHECK(above.levels[0].settle.touching > 0);  // the finer level goes on from what lies on the body
  CHECK(above.levels[0].settle.residual <= 1e-3);
  CHECK(above.levels[1].settle.converged);
}

TEST_CASE("drape: what falls past the body beside parts that were laid aside is not refined", "[long]") {
  const Sphere ball(Vec3::Zero(), 0.1);
  geometry::Mesh mesh = across();
  for (geometry::Point& p : mesh.points()) p = geometry::Point(p.x() + 1, p.y(), p.z());
  const auto button =
      mesh.add_face(mesh.add_vertex({2, 1, 0}), mesh.add_vertex({2.02, 1, 0}), mesh.add_vertex({2, 1, 0.02}));
  REQUIRE(button != geometry::Mesh::null_face());
  const std::size_t coarse = mesh.number_of_vertices();
  const auto make_with_button = [](geometry::Mesh& made) {
    physics::Cloth cloth = make(made);
    for (std::size_t i = 0; i < cloth.particles.size(); ++i)
      if (cloth.particles.x[i].x() > 1.9) physics::pin(cloth.particles, std::vector<int>{int(i)});
    return cloth;
  };
  bridge::DrapeOptions options;
  options.refinements = 2;
  options.held_aside = true;
  physics::Cloth cloth;
  const bridge::DrapeReport aside = bridge::drape(mesh, cloth, &ball, options, make_with_button);
  CHECK(aside.falls);
  CHECK(aside.levels.size() == 1);
  CHECK(mesh.number_of_vertices() == coarse);
  geometry::Mesh worn = across();  // the rest comes to lie on the body: it is refined as ever
  worn.add_face(worn.add_vertex({2, 1, 0}), worn.add_vertex({2.02, 1, 0}), worn.add_vertex({2, 1, 0.02}));
  options.refinements = 1;
  const bridge::DrapeReport on_ball = bridge::drape(worn, cloth, &ball, options, make_with_button);
  CHECK_FALSE(on_ball.falls);
  CHECK(on_ball.levels.size() == 2);
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

TEST_CASE("drape: what drapes share changes no bit, and a pattern of other pins is not taken", "[long]") {
  const Sphere ball(Vec3::Zero(), 0.1);
  bridge::DrapeWork work;
  const auto run = [&](std::uint64_t seed, bridge::DrapeWork* shared, bool held) {
    bridge::DrapeOptions options;
    options.refinements = 1;
    options.seed = seed;
    options.work = shared;
    const bridge::MakeCloth make_cloth = [&](geometry::Mesh& mesh) {
      physics::Cloth cloth = make(mesh);
      if (held) physics::pin(cloth.particles, std::vector<int>{0});
      return cloth;
    };
    geometry::Mesh mesh = across();
    physics::Cloth cloth;
    const bridge::DrapeReport report = bridge::drape(mesh, cloth, &ball, options, make_cloth);
    CHECK(report.energy.weight < 0);
    CHECK(report.energy.stretch > 0);
    CHECK(report.energy.bending > 0);
    CHECK(report.energy.contact > 0);
    return cloth.particles.x;
  };
  run(0, &work, false);
  REQUIRE(work.levels.size() == 2);
  const auto kept = work.levels[1].stiffness;
  REQUIRE(kept);
  CHECK(run(1, &work, false) == run(1, nullptr, false));
  CHECK(work.levels[1].stiffness == kept);
  CHECK(run(1, &work, true) == run(1, nullptr, true));
  CHECK(work.levels[1].stiffness != kept);
}
