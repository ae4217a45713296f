// SPDX-License-Identifier: GPL-3.0-or-later
// Where the fast fit leaves a garment, leapfrog without friction leaves it, too.
#include <catch2/catch.hpp>

#include "physics/cloth/elements.h"
#include "physics/motion/simulate.h"
#include "physics/rest/certificate.h"
#include "tests/cases/draped.h"
#include "tests/cases/garment_pair.h"
#include "tests/test_paths.h"

using namespace furrow;
using physics::Cloth, physics::Vec3;

namespace {

/// Who wears the skirt leans forward by 0.5 rad: it lies on her from behind.
const Vec3 tilted_gravity(0, -9.81 * std::cos(0.5), 9.81 * std::sin(0.5));

Cloth moved(Cloth cloth, const physics::Collider& body, double gap, double seconds) {
  physics::SimulateOptions o;
  o.gravity = tilted_gravity;
  o.friction = 0;
  o.contact_gap = gap;
  o.air_drag = 6;
  o.seconds = seconds;
  REQUIRE(physics::simulate(cloth, &body, o).outcome == physics::Outcome::finished);
  return cloth;
}

/// Once more, until cloth lies on the gap itself, as leapfrog's does.
void settle_on_the_gap(Cloth& cloth, const physics::Collider& body, physics::SettleOptions o) {
  o.contact_depth = 1e-6;
  const physics::SettleReport report = physics::settle(cloth, &body, o);
  CHECK(report.converged);
  CHECK(report.touching > 5);
}

/// E of b less that of a [J].
double energy_gained(const Cloth& a, const Cloth& b) {
  double e = potential_energy(b, b.particles.x) - potential_energy(a, a.particles.x);
  for (std::size_t i = 0; i < a.particles.size(); ++i)
    e -= a.particles.mass[i] * tilted_gravity.dot(b.particles.x[i] - a.particles.x[i]);
  return e;
}

}  // namespace

TEST_CASE("drape: a skirt's rest without friction is one of leapfrog's, too", "[release]") {
  const std::filesystem::path folder = tests::source_dir() / "meshes";
  const cases::GarmentPair pair = cases::read_pair(folder / "skirt.obj", folder / "mannequin.obj");
  bridge::DrapeOptions o;
  o.settle.gravity = tilted_gravity;
  o.settle.friction = 0;
  o.settle.gap = cases::gap_of(pair, 0);
  o.settle.tolerance = 1e-5;
  o.settle.max_iterations = 500;
  geometry::Mesh mesh = pair.garment;
  Cloth rest, start;
  const auto keep_start = [&](int, const physics::SettleProgress& now, const Cloth& cloth) {
    if (now.iteration == 0) start = cloth;
    return true;
  };
  const bridge::MakeCloth make = cases::make_cotton(pair, cases::vertex_at_top(mesh));
  const bridge::DrapeReport report = bridge::drape(mesh, rest, &pair.field, o, make, keep_start);
  CHECK(report.levels[0].settle.converged);
  CHECK(report.levels[0].settle.touching > 5);
  Cloth stiff = rest;
  settle_on_the_gap(stiff, pair.field, o.settle);
  CHECK(cases::median_surface_distance(mesh, rest.particles.x, stiff.particles.x) < 0.003);
  const physics::CertificateOptions certified{.gravity = tilted_gravity, .friction = 0, .gap = o.settle.gap};
  CHECK(physics::certify(stiff, certified, &pair.field).stable());

  const Cloth stayed = moved(stiff, pair.field, o.settle.gap, 0.2);
  const double elastic = potential_energy(stiff, stiff.particles.x);
  CHECK(elastic > 1e-3);
  CHECK(std::abs(energy_gained(stiff, stayed)) < 1e-3 * elastic);
  CHECK(cases::farthest(stiff.particles.x, stayed.particles.x) < 3e-5);
  // A state that is no rest does not pass for one.
  const Cloth fell = moved(start, pair.field, o.settle.gap, 0.1);
  CHECK(cases::farthest(start.particles.x, fell.particles.x) > 0.003);
  CHECK(energy_gained(start, fell) < -elastic);
}
