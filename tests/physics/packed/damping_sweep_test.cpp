// SPDX-License-Identifier: GPL-3.0-or-later
#include "physics/packed/damping_sweep.h"

#include <catch2/catch.hpp>

#include "physics/cloth/cloth.h"
#include "physics/cloth/pins.h"
#include "physics/packed/packed_forces.h"
#include "tests/physics/cloth/test_cloths.h"

using namespace furrow::physics;
using namespace furrow::tests;

namespace {

struct Swept {
  Cloth cloth;
  PackedCloth packed;
  ThreadPool pool{1};
  explicit Swept(const Cloth& from) : cloth(from), packed(pack(from)) { update_spring_forces(packed, pool); }
  const Particles& particles() { return unpack(packed, cloth.particles), cloth.particles; }
};

}  // namespace

TEST_CASE("damping_sweep: one spring's relative velocity decays exactly") {
  Cloth cloth = pendulum(2, 8, 1, {0, 3, 4}, {1, 3, 4});
  const bool pinned = GENERATE(true, false);
  if (!pinned) cloth.particles.mass[0] = 2, cloth.particles.inv_mass[0] = 0.5;  // reduced mass 1
  Swept s(cloth);
  const double m = pinned ? 2 : 1, zeta = 0.3, t = 0.25, gamma = 2 * zeta * std::sqrt(8 / m);
  DampingSweep(s.packed, zeta, t).forward(s.packed, s.pool);
  const Vec3 along(0, 0.6, 0.8), v = s.particles().v[1] - s.particles().v[0];
  CHECK(v.dot(along) == Approx(5 * std::exp(-gamma * t)).epsilon(1e-14));
  CHECK((v - v.dot(along) * along - Vec3(1, 0, 0)).norm() < 1e-14);
}

TEST_CASE("damping_sweep: a sweep never adds energy, keeps rigid motion, leaves pins alone") {
  Cloth cloth = sheet(9, 9, 0.1, 0.2);
  Noise noise(2);
  for (Vec3& v : cloth.particles.v) v = noise.vector();
  pin(cloth.particles, std::vector<int>{4, 40});
  Swept s(cloth);
  const DampingSweep sweep(s.packed, 0.5, 1e-3);
  double energy = kinetic_energy(s.particles());
  for (int i = 0; i < 20; ++i) {
    i % 2 ? sweep.reverse(s.packed, s.pool) : sweep.forward(s.packed, s.pool);
    const double now = kinetic_energy(s.particles());
    CHECK(now < energy);
    energy = now;
  }
  CHECK(s.particles().v[40] == Vec3::Zero());

  Cloth rigid = sheet(9, 9, 0.1, 0.2);
  for (std::size_t i = 0; i < rigid.particles.size(); ++i) {
    rigid.particles.v[i] = Vec3(1, 2, 3) + Vec3(0.5, -2, 1).cross(rigid.particles.x[i]);
  }
  Swept r(rigid);
  sweep.forward(r.packed, r.pool);
  for (std::size_t i = 0; i < rigid.particles.size(); ++i) {
    CHECK((r.particles().v[i] - rigid.particles.v[i]).norm() < 1e-12);
  }
}

TEST_CASE("damping_sweep: the reverse sweep is the adjoint of the forward one") {
  Cloth cloth = sheet(8, 8, 0.1, 0.2);
  Noise noise(21);
  std::vector<Vec3> u, w;
  for (std::size_t i = 0; i < cloth.particles.size(); ++i)
    u.push_back(noise.vector()), w.push_back(noise.vector());
  const auto swept = [&](const std::vector<Vec3>& v, bool forward) {
    cloth.particles.v = v;
    Swept s(cloth);
    const DampingSweep sweep(s.packed, 0.5, 1e-3);
    forward ? sweep.forward(s.packed, s.pool) : sweep.reverse(s.packed, s.pool);
    return s.particles().v;
  };
  const std::vector<Vec3> fu = swept(u, true), rw = swept(w, false), ru = swept(u, false);
  double left = 0, right = 0, other = 0;  // <F u, w> = <u, R w> in the inner product of the masses
  for (std::size_t i = 0; i < u.size(); ++i) {
    left += cloth.particles.mass[i] * fu[i].dot(w[i]);
    right += cloth.particles.mass[i] * u[i].dot(rw[i]);
    other += cloth.particles.mass[i] * ru[i].dot(w[i]);
  }
  CHECK(left == Approx(right).epsilon(1e-12));
  CHECK(std::abs(other - left) > 1e-6 * std::abs(left));
}
