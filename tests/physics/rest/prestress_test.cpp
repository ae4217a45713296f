// SPDX-License-Identifier: GPL-3.0-or-later
#include "physics/rest/prestress.h"

#include <catch2/catch.hpp>
#include <limits>

#include "physics/cloth/carried_angle.h"
#include "physics/cloth/pins.h"
#include "physics/contact/residual_force.h"
#include "physics/motion/simulate.h"
#include "physics/plate/plate_bending.h"
#include "physics/plate/press.h"
#include "physics/plate/recouple.h"
#include "physics/rest/certificate.h"
#include "physics/rest/rigid_imbalance.h"
#include "tests/cases/plates.h"
#include "tests/physics/body/test_bodies.h"
#include "tests/physics/cloth/shell_cloths.h"

using namespace furrow::physics;
using namespace furrow::tests;

namespace {

const Vec3 gravity(0, -9.81, 0);

/// A sheet with a bump, raised along z after it was made, so that nothing is at rest as it lies.
Cloth bumpy(double height, double rigidity = 1e-4, double bending = 0) {
  Cloth cloth = sheet(9, 9, 0.03, 0.1, 2, 300, bending);
  add_hinges(cloth, rigidity);
  for (Vec3& x : cloth.particles.x) {
    const double r2 = (x - Vec3(0.13, -0.1, 0)).squaredNorm() / (0.08 * 0.08);
    if (r2 < 1) x.z() += height * (1 - r2) * (1 - r2);
  }
  return cloth;
}

Cloth with_triangles(Cloth cloth) {
  Cloth other = without_springs(cloth);
  add_membrane(other, 300);
  return other;
}

void pin_row(Cloth& cloth) {
  for (int i = 0; i < 9; ++i) pin(cloth.particles, std::vector<int>{i});
}

/// The same lying on the floor, the bump upwards.
Cloth lying(double height, double rigidity = 1e-4) {
  Cloth cloth = bumpy(height, rigidity);
  for (Vec3& x : cloth.particles.x) x = Vec3(x.x(), 0.003 + x.z(), -x.y());
  return cloth;
}

}  // namespace

TEST_CASE("prestress: a drawn bump is in balance, with springs, triangles and either hinge") {
  for (const bool triangles : {false, true}) {
    for (const HingeLaw law : {HingeLaw::linear, HingeLaw::cosine}) {
      Cloth cloth = triangles ? with_triangles(bumpy(0.01)) : bumpy(0.01, 1e-4, 3);
      cloth.hinge_law = law;
      pin_row(cloth);
      balance_rigidly(cloth, gravity);
      const std::vector<Vec3> drawn = cloth.particles.x;
      CHECK(residual_force(cloth, gravity, nullptr, 0, 0.003) > 1);
      const PrestressReport report = prestress(cloth);
      CAPTURE(triangles, int(law), report.max_angle, report.max_strain, report.iterations);
      CHECK(report.residual <= 1e-8);
      CHECK(report.residual == residual_force(cloth, gravity, nullptr, 0, 0.003));
      CHECK(report.active_bounds() == 0);
      CHECK(report.imbalance.empty());
      CHECK(report.factorisations == 1);
      CHECK(report.max_angle > 1e-3);
      CHECK(cloth.particles.x == drawn);
    }
  }
}

TEST_CASE("prestress: a solve ends where only round-off is left, whatever is asked for") {
  Cloth cloth = with_triangles(bumpy(0.01));
  pin_row(cloth);
  balance_rigidly(cloth, gravity);
  PrestressOptions exact;
  exact.tolerance = 1e-300;
  const PrestressReport report = prestress(cloth, exact);
  CHECK(report.residual <= 1e-8);
  CHECK(report.iterations <= 12);  // of 60 that it may take
  CHECK(report.factorisations == 1);
}

TEST_CASE("prestress: a drawn bump whose bending is a plate is in balance, and stays in a simulation") {
  Cloth cloth = bumpy(0.01);
  pin_row(cloth);
  balance_rigidly(cloth, gravity);
  furrow::cases::add_plate(cloth, isotropic_plate(1e-4, 0.3));
  REQUIRE(count_coupled(cloth) > 100);
  const std::vector<Vec3> drawn = cloth.particles.x;
  CHECK(residual_force(cloth, gravity, nullptr, 0, 0.003) > 1);
  const PrestressReport report = prestress(cloth);
  CAPTURE(report.max_angle, report.max_strain);
  CHECK(report.residual <= 1e-8);
  CHECK(report.residual == residual_force(cloth, gravity, nullptr, 0, 0.003));
  CHECK(report.active_bounds() == 0);
  CHECK(report.max_angle > 1e-3);
  CHECK(cloth.particles.x == drawn);
  CHECK(certify(cloth, {gravity, 0.3, 0.003}).stable());
  SimulateOptions options;
  options.seconds = 0.3;
  simulate(cloth, nullptr, options);
  for (std::size_t i = 0; i < drawn.size(); ++i) CHECK((cloth.particles.x[i] - drawn[i]).norm() < 1e-8);
}

TEST_CASE("prestress: a plate is the one that its cloth's rest lengths make, pressed or not") {
  Cloth cloth = with_triangles(bumpy(0.005));
  pin_row(cloth);
  balance_rigidly(cloth, gravity);
  furrow::cases::add_plate(cloth, isotropic_plate(1e-4));
  press(cloth, std::vector<int>{30, 31, 32, 39, 40, 41, 48, 49}, 10);
  const PrestressReport report = prestress(cloth);
  CHECK(report.residual <= 1e-8);
  CHECK(report.max_strain > 1e-4);
  CHECK(report.iterations > 3);
  CHECK(report.factorisations == 1);  // it serves the rounds behind the first
  const std::vector<Vec3>& x = cloth.particles.x;
  const double energy = cloth.energies[0]->energy(x);
  CHECK(energy > 0);
  CHECK(recouple(cloth));
  CHECK(cloth.energies[0]->energy(x) == energy);  // to the last bit
  CHECK(residual_force(cloth, gravity, nullptr, 0, 0.003) == report.residual);
  CHECK(certify(cloth, {gravity, 0.3, 0.003}).stable());
}

TEST_CASE("prestress: cloth with threads is in balance by them, and the threads stay where they lie") {
  for (const WovenModuli moduli : {WovenModuli{450, 450, 50, 0}, WovenModuli{1000, 500, 20, 0.2}}) {
    Cloth cloth = without_springs(bumpy(0.005));
    pin_row(cloth);
    balance_rigidly(cloth, gravity);
    const WovenSheet sheet = woven_sheet(moduli);
    const std::vector<double> warp = furrow::cases::warp_along(cloth, 0.5);
    const auto lengths = furrow::cases::lengths_of(cloth);
    for (std::size_t t = 0; t < cloth.triangles.size(); ++t) {
      MembraneTriangle m{cloth.triangles[t], lengths[t], sheet.lame.lambda, sheet.lame.mu};
      m.threads = {warp[t], sheet.warp, sheet.weft};
      for (double& l : m.rest_lengths) l *= 1.003;  // what it was made of does not count
      cloth.membrane.push_back(m);
    }
    const auto lying = [&](const MembraneTriangle& t, std::size_t i) {
      return carried_angle(t.threads.angle, t.rest_lengths, lengths[i]);
    };
    std::vector<double> before;
    for (std::size_t t = 0; t < lengths.size(); ++t) before.push_back(lying(cloth.membrane[t], t));
    furrow::cases::add_plate(cloth, {2e-4, 1e-4, 5e-5}, 0.5);
    const PrestressReport report = prestress(cloth);
    CAPTURE(report.max_angle, report.max_strain);
    CHECK(report.residual <= 1e-8);
    CHECK(report.residual == residual_force(cloth, gravity, nullptr, 0, 0.003));
    CHECK(report.active_bounds() == 0);
    CHECK(report.max_strain > 1e-4);
    for (std::size_t t = 0; t < lengths.size(); ++t)
      CHECK(std::abs(std::sin(lying(cloth.membrane[t], t) - before[t])) < 1e-12);
    CHECK(certify(cloth, {gravity, 0.3, 0.003}).stable());
    const std::vector<Vec3> drawn = cloth.particles.x;
    SimulateOptions options;
    options.seconds = 0.3;
    simulate(cloth, nullptr, options);
    for (std::size_t i = 0; i < drawn.size(); ++i) CHECK((cloth.particles.x[i] - drawn[i]).norm() < 1e-8);
  }
}

TEST_CASE("prestress: a plate that would turn too far is cut, named, and out of balance") {
  Cloth cloth = bumpy(0.01);
  pin_row(cloth);
  balance_rigidly(cloth, gravity);
  furrow::cases::add_plate(cloth, isotropic_plate(1e-4));
  PrestressOptions options;
  options.max_angle = 0.01;
  const PrestressReport report = prestress(cloth, options);
  CHECK(report.coupled.size() > 0);
  CHECK(report.max_angle == 0.01);
  CHECK(report.residual > 1e-3);
}

TEST_CASE("prestress: what is relaxed and bears no load keeps its rest state") {
  Cloth cloth = bumpy(0);
  add_membrane(cloth, 300);
  const Cloth before = cloth;
  PrestressOptions options;
  options.gravity = Vec3::Zero();
  const PrestressReport report = prestress(cloth, options);
  CHECK(report.residual < 1e-9);
  CHECK(report.imbalance.empty());  // free, but nothing moves it
  for (std::size_t i = 0; i < cloth.structural.size(); ++i)
    CHECK(std::abs(cloth.structural[i].rest_length - before.structural[i].rest_length) < 1e-9 * 0.03);
  for (std::size_t i = 0; i < cloth.membrane.size(); ++i)
    for (int e = 0; e < 3; ++e)
      CHECK(std::abs(cloth.membrane[i].rest_lengths[e] - before.membrane[i].rest_lengths[e]) < 1e-9 * 0.03);
  for (std::size_t i = 0; i < cloth.hinges.size(); ++i)
    CHECK(std::abs(cloth.hinges[i].rest_angle - before.hinges[i].rest_angle) < 1e-9);
}

TEST_CASE("prestress: a spring under a weight is as long as Hooke says") {
  Cloth cloth = pendulum(0.1, 50, 0.3, {0, -1, 0});
  const PrestressReport report = prestress(cloth);
  CHECK(cloth.structural[0].rest_length == Approx(1 - 0.1 * 9.81 / 50).epsilon(1e-13));
  CHECK(report.residual < 1e-12);
}

TEST_CASE("prestress: known loads are balanced with the weight") {
  Cloth cloth = bumpy(0.01);
  pin(cloth.particles, std::vector<int>{0, 8, 76});
  std::vector<Vec3> wind(cloth.particles.size(), Vec3(0, 0, 2e-4));
  const PrestressReport report = prestress(cloth, {}, nullptr, wind);
  CHECK(report.residual <= 1e-8);
  CHECK(report.residual == residual_force(cloth, gravity, nullptr, 0, 0.003, wind));
  CHECK(residual_force(cloth, gravity, nullptr, 0, 0.003) > 0.01);
}

TEST_CASE("prestress: a load that no inner force can balance is found, and the turn helps") {
  Cloth cloth = bumpy(0.03, 1e-3);
  pin_row(cloth);
  for (int i = 0; i < 9; ++i) cloth.particles.x[i] = Vec3(cloth.particles.x[i].x(), 0, 0);
  Cloth turned = cloth;
  const PrestressReport report = prestress(cloth);
  REQUIRE(report.imbalance.size() == 1);
  const RigidImbalance& r = report.imbalance[0];
  CHECK(r.freedoms == 1);
  CHECK(std::abs(r.axis.x()) == Approx(1));
  CHECK(r.piece.size() == 72);
  // All that is left is the acceleration of the rigid body.
  CHECK(report.residual == Approx(r.largest / 9.81).epsilon(1e-6));
  CHECK(report.residual > 1e-3);
  CHECK(balance_rigidly(turned, gravity) > 1e-3);
  const PrestressReport better = prestress(turned);
  CHECK(better.imbalance.empty());
  CHECK(better.residual <= 1e-8);
}

TEST_CASE("prestress: bounds are respected, and named") {
  PrestressOptions options;
  Cloth cloth = bumpy(0.01);
  pin_row(cloth);
  balance_rigidly(cloth, gravity);
  Cloth free = cloth;
  const PrestressReport unbounded = prestress(free, options);
  REQUIRE(unbounded.active_bounds() == 0);
  SECTION("with room elsewhere the balance stays") {
    options.max_angle = 0.8 * unbounded.max_angle;
    const PrestressReport report = prestress(cloth, options);
    CAPTURE(unbounded.max_angle, report.iterations, report.hinges.size());
    CHECK(report.max_angle == Approx(options.max_angle).epsilon(1e-9));
    CHECK(report.max_angle <= options.max_angle * (1 + 1e-12));
    CHECK(report.hinges.size() > 0);
    CHECK(report.residual <= 1e-8);
  }
  SECTION("without it comes near, and says so") {
    options.max_angle = 1e-4;
    options.max_strain = 1e-4;
    const PrestressReport report = prestress(cloth, options);
    CHECK(report.max_angle <= options.max_angle * (1 + 1e-9));
    CHECK(report.max_strain <= options.max_strain * (1 + 1e-9));
    CHECK(report.hinges.size() > 10);
    CHECK(report.structural.size() + report.hinges.size() == report.active_bounds());
    CHECK(report.residual > 1e-3);
    CHECK(report.residual < 2);  // as near as copying the shape at least: that leaves the weight, 1
  }
}

TEST_CASE("prestress: springs bear no more compression than they are allowed to") {
  Cloth cloth = bumpy(0.01);
  pin_row(cloth);
  balance_rigidly(cloth, gravity);
  const auto compression = [](const Cloth& c) {
    double most = 0;
    for (const Spring& s : c.structural)
      most = std::max(most, 1 - (c.particles.x[s.b] - c.particles.x[s.a]).norm() / s.rest_length);
    return most;
  };
  Cloth free = cloth;
  prestress(free);
  PrestressOptions options;
  options.max_compression = 0.5 * compression(free);
  const PrestressReport report = prestress(cloth, options);
  CHECK(report.structural.size() > 0);
  CHECK(compression(cloth) == Approx(options.max_compression).epsilon(1e-9));
  CHECK(report.residual <= 1e-8);
}

TEST_CASE("prestress: triangles on their bound") {
  Cloth cloth = with_triangles(bumpy(0.01));
  pin_row(cloth);
  balance_rigidly(cloth, gravity);
  PrestressOptions options;
  options.max_strain = 5e-4;
  const PrestressReport report = prestress(cloth, options);
  CHECK(report.membrane.size() > 0);
  CHECK(report.max_strain <= options.max_strain * 1.002);
  CHECK(report.residual < 1);
}

TEST_CASE("prestress: a bump on the floor, with friction and without") {
  const Floor floor;
  for (const double friction : {0.0, 0.3}) {
    Cloth cloth = lying(0.02);
    PrestressOptions options;
    options.friction = friction;
    const PrestressReport report = prestress(cloth, options, &floor);
    CAPTURE(friction, report.iterations, report.factorisations, report.active_bounds());
    CHECK(report.residual <= 1e-8);
    CHECK(report.imbalance.empty());
    CHECK(report.touching.size() > 20);
    CHECK(report.touching.size() < 81);
    Vec3 sum = Vec3::Zero();
    double weight = 0, sideways = 0;
    for (const Vec3& f : report.contact_force) {
      sum += f;
      CHECK(f.y() >= 0);
      CHECK(std::hypot(f.x(), f.z()) <= friction * f.y() * (1 + 1e-12) + 1e-15);
      sideways = std::max(sideways, std::hypot(f.x(), f.z()));
    }
    for (const double m : cloth.particles.mass) weight += 9.81 * m;
    CHECK((sum - Vec3(0, weight, 0)).norm() < 1e-7 * weight);
    CHECK((sideways > 0) == (friction > 0));
  }
}

TEST_CASE(
    "prestress: where a sampled body's gradient jumps the forces of contact are those that are judged") {
  struct Sampled : Floor {  // its gradient leans to and fro by more than the angle of friction
    SignedDistance at(const Vec3& x) const override {
      const double lean = std::fmod(std::abs(x.x()), 0.1) < 0.05 ? 0.5 : -0.5;
      return {x.y(), Vec3(lean, 1, 0).normalized()};
    }
    SignedDistance smooth_at(const Vec3& x) const override { return Floor::at(x); }
  } body;
  Cloth cloth = lying(0.02);
  const PrestressReport report = prestress(cloth, {}, &body);
  CHECK(report.imbalance.empty());
  CHECK(report.residual <= 1e-8);
  CHECK(report.touching.size() > 20);
  for (const Vec3& f : report.contact_force)
    CHECK(std::hypot(f.x(), f.z()) <= 0.3 * f.y() * (1 + 1e-12) + 1e-15);
}

TEST_CASE("prestress: what lies beyond the edge of a body tips over") {
  struct Table : Collider {  // the quarter space x < 0.02, y < 0
    SignedDistance at(const Vec3& x) const override {
      if (x.x() <= 0.02) return {x.y(), Vec3::UnitY()};
      const Vec3 d(x.x() - 0.02, std::max(x.y(), 0.0), 0);
      return {d.norm(), d.normalized()};
    }
  } table;
  Cloth cloth = bumpy(0, 1);
  for (Vec3& x : cloth.particles.x) x = Vec3(x.x(), 0.003, -x.y());
  const PrestressReport report = prestress(cloth, {}, &table);
  REQUIRE(report.imbalance.size() == 1);
  CHECK(report.imbalance[0].freedoms == 6);
  CHECK(report.residual > 0.1);
  CHECK(report.imbalance[0].moment.z() < 0);
  for (const Vec3& f : report.contact_force) CHECK(f.y() >= 0);
}

TEST_CASE("prestress: cloth without bending bears what lies in its plane and says what it cannot") {
  Cloth cloth = sheet(9, 9, 0.03, 0.1, 2, 300, 0);
  pin_row(cloth);
  for (int i = 0; i < 9; ++i) cloth.particles.x[i].y() = 0;
  CHECK(prestress(cloth).residual <= 1e-8);
  PrestressOptions across;
  across.gravity = Vec3(0, 0, -9.81);
  const PrestressReport report = prestress(cloth, across);
  CHECK(report.residual > 0.1);
  CHECK(report.imbalance.size() == 1);
  Cloth bad = cloth;
  bad.structural[40].stiffness = std::numeric_limits<double>::infinity();
  CHECK_THROWS_AS(prestress(bad), std::invalid_argument);
  CHECK_THROWS_AS(certify(bad), std::invalid_argument);
}

TEST_CASE("prestress: over a ball friction bears what slides without it") {
  const Sphere ball(Vec3(0, -0.2, 0), 0.2);
  Cloth cloth = bumpy(0);
  for (Vec3& x : cloth.particles.x) {  // rolled on, its middle beside the top
    const Vec3 flat(x.x() - 0.12, 0, -x.y() - 0.1);
    const double angle = flat.norm() / 0.2;
    x = Vec3(0, -0.2, 0) + 0.203 * (std::sin(angle) * flat.normalized() + std::cos(angle) * Vec3::UnitY());
  }
  PrestressOptions options;
  CHECK(prestress(cloth, options, &ball).residual <= 1e-8);
  options.friction = 0;
  const PrestressReport report = prestress(cloth, options, &ball);
  REQUIRE(report.imbalance.size() == 1);
  CHECK(report.imbalance[0].freedoms == 6);
  CHECK(report.residual > 1e-3);
  for (std::size_t i = 0; i < report.touching.size(); ++i) {
    const Vec3 n = (cloth.particles.x[report.touching[i]] - ball.centre).normalized();
    CHECK(report.contact_force[i].dot(n) >= 0);
    CHECK((report.contact_force[i] - report.contact_force[i].dot(n) * n).norm() < 1e-12);
  }
}

TEST_CASE("prestress: what is solved stays as drawn in a simulation, hung and on the floor") {
  const Floor floor;
  for (const bool on_floor : {false, true}) {
    Cloth cloth = on_floor ? lying(0.02) : bumpy(0.02);
    if (!on_floor) pin_row(cloth);
    if (!on_floor) balance_rigidly(cloth, gravity);
    Cloth copy = cloth;
    for (Spring& s : copy.structural) s.rest_length = (copy.particles.x[s.b] - copy.particles.x[s.a]).norm();
    const std::vector<Vec3> drawn = cloth.particles.x;
    const auto drift_of = [&](Cloth& c) {
      SimulateOptions options;
      options.seconds = 0.5;
      simulate(c, on_floor ? &floor : nullptr, options);
      double drift = 0;
      for (std::size_t i = 0; i < drawn.size(); ++i)
        drift = std::max(drift, (c.particles.x[i] - drawn[i]).norm());
      return drift;
    };
    prestress(cloth, {}, on_floor ? &floor : nullptr);
    CAPTURE(on_floor);
    CHECK(drift_of(cloth) < (on_floor ? 5e-5 : 1e-8));  // contact holds to 10 um
    CHECK(drift_of(copy) > 1e-3);
  }
}

TEST_CASE("prestress: the same input gives the same bits") {
  const auto run = [] {
    Cloth cloth = lying(0.02);
    const Floor floor;
    prestress(cloth, {}, &floor);
    return cloth;
  };
  const Cloth a = run(), b = run();
  for (std::size_t i = 0; i < a.structural.size(); ++i)
    CHECK(a.structural[i].rest_length == b.structural[i].rest_length);
  for (std::size_t i = 0; i < a.hinges.size(); ++i) CHECK(a.hinges[i].rest_angle == b.hinges[i].rest_angle);
}

TEST_CASE("prestress: what cannot be is refused and nothing changes") {
  const Cloth good = bumpy(0.01);
  const auto refuses = [&](const Cloth& cloth, const PrestressOptions& options, const std::string& word,
                           std::vector<Vec3> loads = {}) {
    Cloth copy = cloth;
    CHECK_THROWS_WITH(prestress(copy, options, nullptr, loads), Catch::Contains(word));
    CHECK(copy.structural[0].rest_length == cloth.structural[0].rest_length);
  };
  PrestressOptions o;
  o.max_strain = 0.2;
  refuses(good, o, "max_strain = 0.2");
  o = {};
  o.max_compression = -0.1;
  refuses(good, o, "max_compression = -0.1");
  o = {};
  o.max_angle = 0;
  refuses(good, o, "max_angle = 0");
  o = {};
  o.friction = -1;
  refuses(good, o, "friction = -1");
  o = {};
  o.gap = std::numeric_limits<double>::infinity();
  refuses(good, o, "gap = inf");
  o = {};
  o.tolerance = 0;
  refuses(good, o, "tolerance = 0");
  o = {};
  o.max_iterations = 0;
  refuses(good, o, "max_iterations = 0");
  o = {};
  o.gravity.x() = std::numeric_limits<double>::quiet_NaN();
  refuses(good, o, "gravity");
  refuses(good, {}, "3 loads", std::vector<Vec3>(3, Vec3::Zero()));
  Cloth bad = good;
  bad.particles.mass[1] = 0;
  refuses(bad, {}, "mass of free particle 1");
  bad = good;
  bad.particles.x[4].z() = std::numeric_limits<double>::infinity();
  refuses(bad, {}, "position of particle 4");
  bad = with_triangles(good);
  bad.membrane[2].mu = 0;
  bad.structural = good.structural;
  refuses(bad, {}, "mu = 0");
}
