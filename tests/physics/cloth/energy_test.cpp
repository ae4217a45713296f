// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>
#include <optional>

#include "physics/cloth/cloth.h"
#include "physics/cloth/element_forces.h"
#include "physics/cloth/pins.h"
#include "physics/cloth/spring_forces.h"
#include "physics/linear/free_stiffness.h"
#include "physics/linear/stable_step.h"
#include "physics/motion/simulate.h"
#include "physics/rest/certificate.h"
#include "physics/rest/prestress.h"
#include "physics/rest/settle.h"
#include "tests/physics/cloth/finite_differences.h"
#include "tests/physics/cloth/one_kind.h"

using namespace furrow::physics;
using namespace furrow::tests;

namespace {

/// What somebody else's spring would be: nothing of it is the library's.
class OwnSpring : public Energy {
 public:
  OwnSpring(int a, int b, double length, double k, bool stiff = true)
      : a_(a), b_(b), length_(length), k_(k), stiff_(stiff) {}

  double energy(std::span<const Vec3> x) const override {
    const double longer = (x[b_] - x[a_]).norm() - length_;
    return k_ * longer * longer / 2;
  }
  void add_forces(std::span<const Vec3> x, std::span<Vec3> force) const override {
    const Vec3 d = x[b_] - x[a_];
    const Vec3 f = k_ * (d.norm() - length_) * d.normalized();
    force[a_] += f, force[b_] -= f;
  }
  bool add_stiffness(std::span<const Vec3> x, Stiffness part, const BlockSink& sink) const override {
    if (!stiff_) return false;
    const Vec3 d = x[b_] - x[a_], n = d.normalized();
    double across = k_ * (1 - length_ / d.norm());
    if (across < 0) across *= 1 - part.clamped;
    const Mat3 along = n * n.transpose(), block = k_ * along + across * (Mat3::Identity() - along);
    sink(a_, a_, block), sink(a_, b_, -block), sink(b_, a_, -block), sink(b_, b_, block);
    return true;
  }

 private:
  int a_, b_;
  double length_, k_;
  bool stiff_;
};

enum class Extra { built_in, own, own_without_stiffness };

/// A small sheet with two pins, far from rest, whose lowest corner a spring joins to one in the middle.
Cloth sheet_with(Extra extra) {
  Cloth cloth = sheet(5, 4, 0.1, 0.2, 3, 20, 2);
  Noise noise(8);
  for (Vec3& x : cloth.particles.x) x += 0.01 * noise.vector();
  for (Vec3& v : cloth.particles.v) v = 0.5 * noise.vector();
  pin(cloth.particles, std::vector<int>{0, 4});
  const Spring spring{7, 19, 0.2, 30};
  if (extra == Extra::built_in)
    cloth.bending.push_back(spring);
  else
    cloth.energies.push_back(std::make_shared<OwnSpring>(spring.a, spring.b, spring.rest_length,
                                                         spring.stiffness, extra == Extra::own));
  return cloth;
}

double largest_difference(const std::vector<Vec3>& a, const std::vector<Vec3>& b) {
  double most = 0;
  for (std::size_t i = 0; i < a.size(); ++i) most = std::max(most, (a[i] - b[i]).norm());
  return most;
}

double largest(const std::vector<Vec3>& a) {
  double most = 0;
  for (const Vec3& v : a) most = std::max(most, v.norm());
  return most;
}

SimulateOptions undamped(Integrator integrator, double seconds, double dt) {
  SimulateOptions o;
  o.seconds = seconds, o.dt = dt, o.spring_damping = 0, o.integrator = integrator;
  return o;
}

const Collider* const no_body = nullptr;

}  // namespace

TEST_CASE("energy: a caller's own spring counts as the built-in one in energy, forces and stiffness") {
  const Cloth own = sheet_with(Extra::own), same = sheet_with(Extra::built_in);
  const std::vector<Vec3>& x = own.particles.x;
  CHECK(potential_energy(own, x) == Approx(potential_energy(same, x)).epsilon(1e-13));
  CHECK((forces(own, x) - forces(same, x)).norm() < 1e-13 * forces(same, x).norm());
  const auto k = [&](const Cloth& cloth) { return stiffness_matrix(cloth, x, Stiffness::exact); };
  CHECK((k(own) - k(same)).norm() < 1e-13 * k(same).norm());
  std::vector<Vec3> force(x.size()), other = force, load(x.size(), Vec3(1, 2, 3)), load2 = load;
  ThreadPool pool(2);
  CHECK(ElementForces(own)(x, force, pool) == Approx(ElementForces(same)(x, other, pool)).epsilon(1e-13));
  CHECK(largest_difference(force, other) < 1e-12);
  FreeStiffness a(own), b(same);
  a.assemble(own, x, Stiffness::positive_part, &pool);
  b.assemble(same, x, Stiffness::positive_part);
  REQUIRE(a.factorise_definite(1));
  REQUIRE(b.factorise_definite(1));
  a.solve(load), b.solve(load2);
  CHECK(largest_difference(load, load2) < 1e-12);
  CHECK(stable_step(own, {.tolerance = 1e-6}).omega_max ==
        Approx(stable_step(same, {.tolerance = 1e-6}).omega_max).epsilon(1e-5));
}

TEST_CASE("energy: a caller's own spring moves a cloth as the built-in one does, whatever integrates") {
  const Integrator integrator = GENERATE(Integrator::leapfrog, Integrator::rk4, Integrator::implicit);
  const double dt = integrator == Integrator::implicit ? 0.005 : 0.0005;
  const SimulateOptions options = undamped(integrator, 0.1, dt);
  Cloth own = sheet_with(Extra::own), same = sheet_with(Extra::built_in), none = same;
  none.bending.pop_back();
  const std::vector<Vec3> start = own.particles.x;
  simulate(own, no_body, options);
  simulate(same, no_body, options);
  simulate(none, no_body, options);
  CHECK(largest_difference(own.particles.x, start) > 0.03);
  CHECK(largest_difference(none.particles.x, same.particles.x) > 0.01);
  CAPTURE(int(integrator));
  CHECK(1e12 * largest_difference(own.particles.x, same.particles.x) / largest(same.particles.x) < 1);
  CHECK(1e12 * largest_difference(own.particles.v, same.particles.v) / largest(same.particles.v) < 1);
}

TEST_CASE("energy: Newton's method of implicit steps sees the energy of one without stiffness") {
  SimulateOptions options = undamped(Integrator::implicit, 0.02, 0.001);
  options.implicit = {.tolerance = 1e-4, .few = 12};
  Cloth rough = sheet_with(Extra::own_without_stiffness), same = sheet_with(Extra::built_in);
  CHECK(simulate(rough, no_body, options).open_steps == 0);
  CHECK(simulate(same, no_body, options).open_steps == 0);
  CHECK(largest_difference(rough.particles.x, same.particles.x) < 1e-7);
}

TEST_CASE("energy: the same bits on any number of threads") {
  SimulateOptions options = undamped(Integrator::leapfrog, 0.1, 0.0005);
  Cloth one = sheet_with(Extra::own), three = one;
  simulate(one, no_body, options);
  options.threads = 3;
  simulate(three, no_body, options);
  CHECK(one.particles.x == three.particles.x);
  CHECK(one.particles.v == three.particles.v);
}

TEST_CASE("energy: settle finds the rest of a caller's own spring, with stiffness and without") {
  const SettleOptions options{.tolerance = 1e-11, .max_iterations = 2000};
  Cloth own = sheet_with(Extra::own), same = sheet_with(Extra::built_in),
        rough = sheet_with(Extra::own_without_stiffness);
  CHECK(settle(own, nullptr, options).residual < 1e-10);
  CHECK(settle(same, nullptr, options).residual < 1e-10);
  CHECK(largest_difference(own.particles.x, same.particles.x) < 1e-12 * 0.5);
  CHECK(settle(rough, nullptr, {.tolerance = 1e-8, .max_iterations = 2000}).converged);
  CHECK(largest_difference(rough.particles.x, same.particles.x) < 1e-7);
}

TEST_CASE("energy: the step's limit takes one without stiffness from differences of its forces") {
  Cloth pendulum;
  add_particle(pendulum, {0, 0, 0}, 0);
  add_particle(pendulum, {0, -1.1, 0}, 0.2);
  const auto omega = [&](Extra extra, double k) {
    Cloth cloth = pendulum;
    if (extra == Extra::built_in)
      cloth.structural = {{0, 1, 1, k}};
    else
      cloth.energies = {std::make_shared<OwnSpring>(0, 1, 1, k, extra == Extra::own)};
    return stable_step(cloth).omega_max;
  };
  for (const double k : {1e-3, 50.0, 1e6}) {
    CAPTURE(k);
    CHECK(omega(Extra::built_in, k) == Approx(std::sqrt(k / 0.2)).epsilon(1e-6));
    CHECK(omega(Extra::own, k) == Approx(std::sqrt(k / 0.2)).epsilon(1e-6));
    CHECK(omega(Extra::own_without_stiffness, k) == Approx(std::sqrt(k / 0.2)).epsilon(1e-6));
  }
  pendulum.particles.inv_mass[1] = 0;
  CHECK(std::isinf([&] {
    pendulum.energies = {std::make_shared<OwnSpring>(0, 1, 1, 50, false)};
    return stable_step(pendulum).dt_limit;
  }()));
  const double limit = stable_step(sheet_with(Extra::built_in)).omega_max;
  CHECK(stable_step(sheet_with(Extra::own_without_stiffness)).omega_max == Approx(limit).epsilon(0.01));
}

TEST_CASE("energy: certify counts its stiffness, and does not guess one that it lacks") {
  Cloth own = sheet_with(Extra::own), same = sheet_with(Extra::built_in);
  settle(same, nullptr, {.tolerance = 1e-9});
  own.particles.x = same.particles.x;
  CHECK(certify(own).stable());
  CHECK(certify(own).smallest_eigenvalue == Approx(certify(same).smallest_eigenvalue).epsilon(1e-6));
  CHECK_THROWS_WITH(certify(sheet_with(Extra::own_without_stiffness)), Catch::Contains("no stiffness"));
}

TEST_CASE("energy: what cannot count one says so") {
  Cloth cloth = sheet_with(Extra::own);
  CHECK_THROWS_WITH(simulate(cloth, no_body, undamped(Integrator::xpbd, 0.1, 0.01)),
                    Catch::Contains("springs only") && Catch::Contains("1 energies"));
  CHECK_THROWS_WITH(prestress(cloth), Catch::Contains("energies"));
  CHECK(cloth.particles.x == sheet_with(Extra::own).particles.x);
  Cloth none = cloth;
  none.energies.clear();
  CHECK(fingerprint(none) != fingerprint(cloth));
}

TEST_CASE("energy: null, particles out of range and blocks that come and go are refused") {
  Cloth cloth = sheet_with(Extra::own);
  cloth.energies.push_back(nullptr);
  CHECK_THROWS_AS(simulate(cloth, no_body, {}), std::invalid_argument);
  CHECK_THROWS_AS(settle(cloth, nullptr, {}), std::invalid_argument);
  struct Broken : OwnSpring {
    mutable int calls = 0;
    int bad;
    explicit Broken(int index) : OwnSpring(0, 1, 1, 1), bad(index) {}
    bool add_stiffness(std::span<const Vec3>, Stiffness, const BlockSink& sink) const override {
      sink(bad, bad, Mat3::Identity());
      if (bad == 0 && ++calls > 2) sink(1, 1, Mat3::Identity());
      return true;
    }
  };
  cloth.energies = {std::make_shared<Broken>(99)};
  CHECK_THROWS_AS(FreeStiffness(cloth), std::invalid_argument);
  CHECK_THROWS_AS(stable_step(cloth), std::invalid_argument);
  cloth.energies = {std::make_shared<Broken>(0)};
  FreeStiffness stiffness(cloth);
  CHECK_THROWS_AS(stiffness.assemble(cloth, cloth.particles.x, Stiffness::exact), std::invalid_argument);
}
