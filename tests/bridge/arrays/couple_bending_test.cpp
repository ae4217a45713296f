// SPDX-License-Identifier: GPL-3.0-or-later
#include "bridge/arrays/couple_bending.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

#include "geometry/mesh/property_names.h"
#include "geometry/rest/masses.h"
#include "geometry/rest/rest_metric.h"
#include "physics/cloth/elements.h"
#include "physics/cloth/pins.h"
#include "physics/rest/settle.h"

using namespace furrow;
using bridge::Bending;
using bridge::GatherOptions;
using physics::Vec3;

namespace {

GatherOptions options(Bending bending) {
  GatherOptions o;
  o.mean_structural_length = o.mean_bending_length = 0.1;
  o.membrane = bridge::Membrane::triangles;
  o.bending = bending;
  return o;
}

geometry::Mesh cut_quads(int n) {
  geometry::Mesh mesh;
  std::vector<geometry::Vertex> v;
  for (int r = 0; r <= n; ++r)
    for (int c = 0; c <= n; ++c) v.push_back(mesh.add_vertex(geometry::Point(0.1 * c, 0.1 * r, 0)));
  for (int r = 0; r < n; ++r)
    for (int c = 0; c < n; ++c) {
      const int a = r * (n + 1) + c;
      mesh.add_face(v[a], v[a + 1], v[a + n + 2]);
      mesh.add_face(v[a], v[a + n + 2], v[a + n + 1]);
    }
  geometry::ensure_rest_lengths(mesh);
  geometry::lump_masses(mesh, 0.15);
  return mesh;
}

/// Raised to a parabola of radius 100 m about an axis at 45 degrees or at -45.
std::vector<Vec3> rolled(const physics::Cloth& cloth, double sign) {
  std::vector<Vec3> x;
  for (const Vec3& p : cloth.particles.x) {
    const double s = (p.x() + sign * p.y()) / std::sqrt(2.0);
    x.push_back(p + Vec3(0, 0, -0.005 * s * s));
  }
  return x;
}

double bending_energy(physics::Cloth cloth, const std::vector<Vec3>& x) {
  cloth.membrane.clear();
  return physics::potential_energy(cloth, x);
}

}  // namespace

TEST_CASE("couple_bending: a plate on cut quads bends alike in both diagonal directions, hinges do not") {
  const geometry::Mesh mesh = cut_quads(12);
  physics::Cloth hinges = bridge::gather(mesh, options(Bending::hinge)),
                 plate = bridge::gather(mesh, options(Bending::plate));
  CHECK(plate.hinges.size() == hinges.hinges.size());
  const physics::CoupledHinges made = bridge::couple_bending(mesh, options(Bending::plate), plate);
  CHECK(made.coupled == int(hinges.hinges.size()));
  CHECK(made.plain == 0);
  CHECK(plate.hinges.empty());
  const auto ratio = [](const physics::Cloth& cloth) {
    return bending_energy(cloth, rolled(cloth, 1)) / bending_energy(cloth, rolled(cloth, -1));
  };
  CHECK(std::max(ratio(hinges), 1 / ratio(hinges)) > 2);
  CHECK(ratio(plate) == Approx(1).epsilon(0.1));  // but for the corners, which differ
  CHECK(bridge::couple_bending(mesh, options(Bending::hinge), hinges).coupled == 0);
  CHECK(hinges.energies.empty());
}

TEST_CASE("couple_bending: a stored stiffness keeps its hinge, a clamp's stays doubled there alone") {
  geometry::Mesh mesh = cut_quads(4);
  const double unset = std::numeric_limits<double>::quiet_NaN();
  auto own =
      mesh.add_property_map<geometry::Edge, double>(geometry::attribute::hinge_stiffness.name, unset).first;
  const geometry::Edge marked = mesh.edge(mesh.halfedge(geometry::Vertex(12), geometry::Vertex(13)));
  own[marked] = 0.25;
  physics::Cloth cloth = bridge::gather(mesh, options(Bending::plate));
  physics::pin(cloth.particles, std::vector<int>{12, 13, 7});
  physics::stiffen_clamps(cloth);
  const physics::CoupledHinges made = bridge::couple_bending(mesh, options(Bending::plate), cloth);
  CHECK(made.plain == 1);
  REQUIRE(cloth.hinges.size() == 1);
  CHECK(std::min(cloth.hinges[0].vertices[0], cloth.hinges[0].vertices[1]) == 12);
  CHECK(cloth.hinges[0].stiffness == 0.5);
  CHECK_THROWS_AS(bridge::couple_bending(cut_quads(3), options(Bending::plate), cloth),
                  std::invalid_argument);
}

TEST_CASE("couple_bending: a sheet held at one side comes to rest") {
  const geometry::Mesh mesh = cut_quads(8);
  physics::Cloth cloth = bridge::gather(mesh, options(Bending::plate));
  std::vector<int> side;
  for (int i = 0; i < int(cloth.particles.size()); ++i)
    if (cloth.particles.x[std::size_t(i)].x() < 0.15) side.push_back(i);
  physics::pin(cloth.particles, side);
  physics::stiffen_clamps(cloth);
  bridge::couple_bending(mesh, options(Bending::plate), cloth);
  physics::SettleOptions o;
  o.gravity = {0, 0, -9.81};
  CHECK(physics::settle(cloth, nullptr, o).converged);
}
