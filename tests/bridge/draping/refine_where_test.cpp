// SPDX-License-Identifier: GPL-3.0-or-later
#include "bridge/draping/refine_where.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "bridge/arrays/gather.h"
#include "geometry/mesh/edge_metric.h"
#include "geometry/mesh/property_names.h"
#include "geometry/mesh/sheet.h"
#include "geometry/rest/bending_springs.h"
#include "geometry/rest/masses.h"
#include "geometry/rest/rest_angles.h"
#include "geometry/rest/rest_metric.h"
#include "physics/cloth/pins.h"

using namespace furrow;
using physics::Vec3;

namespace {

/// Two triangles with edges of 0.1 m and 0.1 sqrt(2) m, the second one turned up by an angle.
geometry::Mesh bent_by(double angle) {
  geometry::Mesh mesh;
  const auto a = mesh.add_vertex({0, 0, 0}), b = mesh.add_vertex({0.1, 0, 0}),
             c = mesh.add_vertex({0, 0.1, 0}),
             d = mesh.add_vertex({0, -0.1 * std::cos(angle), 0.1 * std::sin(angle)});
  mesh.add_face(a, b, c);
  mesh.add_face(b, a, d);
  return mesh;
}

/// A level strip, 0.4 m by 0.12 m, that hangs down from the first 4 cm, which are held.
geometry::Mesh strip() { return geometry::equilateral_sheet(0.4, 0.12, 0.04); }

physics::Cloth held_strip(geometry::Mesh& mesh) {
  geometry::ensure_rest_lengths(mesh);
  geometry::ensure_bending_springs(mesh);
  geometry::ensure_rest_angles(mesh);
  geometry::lump_masses(mesh, 0.15);
  bridge::GatherOptions options;
  options.membrane = bridge::Membrane::triangles;
  options.bending = bridge::Bending::hinge;
  options.rigidity = 1e-5;
  options.mean_structural_length = options.mean_bending_length = 0.04;
  physics::Cloth cloth = bridge::gather(mesh, options);
  for (std::size_t i = 0; i < cloth.particles.size(); ++i)
    if (cloth.particles.x[i].x() < 0.041) physics::pin(cloth.particles, std::vector<int>{int(i)});
  return cloth;
}

struct Hung {
  geometry::Mesh mesh;
  std::vector<Vec3> x;
  bridge::DrapeReport report;
};
Hung hung(const bridge::DrapeOptions& given) {
  bridge::DrapeOptions options = given;
  options.refinements = 3;
  options.disturbance = 0;
  options.settle.gravity = {0, 0, -9.81};
  Hung result{strip(), {}, {}};
  physics::Cloth cloth;
  result.report = bridge::drape(result.mesh, cloth, nullptr, options, held_strip);
  CHECK(result.report.levels.back().settle.converged);
  result.x = cloth.particles.x;
  return result;
}

bridge::DrapeOptions locally(const bridge::RefineWhere& where) {
  bridge::DrapeOptions options;
  options.where = where;
  return options;
}

}  // namespace

TEST_CASE("refine_where: a bent edge asks as its angle does, a pressed face as high as its folds would be") {
  const bridge::RefineWhere where{.bend = 0.2, .seen = 1e-3};
  for (const double angle : {-0.5, 0.1, 1.2}) {
    geometry::Mesh mesh = bent_by(angle);
    geometry::ensure_rest_lengths(mesh);
    for (const double want : bridge::want_of_refinement(mesh, where))
      CHECK(want == Approx(std::abs(angle) / 0.2).epsilon(1e-9));
  }
  geometry::Mesh pressed = bent_by(0);
  geometry::ensure_rest_lengths(pressed);
  for (const geometry::Vertex v : pressed.vertices()) {
    const geometry::Point p = pressed.point(v);
    pressed.point(v) = {0.98 * p.x(), 1.01 * p.y(), p.z()};
  }
  const double size = std::sqrt(4 / std::numbers::sqrt3 * 0.005),
               height = 2 * size / std::numbers::pi * std::sqrt(0.02);
  for (const double want : bridge::want_of_refinement(pressed, where))
    CHECK(want == Approx(height / 1e-3).epsilon(1e-9));
}

TEST_CASE("drape: refined where it bends, a strip hangs as one that is refined everywhere") {
  const Hung everywhere = hung({}), local = hung(locally({}));
  CHECK(local.report.local());
  CHECK_FALSE(local.report.ran_out);
  CHECK(local.report.uniform_vertices == everywhere.mesh.number_of_vertices());
  CHECK(3 * local.mesh.number_of_vertices() < everywhere.mesh.number_of_vertices());
  const std::size_t given = strip().number_of_vertices();
  REQUIRE(local.mesh.number_of_vertices() > given);
  double lowest = 0;
  for (std::size_t i = 0; i < given; ++i) {
    INFO("vertex " << i);
    CHECK((local.x[i] - everywhere.x[i]).norm() < 1e-3);
    lowest = std::min(lowest, local.x[i].z());
  }
  CHECK(lowest < -0.1);  // so that it did bend
  CHECK(local.report.levels.size() == 4);
  for (std::size_t level = 1; level < local.report.levels.size(); ++level)
    CHECK(local.report.levels[level].vertices > local.report.levels[level - 1].vertices);
}

TEST_CASE("drape: refined where it bends, it has the same bits for any number of threads") {
  bridge::DrapeOptions one = locally({}), two = one;
  one.settle.threads = 1;
  two.settle.threads = 2;
  CHECK(hung(one).x == hung(two).x);
}

TEST_CASE("drape: vertices, and the length of edges, bound where a garment is refined") {
  const Hung few = hung(locally({.most_vertices = 90}));
  CHECK(few.report.ran_out);
  CHECK(few.mesh.number_of_vertices() < 120);
  const Hung coarse = hung(locally({.finest = 0.015}));
  // Edges of 2 cm are shorter than 1.5 times 1.5 cm; the parts of a face that was cut for the time being are
  // at least half as high.
  const std::vector<double> rest = geometry::rest_lengths(coarse.mesh);
  for (const geometry::Face f : coarse.mesh.faces()) {
    const auto [a, b, c] = geometry::edge_lengths(coarse.mesh, f, rest);
    CHECK((a + b + c) / 3 > 0.5 * 0.0225);
  }
  CHECK(coarse.mesh.number_of_vertices() > strip().number_of_vertices());
  CHECK_FALSE(coarse.report.ran_out);
  CHECK(hung(locally({.finest = 1e-6})).report.ran_out);  // three cuts do not make edges so short
  CHECK_THROWS_AS(hung(locally({.finest = -1})), std::invalid_argument);
  CHECK_THROWS_AS(hung(locally({.bend = 0})), std::invalid_argument);
  CHECK_THROWS_AS(hung(locally({.seen = 0})), std::invalid_argument);
}
