// SPDX-License-Identifier: GPL-3.0-or-later
#include "physics/rest/plate_friction.h"

#include <catch2/catch.hpp>
#include <limits>
#include <numbers>

#include "physics/cloth/elements.h"
#include "physics/plate/plate_bending.h"
#include "tests/cases/plates.h"
#include "tests/physics/cloth/strips.h"
#include "tests/physics/rest/settled.h"

using namespace furrow::physics;
using namespace furrow::cases;
using namespace furrow::tests;

namespace {

constexpr double rigidity = 2e-5;

/// A free square of 100 mm.
Cloth square(SheetKind kind) {
  Cloth cloth = clamped_strip(kind, 0.1, 0.1, 10, 2000).cloth;
  for (double& m : cloth.particles.inv_mass) m = 1e3;
  add_plate(cloth, isotropic_plate(rigidity));
  return cloth;
}

/// Lays a flat cloth on a flat parabola with the curvature K along `angle`.
void bend_to(Cloth& cloth, const Cloth& flat, double curvature, double angle) {
  for (std::size_t i = 0; i < cloth.particles.size(); ++i) {
    const Vec3& x = flat.particles.x[i];
    const double s = x.x() * std::cos(angle) + x.y() * std::sin(angle);
    cloth.particles.x[i] = Vec3(x.x(), x.y(), -curvature * s * s / 2);
  }
}

const PlateBending& plate_at(const Cloth& cloth, std::size_t energy) {
  return dynamic_cast<const PlateBending&>(*cloth.energies[energy]);
}

/// The work of friction on triangles away from the border [J] while k moves from what it was.
double work_of(const PlateBending& friction, const std::vector<char>& core, std::vector<Eigen::Vector3d>& k,
               const std::vector<Vec3>& x) {
  const std::vector<Eigen::Vector3d> now = friction.curvatures(x);
  const Plate& plate = friction.plate();
  double work = 0;
  for (std::size_t t = 0; t < now.size(); ++t)
    if (core[t] && !plate.at_rest.empty())
      work += (plate.stiffness[t] * (0.5 * (now[t] + k[t]) - plate.at_rest[t])).dot(now[t] - k[t]);
  k = now;
  return work;
}

double strip_lowest(const Cloth& cloth) {
  double z = 0;
  for (const Vec3& x : cloth.particles.x) z = std::min(z, x.z());
  return -z;
}

bool settles(Cloth& cloth, const PlateFriction& friction, const SettleOptions& options, double slip) {
  for (int round = 0; round < 200; ++round) {
    const bool converged = settle(cloth, nullptr, options).converged;
    if (update_friction(cloth, friction) <= slip && converged) return true;
  }
  return false;
}

}  // namespace

TEST_CASE("plate_friction: a cycle takes 4 limit (K - K_y) an area, on every mesh and along every line",
          "[long]") {
  for (const SheetKind kind : {SheetKind::one_diagonal, SheetKind::union_jack, SheetKind::jittered}) {
    for (const double angle : {0.0, 0.7}) {
      const Cloth flat = square(kind);
      Cloth cloth = flat;
      const double most = 0.01, yield = 0.004,
                   limit = 3 * rigidity * yield;  // so flat that angles are slopes
      const PlateFriction friction = add_plate_friction(cloth, {.stiffness = 3, .moment = limit});
      REQUIRE(friction.energies == std::vector<std::size_t>{1});
      const std::vector<char> core = core_of(flat, 3);
      REQUIRE(plate_at(cloth, 1).plate().triangles() == int(core.size()));
      std::vector<Eigen::Vector3d> k = plate_at(cloth, 1).curvatures(cloth.particles.x);
      const int steps = 1000;
      double work = 0, area = 0;
      for (int i = 1; i <= 2 * steps; ++i) {
        bend_to(cloth, flat, most * std::sin(2 * std::numbers::pi * i / steps), angle);
        const double by = work_of(plate_at(cloth, 1), core, k, cloth.particles.x);
        if (i > steps) work += by;
        update_friction(cloth, friction);
      }
      for (std::size_t t = 0; t < core.size(); ++t)
        if (core[t]) area += plate_at(cloth, 1).plate().area[t];
      CAPTURE(name_of(kind), angle);
      CHECK(work == Approx(4 * limit * (most - yield) * area).epsilon(0.01));
    }
  }
}

TEST_CASE("plate_friction: a strip that hung from a clamp keeps a curve with friction and none without",
          "[long]") {
  ClampedStrip strip = clamped_strip(SheetKind::union_jack, 0.1, 0.025, 16, 2000);
  add_plate(strip.cloth, isotropic_plate(rigidity));
  const double size = gravity_for(5, strip.density, strip.length, rigidity);
  const Vec3 gravity(0, 0, -size);
  const auto run = [&](double moment) {
    Cloth cloth = strip.cloth;
    const PlateFriction friction = add_plate_friction(cloth, {.moment = moment});
    for (int i = 1; i <= 4; ++i) CHECK(settles(cloth, friction, down_to(1e-6, i / 4.0 * gravity), 1e-6));
    const double hung = strip_lowest(cloth);
    CHECK(settles(cloth, friction, down_to(1e-5, Vec3::Zero()), 1e-6));
    return std::pair(hung / strip.length, strip_lowest(cloth) / strip.length);
  };
  const auto [loose_hung, loose] = run(0);
  Cloth plain = strip.cloth;
  CHECK(find_rest(plain, down_to(1e-6, gravity)).converged);
  CHECK(loose_hung == Approx(strip_lowest(plain) / strip.length).margin(1e-3));
  CHECK(loose < 1e-3);
  const auto [hung, kept] = run(0.1 * strip.density * size * strip.length * strip.length / 2);
  CAPTURE(loose_hung, hung, kept);
  CHECK(hung < loose_hung);
  CHECK(kept > 0.01);
  CHECK(kept < hung);
}

TEST_CASE("plate_friction: a copy keeps its own, and friction is refused where it cannot be") {
  const Cloth flat = square(SheetKind::one_diagonal);
  Cloth cloth = flat;
  CHECK_THROWS_AS(add_plate_friction(cloth, {.stiffness = 0}), std::invalid_argument);
  CHECK_THROWS_AS(add_plate_friction(cloth, {.moment = -1}), std::invalid_argument);
  CHECK_THROWS_AS(add_plate_friction(cloth, {.moment = std::numeric_limits<double>::quiet_NaN()}),
                  std::invalid_argument);
  CHECK(cloth.energies.size() == 1);
  const PlateFriction friction = add_plate_friction(cloth, {.moment = 1e-7});
  const Cloth copy = cloth;
  bend_to(cloth, flat, 1, 0);
  CHECK(update_friction(cloth, friction) > 0);
  CHECK(update_friction(cloth, friction) < 1e-12);
  CHECK(plate_at(copy, 1).plate().at_rest.empty());
  Cloth other = flat;
  CHECK_THROWS_AS(update_friction(other, friction), std::invalid_argument);
  Cloth none = flat;
  none.energies.clear();
  CHECK(update_friction(none, add_plate_friction(none, {})) == 0);
}
