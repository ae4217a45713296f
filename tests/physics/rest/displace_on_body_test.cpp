// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>
#include <limits>

#include "physics/rest/settle.h"
#include "tests/physics/body/test_bodies.h"
#include "tests/physics/cloth/shell_cloths.h"
#include "tests/physics/cloth/tension_cloths.h"

using namespace furrow::physics;
using namespace furrow::tests;

namespace {

/// A plane through the origin that rises along x.
struct Ramp : Collider {
  Vec3 up, down;  // normal, way down
  explicit Ramp(double angle)
      : up(-std::sin(angle), std::cos(angle), 0), down(-std::cos(angle), -std::sin(angle), 0) {}
  SignedDistance at(const Vec3& x) const override { return {x.dot(up), up}; }
};

/// The sheet of test_cloths.h, laid flat at a height, its middle on the axis y.
Cloth lying(Cloth cloth, double height) {
  Vec3 middle = Vec3::Zero();
  for (const Vec3& x : cloth.particles.x) middle += x / double(cloth.particles.size());
  for (Vec3& x : cloth.particles.x) x = Vec3(x.x() - middle.x(), height, middle.y() - x.y());
  return cloth;
}

/// The whole weight divided by the number of particles (method S2.5).
void weigh_evenly(Particles& p) {
  double sum = 0;
  for (const double m : p.mass) sum += m;
  p.mass.assign(p.size(), sum / double(p.size()));
  p.inv_mass.assign(p.size(), double(p.size()) / sum);
}

double least_distance(const Cloth& cloth, const Collider& body) {
  double least = std::numeric_limits<double>::infinity();
  for (const Vec3& x : cloth.particles.x) least = std::min(least, body.at(x).value);
  return least;
}

}  // namespace

TEST_CASE("displace_by_force: without the cap a stretched sheet breaks down, with it it drapes",
          "[displace][release]") {
  const Sphere ball(Vec3(0, -0.12, 0), 0.1);
  Cloth rest = with_tension(lying(sheet(9, 11, 0.03, 0, 1, 1000, 0), 0), 1, 0.3);
  weigh_evenly(rest.particles);
  Cloth cloth = rest;
  cloth.bending.clear();
  add_hinges(cloth, 1e-6);
  cloth.hinge_law = HingeLaw::cosine;
  for (Vec3& x : cloth.particles.x) x *= 1.6;
  DisplaceOptions options;
  options.rate = 4 * displacement_rate(rest, options.gravity, options.gap);
  options.tolerance = 0.05;
  options.max_passes = 40000;
  Cloth capped = cloth;
  const DisplaceReport report = displace_by_force(capped, &ball, options);
  CAPTURE(int(report.outcome), report.passes, report.residual, report.capped, report.touching);
  CHECK(report.outcome == DisplaceOutcome::converged);
  CHECK(report.capped > 0);
  CHECK(report.touching > 3);
  CHECK(least_distance(capped, ball) > options.gap - 1e-8);
  options.cap = false;
  CHECK(displace_by_force(cloth, &ball, options).outcome == DisplaceOutcome::diverged);
}

TEST_CASE("displace_by_force: the cap keeps a membrane bounded at a rate that is not stable",
          "[displace][release]") {
  const Sphere ball(Vec3(0, -0.11, 0), 0.1);
  Cloth cloth = without_springs(lying(sheet(13, 15, 0.02, 0.1), 0));
  add_membrane(cloth, 100);
  DisplaceOptions options;
  const double half = displacement_rate(cloth, options.gravity, 1);
  options.rate = 2.4 * half;
  options.max_passes = 3000;
  options.cap = false;
  Cloth free = cloth;
  const DisplaceReport broken = displace_by_force(free, &ball, options);
  CHECK(broken.outcome == DisplaceOutcome::diverged);
  CHECK(broken.passes < options.max_passes);
  options.cap = true;
  const DisplaceReport report = displace_by_force(cloth, &ball, options);
  CAPTURE(int(report.outcome), report.residual);
  CHECK(report.outcome != DisplaceOutcome::converged);
  CHECK(report.outcome != DisplaceOutcome::diverged);
  CHECK(report.residual > 1);
  CHECK(least_distance(cloth, ball) > options.gap - 1e-8);
  for (const Vec3& x : cloth.particles.x) CHECK(x.norm() < 0.4);
}

TEST_CASE("displace_by_force: a particle sticks to an incline below atan(mu), slides above", "[displace]") {
  const double angle = 0.5, mass = 0.01;
  const Ramp incline(angle);
  DisplaceOptions options;
  options.rate = 1e-4 / (mass * 9.81);  // falls 0.1 mm a pass
  const auto end = [&](double friction, double height, int passes) {
    Cloth cloth;
    add_particle(cloth, (options.gap + height) * incline.up, mass);
    options.friction = friction;
    options.max_passes = passes;
    const DisplaceReport report = displace_by_force(cloth, &incline, options);
    CHECK(incline.at(cloth.particles.x[0]).value > options.gap - 1e-8);
    return std::pair(report.outcome, cloth.particles.x[0].dot(incline.down));
  };
  const auto [stuck, at] = end(1.01 * std::tan(angle), 0.001, 1000);
  CHECK(stuck == DisplaceOutcome::converged);
  CHECK(at == Approx(0.001 * std::tan(angle)).margin(5e-5));  // where it fell
  const double friction = 0.99 * std::tan(angle);
  const auto [sliding, along] = end(friction, 0, 1000);
  CHECK(sliding == DisplaceOutcome::unfinished);
  CHECK(along == Approx(1000 * 1e-4 * (std::sin(angle) - friction * std::cos(angle))).epsilon(1e-5));
}

TEST_CASE("displace_by_force: a sheet stays on an incline below atan(mu) only", "[displace][long]") {
  for (const double share : {0.9, 1.1}) {
    const double angle = std::atan(0.4 * share);
    const Ramp incline(angle);
    Cloth cloth = sheet(6, 6, 0.02, 0.1, 1, 10, 0.1);
    for (Vec3& x : cloth.particles.x) x = 0.004 * incline.up + x.y() * incline.down + Vec3(0, 0, x.x());
    const Vec3 start = cloth.particles.x[0];
    DisplaceOptions options;
    options.friction = 0.4;
    const DisplaceReport report = displace_by_force(cloth, &incline, options);
    const double way = (cloth.particles.x[0] - start).dot(incline.down);
    CAPTURE(share, report.passes, report.residual, way);
    CHECK((report.outcome == DisplaceOutcome::converged) == (share < 1));
    CHECK((report.touching == 36));
    CHECK((way < 0.001) == (share < 1));
  }
}
