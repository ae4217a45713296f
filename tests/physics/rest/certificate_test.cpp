// SPDX-License-Identifier: GPL-3.0-or-later
#include "physics/rest/certificate.h"

#include <catch2/catch.hpp>
#include <limits>
#include <numbers>

#include "physics/rest/prestress.h"
#include "tests/physics/body/test_bodies.h"
#include "tests/physics/cloth/finite_differences.h"
#include "tests/physics/cloth/shell_cloths.h"
#include "tests/physics/cloth/strips.h"
#include "tests/physics/rest/settled.h"

using namespace furrow::physics;
using namespace furrow::tests;

namespace {

/// A mass under (or over) a pin, in balance.
Cloth hung(double y) {
  Cloth cloth = pendulum(0.1, 50, 1, {0, y, 0});
  prestress(cloth);
  return cloth;
}

/// A strip that stands on its clamp, in balance as drawn: straight.
Strip column(double gamma, Vec3& gravity) {
  StripOptions o;
  o.rows = 10;
  o.columns = 2;
  Strip strip = equilateral_strip(o);
  gravity = Vec3(-gravity_for(gamma, o.density, o.length, o.rigidity), 0, 0);
  PrestressOptions p;
  p.gravity = gravity;
  prestress(strip.cloth, p);
  return strip;
}

/// The inside of a sphere.
struct Bowl : Collider {
  double radius;
  explicit Bowl(double r) : radius(r) {}
  SignedDistance at(const Vec3& x) const override { return {radius - x.norm(), -x.normalized()}; }
};

Cloth bead(const Vec3& x) {
  Cloth cloth;
  add_particle(cloth, x, 0.01);
  return cloth;
}

}  // namespace

TEST_CASE("certificate: a pendulum swings with g / L, upside down it falls with it") {
  Certificate c = certify(hung(-0.5));
  CHECK(c.residual < 1e-12);
  CHECK(c.stable());
  CHECK(c.smallest_eigenvalue == Approx(9.81 / 0.5).epsilon(1e-9));
  CHECK(c.frequency == Approx(std::sqrt(9.81 / 0.5) / (2 * std::numbers::pi)));
  CHECK(std::abs(c.mode[1].y()) < 1e-6);
  CHECK(c.mode[1].norm() == Approx(1));
  CHECK(c.mode[0] == Vec3::Zero());
  c = certify(hung(0.5));
  CHECK(c.residual < 1e-12);
  CHECK_FALSE(c.stable());
  CHECK(c.negative_eigenvalues == 2);
  CHECK(c.smallest_eigenvalue == Approx(-9.81 / 0.5).epsilon(1e-9));
  CHECK(c.frequency == 0);
}

TEST_CASE("certificate: what is not counted is as stable or not, with the same mode") {
  const Certificate stands = certify(hung(0.5), {.count = false}), counted = certify(hung(0.5));
  CHECK(stands.negative_eigenvalues == -1);
  CHECK_FALSE(stands.stable());
  CHECK(stands.smallest_eigenvalue == counted.smallest_eigenvalue);
  CHECK(stands.mode == counted.mode);
  CHECK(certify(hung(-0.5), {.count = false}).negative_eigenvalues == 0);
}

TEST_CASE("certificate: eigenvalue and count agree with the dense problem, stable and not") {
  for (const double crumple : {0.0, 0.01}) {
    Cloth cloth = sheet(4, 4, 0.1, 0.2, 3, 300, 40);
    add_membrane(cloth, 500);
    add_hinges(cloth, 0.01);
    cloth.particles.inv_mass[0] = cloth.particles.inv_mass[5] = cloth.particles.inv_mass[15] = 0;
    Noise noise(4);
    for (Vec3& x : cloth.particles.x) x += crumple * noise.vector();
    const Certificate c = certify(cloth);
    std::vector<int> kept;
    std::vector<double> root;
    for (int i = 0; i < 16; ++i) {
      if (cloth.particles.inv_mass[i] == 0) continue;
      kept.insert(kept.end(), {3 * i, 3 * i + 1, 3 * i + 2});
      root.insert(root.end(), 3, std::sqrt(cloth.particles.inv_mass[i]));
    }
    const Eigen::VectorXd scale = Eigen::Map<Eigen::VectorXd>(root.data(), Eigen::Index(root.size()));
    const Eigen::MatrixXd k = stiffness_matrix(cloth, cloth.particles.x, Stiffness::exact)(kept, kept);
    const Eigen::VectorXd values =
        Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(scale.asDiagonal() * k * scale.asDiagonal())
            .eigenvalues();
    CHECK(c.negative_eigenvalues == int((values.array() < -1e-6).count()));
    CHECK(c.smallest_eigenvalue == Approx(values[0]).epsilon(1e-8));
    CHECK(c.stable() == (crumple == 0));
    CHECK(c.residual > 0.5);  // not in equilibrium at all: that is another question
  }
}

TEST_CASE("certificate: a column stands below its buckling load and falls above, as settle() finds") {
  for (const double gamma : {6.5, 9.0}) {  // Greenhill: 7.837
    Vec3 gravity;
    const Strip strip = column(gamma, gravity);
    CertificateOptions o;
    o.gravity = gravity;
    const Certificate c = certify(strip.cloth, o);
    CHECK(c.residual < 1e-8);
    CHECK(c.stable() == (gamma < 7.837));
    CHECK(c.negative_eigenvalues == (gamma < 7.837 ? 0 : 1));
    CHECK((c.smallest_eigenvalue > 0) == c.stable());
    Strip pushed = strip;
    for (Vec3& x : pushed.cloth.particles.x)
      if (x.x() > 0) x.z() += 0.01 * x.x() * x.x() / strip.length;
    CHECK(settle(pushed.cloth, nullptr, down_to(1e-8, gravity)).converged);
    CHECK((std::abs(pushed.tip().z()) < 1e-5 * strip.length) == c.stable());
    CHECK((std::abs(pushed.tip().z()) < 0.1 * strip.length) == c.stable());
  }
}

TEST_CASE("certificate: a swing about a vertical axis is neither stable nor unstable") {
  Cloth cloth;  // a stick on two strings from one pin
  add_particle(cloth, {0, 0, 0}, 1);
  cloth.particles.inv_mass[0] = 0;
  add_particle(cloth, {-0.3, -0.4, 0}, 0.1);
  add_particle(cloth, {0.3, -0.4, 0}, 0.1);
  cloth.structural = {{0, 1, 1, 300}, {0, 2, 1, 300}, {1, 2, 1, 300}};
  CHECK(prestress(cloth).residual < 1e-9);
  const Certificate c = certify(cloth);
  CHECK(c.stable());
  CHECK(std::abs(c.smallest_eigenvalue) < 1e-7);
}

TEST_CASE("certificate: a bead lies still in a bowl, rolls off a ball, and sticks to it by friction") {
  const double gap = 0.003;
  CertificateOptions o;
  o.friction = 0;
  const Bowl bowl(0.5);
  Certificate c = certify(bead({0, -(0.5 - gap), 0}), o, &bowl);
  CHECK(c.residual < 1e-12);
  CHECK(c.sliding == 1);
  CHECK(c.stable());
  CHECK(c.smallest_eigenvalue == Approx(9.81 / (0.5 - gap)).epsilon(1e-4));
  const Sphere ball(Vec3::Zero(), 0.5);
  c = certify(bead({0, 0.5 + gap, 0}), o, &ball);
  CHECK(c.negative_eigenvalues == 2);
  CHECK(c.smallest_eigenvalue == Approx(-9.81 / (0.5 + gap)).epsilon(1e-4));
  o.friction = 0.3;
  c = certify(bead({0, 0.5 + gap, 0}), o, &ball);
  CHECK(c.sticking == 1);
  CHECK(c.stable());
  c = certify(bead({0, 0.6, 0}), o, &ball);  // above it: falls, and costs no energy in doing so
  CHECK(c.sticking + c.sliding == 0);
  CHECK(c.residual == Approx(1));
}

TEST_CASE(
    "certificate: a drawn bump on the floor is stable, where friction holds it and where it may slide") {
  Cloth cloth = sheet(9, 9, 0.03, 0.1, 2, 300, 0);
  add_hinges(cloth, 1e-4);
  for (Vec3& x : cloth.particles.x) {
    const double r2 = (x - Vec3(0.13, -0.1, 0)).squaredNorm() / (0.08 * 0.08);
    x = Vec3(x.x(), 0.003 + (r2 < 1 ? 0.01 * (1 - r2) * (1 - r2) : 0), -x.y());
  }
  const Floor floor;
  for (const double friction : {0.0, 0.3}) {
    PrestressOptions p;
    p.friction = friction;
    Cloth solved = cloth;
    const PrestressReport report = prestress(solved, p, &floor);
    CertificateOptions o;
    o.friction = friction;
    const Certificate c = certify(solved, o, &floor);
    CHECK(c.residual <= 1e-8);
    CHECK(c.stable());
    CHECK(c.sticking + c.sliding > 20);
    CHECK(c.sticking + c.sliding <= int(report.touching.size()));
    CHECK((c.sticking > 0) == (friction > 0));
    if (friction == 0) CHECK(std::abs(c.smallest_eigenvalue) < 1e-5);  // it may slide as a whole
    if (friction > 0) CHECK(c.smallest_eigenvalue > 1);
  }
}

TEST_CASE("certificate: nothing that moves, the same bits twice, and what cannot be") {
  Cloth still = hung(-1);
  still.particles.inv_mass[1] = 0;
  CHECK(certify(still).smallest_eigenvalue == std::numeric_limits<double>::infinity());
  CHECK(certify(still).stable());
  Vec3 gravity;
  const Strip strip = column(6, gravity);
  CHECK(certify(strip.cloth).smallest_eigenvalue == certify(strip.cloth).smallest_eigenvalue);
  const auto refuses = [&](const CertificateOptions& o, const std::string& word,
                           std::vector<Vec3> loads = {}) {
    CHECK_THROWS_WITH(certify(strip.cloth, o, nullptr, loads), Catch::Contains(word));
  };
  CertificateOptions o;
  o.friction = -1;
  refuses(o, "friction = -1");
  o = {};
  o.gap = 0;
  refuses(o, "gap = 0");
  o = {};
  o.max_steps = 1;
  refuses(o, "max_steps = 1");
  o = {};
  o.gravity.y() = std::numeric_limits<double>::quiet_NaN();
  refuses(o, "gravity");
  refuses({}, "loads", std::vector<Vec3>(2));
}
