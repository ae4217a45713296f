// SPDX-License-Identifier: GPL-3.0-or-later
#include "physics/cloth/tension_forces.h"

#include <catch2/catch.hpp>
#include <limits>

#include "physics/cloth/cloth.h"
#include "physics/cloth/pins.h"
#include "physics/linear/stable_step.h"
#include "physics/motion/simulate.h"
#include "physics/rest/certificate.h"
#include "physics/rest/invert_elements.h"
#include "physics/rest/prestress.h"
#include "physics/rest/rigid_imbalance.h"
#include "tests/physics/cloth/finite_differences.h"
#include "tests/physics/cloth/one_kind.h"
#include "tests/physics/cloth/shell_cloths.h"
#include "tests/physics/cloth/tension_cloths.h"

using namespace furrow::physics;
using namespace furrow::tests;

namespace {

/// Stretched and compressed in all directions; only tension.
Cloth crumpled_tension(std::uint64_t seed, double compress = 20) {
  Cloth cloth = with_tension(without_springs(sheet(4, 3, 0.1, 0.2, seed)), 0, 0);
  for (const Spring& s : sheet(4, 3, 0.1, 0.2, seed).structural)
    cloth.tension.push_back({s.a, s.b, s.rest_length, 70 + 10.0 * (s.a % 3), compress});
  Noise noise(seed);
  for (Vec3& x : cloth.particles.x) x += 0.02 * noise.vector();
  return cloth;
}

double force_between(double length, const Tension& t) {
  const std::vector<Vec3> x{{1, 2, 3}, Vec3(1, 2, 3) + length * Vec3(2, 1, 2) / 3};
  std::vector<Vec3> force(2, Vec3::Zero());
  add_forces(only(std::vector<Tension>{t}), x, force);
  CHECK((force[0] + force[1]).norm() == 0);
  return force[0].dot(Vec3(2, 1, 2) / 3);  // > 0 pulls
}

}  // namespace

TEST_CASE("tension_forces: tension pulls with stretch e^2 and pushes with compress e^2") {
  const Tension t{0, 1, 0.5, 90, 30};
  CHECK(force_between(0.55, t) == Approx(0.9).epsilon(1e-12));
  CHECK(force_between(0.45, t) == Approx(-0.3).epsilon(1e-12));
  CHECK(force_between(0.5, t) == Approx(0).margin(1e-25));
  CHECK(force_between(0, t) == 0);
  const std::vector<Vec3> x{Vec3::Zero(), {0, 0.6, 0}};
  CHECK(potential_energy(only(std::vector<Tension>{t}), x) == Approx(90 * 0.5 * 0.008 / 3).epsilon(1e-12));
  CHECK(tension_slope(t, 0.1) == Approx(36));
  CHECK(tension_slope(t, -0.1) == Approx(12));
}

TEST_CASE("tension_forces: tension called at rest below a force keeps a strain of sqrt(f / c)") {
  const double e = remaining_strain(40, 1e-3);
  CHECK(e == Approx(0.005).epsilon(1e-12));
  CHECK(tension_law({0, 1, 0.2, 40, 10}, e).force == Approx(1e-3).epsilon(1e-12));
  CHECK_THROWS_WITH(remaining_strain(0, 1), Catch::Contains("stretch"));
  CHECK_THROWS_WITH(remaining_strain(1, -1), Catch::Contains("force"));
}

TEST_CASE("tension: derivatives agree with finite differences, and the parts bound each other") {
  for (int seed = 1; seed <= 5; ++seed) {
    const Cloth cloth = crumpled_tension(seed);
    const DerivativeErrors errors = derivative_errors(cloth, cloth.particles.x, 1e-5);
    CAPTURE(seed);
    CHECK(errors.force < 1e-8);
    CHECK(errors.stiffness < 1e-7);
    CHECK(errors.symmetry < 1e-14);
    const Eigen::MatrixXd part = stiffness_matrix(cloth, cloth.particles.x, Stiffness::positive_part),
                          exact = stiffness_matrix(cloth, cloth.particles.x, Stiffness::exact);
    Eigen::MatrixXd bound = Eigen::MatrixXd::Zero(part.rows(), part.cols()), tight = bound;
    const auto into = [](Eigen::MatrixXd& matrix) {
      return [&matrix](int i, int j, const Mat3& block) { matrix.block<3, 3>(3 * i, 3 * j) += block; };
    };
    for (const Tension& t : cloth.tension) {
      std::array<Mat3, lower_blocks(2)> lower;
      stiffness_bound_blocks(cloth.particles.x, t, lower.data());
      hand_out(vertices(t), lower.data(), into(bound));
      stiffness_bound_blocks(cloth.particles.x, t, lower.data(), 0);
      hand_out(vertices(t), lower.data(), into(tight));
    }
    CHECK(least_eigenvalue(exact) < -1e-3 * part.norm());
    CHECK(least_eigenvalue(part) > -1e-12 * part.norm());
    CHECK(least_eigenvalue(part - exact) > -1e-12 * part.norm());
    CHECK(least_eigenvalue(bound - part) > -1e-12 * part.norm());
    CHECK(least_eigenvalue(tight - part) > -1e-12 * part.norm());
    CHECK(least_eigenvalue(bound - tight) > -1e-12 * part.norm());
  }
}

TEST_CASE("tension_forces: tension exerts neither force nor moment in total, and turns with the cloth") {
  const Cloth cloth = crumpled_tension(3, 70);
  const std::vector<Vec3>& x = cloth.particles.x;
  std::vector<Vec3> force(x.size(), Vec3::Zero()), other = force, y = x;
  add_forces(only(cloth.tension), x, force);
  Vec3 sum = Vec3::Zero(), moment = sum;
  double scale = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    sum += force[i], moment += x[i].cross(force[i]);
    scale += force[i].norm();
  }
  CHECK(sum.norm() < 1e-14 * scale);
  CHECK(moment.norm() < 1e-14 * scale);
  const Mat3 turn = Eigen::AngleAxisd(0.7, Vec3(1, 2, -1).normalized()).toRotationMatrix();
  for (Vec3& p : y) p = turn * p + Vec3(0.3, -2, 1);
  add_forces(only(cloth.tension), y, other);
  for (std::size_t i = 0; i < x.size(); ++i) CHECK((other[i] - turn * force[i]).norm() < 1e-12 * scale);
}

TEST_CASE("tension_forces: it is inverted to a rest length for any pull that it bears") {
  const Tension t{0, 1, 9, 90, 30};
  for (const double pull : {0.0, 1e-9, 0.5, 7.0, 200.0, -1e-9, -0.5, -7.0, -29.0}) {
    CAPTURE(pull);
    Tension other = t;
    other.rest_length = rest_length_for(t, 0.3, pull).value();
    CHECK(force_between(0.3, other) == Approx(pull).epsilon(1e-9).margin(1e-15));
  }
  CHECK_FALSE(rest_length_for(t, 0.3, -30));
  CHECK_FALSE(rest_length_for(Tension{0, 1, 1, 90, 0}, 0.3, -1e-9));
  CHECK_FALSE(rest_length_for(Tension{0, 1, 1, 0, 0}, 0.3, 1e-9));
  CHECK(rest_length_for(Tension{0, 1, 1, 0, 0}, 0.3, 0).value() == 0.3);
}

TEST_CASE(
    "tension_forces: prestress balances a cloth of tension and hinges, whatever its rest lengths were") {
  Cloth cloth = with_tension(without_springs(sheet(7, 7, 0.03, 0.1, 2)), 0, 0);
  for (const Spring& s : sheet(7, 7, 0.03, 0.1, 2).structural)
    cloth.tension.push_back({s.a, s.b, s.rest_length, 60, 60});
  add_hinges(cloth, 1e-4);
  for (Vec3& x : cloth.particles.x) x.z() = 0.01 * std::sin(40 * x.y());
  pin(cloth.particles, std::vector<int>{0, 1, 2, 3, 4, 5, 6});
  balance_rigidly(cloth, Vec3(0, -9.81, 0));
  Cloth other = cloth;
  for (Tension& t : other.tension) t.rest_length *= 1.7;
  const PrestressReport report = prestress(cloth), same = prestress(other);
  CHECK(report.residual < 1e-8);
  CHECK(report.max_strain < 0.1);
  CHECK(report.tension.empty());
  CHECK(report.active_bounds() == 0);
  for (std::size_t i = 0; i < cloth.tension.size(); ++i)
    CHECK(other.tension[i].rest_length == Approx(cloth.tension[i].rest_length).epsilon(1e-9));
  PrestressOptions slack;
  slack.max_compression = 0;
  const PrestressReport bounded = prestress(cloth, slack);
  CHECK_FALSE(bounded.tension.empty());
  CHECK(bounded.active_bounds() == bounded.tension.size() + bounded.hinges.size());
  for (const Tension& t : cloth.tension) {
    const double l = (cloth.particles.x[t.a] - cloth.particles.x[t.b]).norm();
    CHECK(t.rest_length < l * (1 + 1e-12));
  }
}

TEST_CASE("tension_forces: tension counts wherever elements are counted") {
  Cloth cloth = crumpled_tension(2);
  Cloth none = cloth;
  none.tension.clear();
  const StrainStatistics strain = strain_statistics(cloth);
  CHECK(strain.max > 0.05);
  CHECK(strain_statistics(none).max == 0);
  none.structural.push_back({0, 1, (none.particles.x[0] - none.particles.x[1]).norm() / 2, 1});
  cloth.structural = none.structural;
  CHECK(strain_statistics(cloth).max == Approx(1));
  CHECK(strain_statistics(cloth).mean < 0.9);
  Cloth stiffer = cloth, longer = cloth;
  stiffer.tension[3].stretch += 1;
  longer.tension[3].rest_length += 1e-9;
  none = cloth;
  none.tension.clear();
  CHECK(fingerprint(stiffer) != fingerprint(cloth));
  CHECK(fingerprint(longer) != fingerprint(cloth));
  CHECK(fingerprint(none) != fingerprint(cloth));
  Cloth pendulum = with_tension(furrow::tests::pendulum(0.1, 1, 1, {0, -1, 0}), 50, 0);
  const std::vector<Vec3> load(2, Vec3(0, -1, 0));
  const auto pieces = rigid_imbalances(pendulum, load);
  REQUIRE(pieces.size() == 1);
  CHECK(pieces[0].freedoms == 3);  // it swings about its pin; without tension it would be free
}

TEST_CASE("tension_forces: the limit of a step foresees that tension is strained further") {
  const auto limit = [](double strain) {
    Cloth cloth = with_tension(pendulum(0.1, 1, 1, {0, -1 - strain, 0}), 50, 10);
    return stable_step(cloth, {.tolerance = 1e-6}).dt_limit;
  };
  // omega^2 = 2 c e / (L m)
  for (const double e : {0.0, 0.02, 0.1})
    CHECK(limit(e) == Approx(2 / std::sqrt(2 * 50 * (e + tension_margin) / 0.1)).epsilon(1e-4));
}

TEST_CASE("tension_forces: broken tension is refused") {
  const std::vector<Vec3> x(2, Vec3::Zero());
  std::vector<Vec3> force(2, Vec3::Zero());
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const Tension& bad : {Tension{0, 2, 1, 1, 1},
                             {-1, 1, 1, 1, 1},
                             {1, 1, 1, 1, 1},
                             {0, 1, 0, 1, 1},
                             {0, 1, nan, 1, 1},
                             {0, 1, 1, 1, 2},
                             {0, 1, 1, 1, -1},
                             {0, 1, 1, nan, 0}}) {
    const std::vector<Tension> one{bad};
    CHECK_THROWS_AS(potential_energy(only(one), x), std::invalid_argument);
    CHECK_THROWS_AS(add_forces(only(one), x, force), std::invalid_argument);
    CHECK_THROWS_AS(add_stiffness(only(one), x, Stiffness::exact, [](int, int, const Mat3&) {}),
                    std::invalid_argument);
  }
  force.pop_back();
  CHECK_THROWS_AS(add_forces(only(std::vector<Tension>{{0, 1, 1, 1, 1}}), x, force), std::invalid_argument);
}
