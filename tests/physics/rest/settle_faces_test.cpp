// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>

#include "physics/rest/settle.h"
#include "tests/physics/body/test_bodies.h"
#include "tests/physics/cloth/shell_cloths.h"
#include "tests/physics/cloth/test_cloths.h"

using namespace furrow::physics;
using namespace furrow::tests;

namespace {

/// A cone that opens downwards, its tip a ball: {x: |x - (0, -t, 0)| <= r + t sin a for a t >= 0}.
struct Cone : Collider {
  double radius, slope;  // of the tip [m], half of its angle [rad]
  Cone(double r, double half_angle) : radius(r), slope(half_angle) {}
  SignedDistance at(const Vec3& x) const override {
    const double out = std::hypot(x.x(), x.z()), down = -x.y();
    const double t = std::max(0.0, down + out * std::tan(slope));  // that of the nearest ball
    const Vec3 way = x + t * Vec3::UnitY();
    return {way.norm() - radius - t * std::sin(slope), way.normalized()};
  }
};

/// A sheet of triangles and hinges with edges of 5 cm, its border held, pulled over a body by its weight.
Cloth coarse_sheet(const Vec3& shift) {
  Cloth cloth = without_springs(sheet(6, 6, 0.05));
  add_membrane(cloth, 300);
  add_hinges(cloth, 1e-5);
  for (Vec3& x : cloth.particles.x) x = Vec3(x.x() - 0.15, 0, x.y() + 0.13) + shift;
  for (std::size_t i = 0; i < cloth.particles.size(); ++i) {
    const Vec3 x = cloth.particles.x[i] - shift;
    if (std::abs(x.x()) > 0.11 || std::abs(x.z()) > 0.11) cloth.particles.inv_mass[i] = 0;
  }
  return cloth;
}

/// The least distance of the cloth's faces, by many points on each.
double least(const Cloth& cloth, const Collider& body) {
  double least = 1;
  const auto& x = cloth.particles.x;
  constexpr int n = 40;
  for (const auto& t : cloth.triangles)
    for (int i = 0; i <= n; ++i)
      for (int j = 0; j <= n - i; ++j) {
        const Vec3 p = (double(i) * x[std::size_t(t[0])] + double(j) * x[std::size_t(t[1])] +
                        double(n - i - j) * x[std::size_t(t[2])]) /
                       n;
        least = std::min(least, body.at(p).value);
      }
  return least;
}

SettleReport settled(Cloth& cloth, const Collider& body, bool faces, int threads = 1) {
  SettleOptions o;
  o.threads = threads;
  o.max_iterations = 400;
  if (faces) o.faces.body = &body;
  return settle(cloth, &body, o);
}

}  // namespace

TEST_CASE("settle: a body smaller than the faces comes through them, unless faces are guarded", "[long]") {
  const Sphere ball(Vec3(0, -0.006, 0), 0.01);
  const Cone cone(0.004, 0.35);
  for (const Collider* body : std::initializer_list<const Collider*>{&ball, &cone})
    for (const Vec3& shift : {Vec3(0.012, 0, 0.008), Vec3(-0.021, 0, 0.017), Vec3(0.004, 0, -0.02)}) {
      INFO((body == &ball ? "ball " : "cone ") << shift.transpose());
      Cloth before = coarse_sheet(shift), after = coarse_sheet(shift);
      REQUIRE(settled(before, *body, false).converged);
      REQUIRE(least(before, *body) < -0.001);
      const SettleReport report = settled(after, *body, true);
      CHECK(report.converged);
      CHECK(report.residual <= 1e-3);
      CHECK(report.face_contacts > 0);
      CHECK(least(after, *body) > 0);
      for (const int threads : {2, 3}) {
        Cloth again = coarse_sheet(shift);
        settled(again, *body, true, threads);
        CHECK(again.particles.x == after.particles.x);
      }
    }
}

TEST_CASE("settle: guarded faces change no bit where nothing comes through") {
  const Sphere ball(Vec3(0, -0.5, 0), 0.499);
  Cloth with = coarse_sheet(Vec3(0.012, 0.001, 0.008)), without = with;
  const SettleReport a = settled(with, ball, true), b = settled(without, ball, false);
  REQUIRE(b.converged);
  REQUIRE(b.touching > 0);
  CHECK(with.particles.x == without.particles.x);
  CHECK(a.residual == b.residual);
  CHECK(a.iterations == b.iterations);
  CHECK(a.face_contacts == 0);
}

TEST_CASE("settle: where a body leaves no way out, faces end as near to rest as without a guard") {
  // Two balls that squeeze the sheet from both sides.
  struct Jaws : Collider {
    Sphere low{Vec3(0.012, -0.0095, 0.008), 0.01}, high{Vec3(0.012, 0.0095, 0.008), 0.01};
    SignedDistance at(const Vec3& x) const override {
      const SignedDistance a = low.at(x), b = high.at(x);
      return a.value < b.value ? a : b;
    }
  };
  const Jaws jaws;
  Cloth cloth = coarse_sheet(Vec3::Zero()), free = cloth;
  const SettleReport report = settled(cloth, jaws, true), unguarded = settled(free, jaws, false);
  REQUIRE(unguarded.converged);
  REQUIRE(least(free, jaws) < 0);
  CHECK(report.converged);
  CHECK(report.residual <= 1e-3);
  CHECK(report.iterations > unguarded.iterations);  // it tried
  CHECK(least(cloth, jaws) >= least(free, jaws) - 1e-4);
}

TEST_CASE("settle: contacts in faces are counted of the rest that is taken, not of the last that was tried") {
  const Sphere ball(Vec3(0, -0.006, 0), 0.01);
  for (const Vec3& shift : {Vec3(0.012, 0, 0.008), Vec3(-0.021, 0, 0.017), Vec3(0.004, 0, -0.02)}) {
    Cloth first = coarse_sheet(shift), cut_short = first;
    const SettleReport unguarded = settled(first, ball, false);
    SettleOptions o;
    o.max_iterations = unguarded.iterations + 1;  // points are set, but no rest is found with them
    o.faces.body = &ball;
    const SettleReport report = settle(cut_short, &ball, o);
    INFO(shift.transpose());
    REQUIRE(cut_short.particles.x == first.particles.x);
    CHECK(report.face_contacts == 0);
  }
}
