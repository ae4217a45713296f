// SPDX-License-Identifier: GPL-3.0-or-later
// What must not move a draped garment, from the meshes and files on.
#include "tests/cases/draped.h"

#include <catch2/catch.hpp>

#include "physics/cloth/elements.h"
#include "tests/test_meshes.h"

using namespace furrow;
using namespace furrow::cases;

namespace {

/// A tube of hinges and triangles that hangs over a ball without friction, held by its upper border.
Drape tube_over_ball() {
  Drape d;
  d.garment = tests::cylinder(0.12, 0.3, 16, 9);
  d.body = tests::icosphere(3, 0.12, {0.02, 0.1, 0});
  for (geometry::Vertex v : d.garment.vertices()) {
    if (d.garment.point(v).y() > 0.299) d.held.push_back(int(v));
  }
  d.springs.membrane = bridge::Membrane::triangles;
  d.springs.bending = bridge::Bending::hinge;
  d.springs.stretch = 50;
  d.springs.rigidity = 1e-4;
  d.options.seconds = 20;
  d.options.friction = 0;
  d.options.air_drag = 10;
  return d;
}

}  // namespace

TEST_CASE(
    "metamorphic: a drape stays within 1 % of energy and 3 mm, turned, permuted and read in millimetres",
    "[release]") {
  const Drape drape = tube_over_ball();
  const DrapedCase base = draped(drape);
  const Rest rest = come_to_rest(base.rest);
  REQUIRE(rest.at_rest);
  CHECK(rest.contacts > 5);
  const double energy = potential_energy(base.rest.cloth, rest.x);
  CHECK(energy > 10 * potential_energy(base.rest.cloth, base.rest.cloth.particles.x));
  const auto check_near = [&](const char* what, const RestCase& c) {
    CAPTURE(what);
    const Rest other = come_to_rest(c);
    CHECK(other.at_rest);
    CHECK(potential_energy(base.rest.cloth, other.x) == Approx(energy).epsilon(0.01));
    CHECK(median_surface_distance(drape.garment, rest.x, other.x) < 0.003);
  };
  for (const auto& [what, changed] : {std::pair{"turned", draped(rotated(drape))},
                                      {"permuted", draped(permuted(drape))},
                                      {"in millimetres", draped(through_millimetres(drape))}}) {
    check_near(what, changed.rest);
  }
  check_near("half the step", with_half_step(base.rest));
  check_near("tenfold damping", with_tenfold_damping(base.rest));
  CHECK(median_surface_distance(drape.garment, rest.x, base.rest.cloth.particles.x) > 1e-4);
}
