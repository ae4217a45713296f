// SPDX-License-Identifier: GPL-3.0-or-later
#include "bridge/arrays/gather_riders.h"

#include <catch2/catch.hpp>
#include <numeric>

#include "bridge/arrays/convert.h"
#include "bridge/arrays/couple_bending.h"
#include "bridge/arrays/gather.h"
#include "geometry/figure/attached_parts.h"
#include "geometry/mesh/sheet.h"
#include "geometry/rest/masses.h"
#include "geometry/rest/rest_angles.h"
#include "geometry/rest/rest_metric.h"
#include "physics/cloth/riders.h"
#include "physics/motion/simulate.h"

using namespace furrow;
using geometry::Ride;

namespace {

void add_patch(geometry::Mesh& mesh, double side, const geometry::Vector& moved_by) {
  const geometry::Mesh patch = geometry::equilateral_sheet(side, side, side / 4);
  const std::size_t first = mesh.number_of_vertices();
  for (const geometry::Vertex v : patch.vertices()) mesh.add_vertex(patch.point(v) + moved_by);
  const auto moved = [&](geometry::Vertex v) {
    return geometry::Vertex(geometry::Vertex::size_type(first + v.idx()));
  };
  for (const geometry::Face f : patch.faces()) {
    const geometry::Halfedge h = patch.halfedge(f);
    mesh.add_face(moved(patch.source(h)), moved(patch.target(h)), moved(patch.target(patch.next(h))));
  }
}

/// A sheet, and a patch that lies 3 mm over it.
geometry::Mesh sheet_with_patch() {
  geometry::Mesh mesh = geometry::equilateral_sheet(0.3, 0.3, 0.03);
  add_patch(mesh, 0.08, {0.11, 0.1, 0.003});
  geometry::ensure_rest_lengths(mesh);
  geometry::ensure_rest_angles(mesh);
  geometry::lump_masses(mesh, 0.2);
  return mesh;
}

void attach(geometry::Mesh& mesh) {
  const geometry::Parts parts = geometry::find_parts(mesh);
  geometry::set_rides(mesh, parts, geometry::find_attached(mesh, parts));
}

bridge::GatherOptions plate() {
  bridge::GatherOptions options;
  options.mean_structural_length = 0.03;
  options.membrane = bridge::Membrane::triangles;
  options.bending = bridge::Bending::plate;
  options.stretch = 300;
  return options;
}

double sum(const std::vector<double>& all) { return std::accumulate(all.begin(), all.end(), 0.0); }

}  // namespace

TEST_CASE("gather: what rides is no cloth, and its mass is with the cloth below it") {
  geometry::Mesh mesh = sheet_with_patch();
  const physics::Cloth apart = bridge::gather(mesh, plate());
  attach(mesh);
  physics::Cloth cloth = bridge::gather(mesh, plate());
  const std::size_t patch = geometry::equilateral_sheet(0.08, 0.08, 0.02).number_of_vertices();
  REQUIRE(cloth.riders.size() == patch);
  CHECK(cloth.particles.size() == apart.particles.size());
  CHECK(cloth.triangles.size() == geometry::equilateral_sheet(0.3, 0.3, 0.03).number_of_faces());
  CHECK(cloth.membrane.size() == cloth.triangles.size());
  CHECK(cloth.hinges.size() < apart.hinges.size());
  CHECK(sum(cloth.particles.mass) == Approx(sum(apart.particles.mass)));
  for (const physics::Rider& r : cloth.riders) {
    CHECK(cloth.particles.inv_mass[r.particle] == 0);
    CHECK((cloth.particles.x[r.particle] - apart.particles.x[r.particle]).norm() < 1e-14);
    for (const int corner : r.triangle)
      CHECK(cloth.particles.mass[corner] > apart.particles.mass[corner] - 1e-15);
  }
  CHECK(bridge::couple_bending(mesh, plate(), cloth).coupled > 0);
}

TEST_CASE("gather: a button rides on the sheet, not on a nearer button that goes by itself") {
  geometry::Mesh mesh = geometry::equilateral_sheet(0.3, 0.3, 0.03);
  add_patch(mesh, 0.02, {0.1, 0.1, 0.05});
  add_patch(mesh, 0.02, {0.13, 0.1, 0.05});
  const geometry::Parts parts = geometry::find_parts(mesh);
  REQUIRE(parts.list.size() == 3);
  geometry::set_rides(mesh, parts, {{1, Ride::by_itself, 0}, {2, Ride::rigid, 0}});
  const std::vector<physics::Rider> riders = bridge::riders_of(mesh);
  CHECK(riders.size() == parts.list[2].vertices);
  for (const physics::Rider& r : riders)
    for (const int corner : r.triangle) CHECK(parts.of_vertex[std::size_t(corner)] == 0);
}

TEST_CASE("gather: a patch that rides is where it was on the sheet after a second of fall and wind") {
  geometry::Mesh mesh = sheet_with_patch();
  attach(mesh);
  physics::Cloth cloth = bridge::gather(mesh, plate());
  for (const geometry::Vertex v : mesh.vertices())
    if (mesh.point(v).y() > 0.25) cloth.particles.inv_mass[v.idx()] = 0;
  const std::vector<physics::Rider> riders = cloth.riders;
  physics::World world;
  world.wind.velocity = {0, 0, 4};
  physics::SimulateOptions options;
  options.seconds = 0.5;
  options.integrator = GENERATE(physics::Integrator::implicit, physics::Integrator::leapfrog);
  options.air_drag = 4;
  REQUIRE(physics::simulate(cloth, world, options).outcome == physics::Outcome::finished);
  const auto& x = cloth.particles.x;
  double moved = 0;
  for (const physics::Rider& r : riders) {
    const auto [a, b, c] = r.triangle;
    const physics::Rider now =
        physics::rider_at(x[r.particle], r.particle, r.triangle, {x[a], x[b], x[c]}, r.weights);
    CHECK((now.offset - r.offset).norm() < 1e-12);
    const geometry::Vertex v(geometry::Vertex::size_type(r.particle));
    moved = std::max(moved, (x[r.particle] - bridge::to_eigen(mesh.point(v))).norm());
  }
  CHECK(moved > 0.01);
}
