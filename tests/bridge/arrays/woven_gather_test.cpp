// SPDX-License-Identifier: GPL-3.0-or-later
// Threads from the mesh's map to the elements: strips pulled and rolled on garment meshes at every angle.
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "bridge/arrays/couple_bending.h"
#include "bridge/arrays/gather.h"
#include "geometry/mesh/errors.h"
#include "geometry/mesh/vertex_attributes.h"
#include "geometry/refine/subdivide.h"
#include "geometry/rest/masses.h"
#include "geometry/rest/rest_metric.h"
#include "geometry/rest/warp_directions.h"
#include "physics/cloth/elements.h"
#include "physics/cloth/membrane.h"
#include "physics/plate/plate_rigidity.h"
#include "tests/test_meshes.h"

using namespace furrow;
using physics::Vec3;

namespace {

constexpr double turn_of = std::numbers::pi / 180;
constexpr bridge::Weave uneven_weave{1000, 500, 30, 0.2, 2e-5, 1e-5, 3e-6};

bridge::GatherOptions woven_options() {
  bridge::GatherOptions o;
  o.mean_structural_length = o.mean_bending_length = 0.1;
  o.membrane = bridge::Membrane::triangles;
  o.bending = bridge::Bending::plate;
  o.weave = uneven_weave;
  return o;
}

/// A flat garment with the warp at an angle to x, refined so many times: a part has the whole's direction.
geometry::Mesh woven(geometry::Mesh mesh, double angle, int refined) {
  geometry::set_warp_along(mesh, {std::cos(angle), std::sin(angle), 0});
  geometry::ensure_rest_positions(mesh);
  geometry::ensure_rest_lengths(mesh);
  if (refined) geometry::loop_subdivide(mesh, refined);
  const auto made = *geometry::find_map(mesh, geometry::attribute::rest_position);
  for (geometry::Vertex v : mesh.vertices())  // Loop's rules round corners off: back to what is at rest
    mesh.point(v) = {made[v][0], made[v][1], made[v][2]};
  geometry::lump_masses(mesh, 0.15);
  return mesh;
}

double area_of(const geometry::Mesh& mesh) {
  double area = 0;
  const auto rest = *geometry::find_map(mesh, geometry::attribute::rest_length);
  for (geometry::Face f : mesh.faces())
    area += geometry::triangle_area(geometry::rest_lengths_of(mesh, rest, f));
  return area;
}

}  // namespace

TEST_CASE("gather: cloth with threads stretches as its map says, at each angle, refined or not") {
  const bridge::Weave& w = uneven_weave;
  for (const bool is_jittered : {false, true})
    for (const int refined : {0, 1})
      for (const double degrees : {0., 15., 30., 45., 60., 75., 90., 135.}) {
        const double angle = degrees * turn_of, stretch = 1e-4;
        geometry::Mesh mesh =
            woven(is_jittered ? tests::jittered(6, 4, 0.2, 5) : tests::grid(6, 4), angle, refined);
        const physics::Cloth cloth = bridge::gather(mesh, woven_options());
        std::vector<Vec3> x = cloth.particles.x;
        for (Vec3& p : x) p.x() *= 1 + stretch;  // E11 alone
        const double e11 = stretch + stretch * stretch / 2;
        const double q = 1 - w.poisson * w.poisson * w.weft / w.warp;
        const double c = std::cos(angle) * std::cos(angle), s = 1 - c;
        const double modulus =
            (c * c * w.warp + s * s * w.weft + 2 * c * s * w.poisson * w.weft) / q + 4 * c * s * w.shear;
        CAPTURE(is_jittered, refined, degrees);
        CHECK(physics::potential_energy(cloth, x) ==
              Approx(0.5 * area_of(mesh) * modulus * e11 * e11).epsilon(1e-6));
      }
}

/// The rigidity of a rolled sheet with the warp at an angle to the way that it is rolled along [N m].
double rolled_rigidity(double angle, int refined) {
  constexpr double curvature = 0.01;
  geometry::Mesh mesh = woven(tests::jittered(12, 12, 0.2, 5), angle, refined);
  const bridge::GatherOptions options = woven_options();
  physics::Cloth cloth = bridge::gather(mesh, options);
  bridge::couple_bending(mesh, options, cloth);
  cloth.membrane.clear();
  std::vector<Vec3> x = cloth.particles.x;
  for (Vec3& p : x) p.z() = -curvature / 2 * p.x() * p.x();
  return 2 * physics::potential_energy(cloth, x) / (area_of(mesh) * curvature * curvature);
}

TEST_CASE("couple_bending: cloth with threads bends as its map says, at each angle, refined or not") {
  const bridge::Weave& w = uneven_weave;
  for (const double degrees : {0., 22.5, 45., 60., 90., 135.}) {
    const double angle = degrees * turn_of;
    const double wanted = physics::plate_matrix({w.bend_warp, w.bend_weft, w.twist, 0}, angle)(0, 0);
    // Half a cell along each free border does not bend: an error of the first order in the cells' size.
    const double coarse = rolled_rigidity(angle, 0), fine = rolled_rigidity(angle, 1);
    CAPTURE(degrees, coarse, fine, wanted);
    CHECK(coarse < fine);
    CHECK(2 * fine - coarse == Approx(wanted).epsilon(2e-3));
  }
}

TEST_CASE("gather: a face of woven cloth without a direction is refused") {
  geometry::Mesh mesh = woven(tests::grid(2, 2), 0.3, 0);
  auto map = *geometry::find_map(mesh, geometry::attribute::warp);
  map[geometry::Face(3)] = geometry::attribute::warp.default_value;
  CHECK_THROWS_AS(bridge::gather(mesh, woven_options()), geometry::ContentError);
}
