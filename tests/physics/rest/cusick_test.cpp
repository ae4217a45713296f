// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/cases/cusick.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <numeric>

#include "physics/motion/simulate.h"
#include "physics/rest/certificate.h"
#include "physics/rest/settle.h"

using namespace furrow::physics;
using namespace furrow::cases;

namespace {

constexpr double pi = std::numbers::pi;

double radius(const Vec3& x) { return std::hypot(x.x(), x.y()); }

/// The elastic curve by another program: a static solver of its own, hinges, an orthotropic membrane of
/// Y = 450, G = 50 N/m, 1321 vertices, the lowest energy of three starts.
struct Point {
  double length, coefficient;  // c [m], DC
};
constexpr Point elastic_curve[] = {{0.032, 0.896}, {0.025, 0.806},  {0.020, 0.665},
                                   {0.016, 0.495}, {0.0125, 0.314}, {0.010, 0.235}};

SettleReport hang(Cusick& specimen, double tolerance = 1e-3) {
  SettleOptions options;
  options.tolerance = tolerance;
  options.gravity = {0, 0, -cusick_gravity};
  return settle(specimen.cloth, nullptr, options);
}

}  // namespace

TEST_CASE("cusick: a ring lies on the discs' edge and is held there, hinges on it count twice", "[release]") {
  CusickOptions options;
  const Cusick whole = cusick_specimen(options);
  const Particles& p = whole.cloth.particles;
  CHECK(p.size() == 1321);
  CHECK(std::accumulate(p.mass.begin(), p.mass.end(), 0.0) == Approx(0.18 * pi * 0.15 * 0.15).epsilon(1e-3));
  double held = 0, least_free = 1;
  for (std::size_t i = 0; i < p.size(); ++i) {
    if (p.inv_mass[i] == 0) held = std::max(held, radius(p.x[i]));
    if (p.inv_mass[i] > 0) least_free = std::min(least_free, radius(p.x[i]));
  }
  CHECK(held == Approx(0.09).epsilon(1e-12));
  CHECK(least_free == Approx(0.0975).epsilon(1e-12));
  options.stiff_clamp = false;
  const Cusick plain = cusick_specimen(options);
  int doubled = 0;
  for (std::size_t h = 0; h < plain.cloth.hinges.size(); ++h) {
    const double factor = whole.cloth.hinges[h].stiffness / plain.cloth.hinges[h].stiffness;
    CHECK((factor == 1 || factor == 2));
    doubled += factor == 2;
  }
  CHECK(doubled == std::lround(2 * pi * 12));
  options.support = 0.083;
  CHECK_THROWS_WITH(cusick_specimen(options), Catch::Contains("rings * support / radius = 11.06"));
}

TEST_CASE("cusick: the coefficient is 1 for a flat specimen, 0 for one that hangs straight, a cone's between",
          "[release]") {
  Cusick specimen = cusick_specimen({});
  const auto shape = [&](auto&& outside) {  // the distance from the axis that a point outside comes to
    Cusick shaped = specimen;
    for (Vec3& x : shaped.cloth.particles.x) {
      const double r = radius(x), angle = std::atan2(x.y(), x.x());
      if (r > 0.09 + 1e-9) x = Vec3(std::cos(angle), std::sin(angle), 0) * outside(r - 0.09, angle);
    }
    return shaped;
  };
  CHECK(drape_coefficient(shape([](double s, double) { return 0.09 + s; })) == Approx(1).margin(1e-3));
  CHECK(drape_coefficient(shape([](double, double) { return 0.09; })) == Approx(0).margin(2e-3));
  const double half = (0.12 * 0.12 - 0.0081) / (0.0225 - 0.0081);
  CHECK(drape_coefficient(shape([](double s, double) { return 0.09 + s / 2; })) == Approx(half).margin(1e-3));
  // The rim turned back inwards throws no shadow of its own.
  CHECK(drape_coefficient(shape([](double s, double) { return 0.12 - std::abs(s - 0.03); })) ==
        Approx(half).margin(1e-3));
  for (const int n : {2, 7, 13}) {
    CHECK(drape_nodes(
              shape([&](double s, double a) { return 0.09 + s * (0.5 + 0.2 * std::cos(n * a + 1)); })) == n);
  }
}

TEST_CASE("cusick: a coarse specimen is near the elastic curve and stable, softer is limper", "[release]") {
  double last = 1;
  for (const Point& p : {elastic_curve[0], elastic_curve[2]}) {
    CusickOptions options;
    options.rings = 10;
    options.bending_length = p.length;
    Cusick specimen = cusick_specimen(options);
    const SettleReport report = hang(specimen);
    CHECK(report.converged);
    CHECK(report.residual <= 1e-3);
    CertificateOptions certifying;
    certifying.gravity = {0, 0, -cusick_gravity};
    CHECK(certify(specimen.cloth, certifying).stable());
    const double dc = drape_coefficient(specimen);
    CAPTURE(p.length, dc);
    CHECK(std::abs(dc - p.coefficient) < 0.08);  // cells of 15 mm
    CHECK(dc < last);
    CHECK(drape_energy(specimen) < 0);
    last = dc;
  }
}

TEST_CASE("cusick: settle meets the elastic curve within 0.05 from starts with folds", "[release]") {
  for (const Point& p : elastic_curve) {
    for (const int folds : {6, 8}) {
      CusickOptions options;
      options.bending_length = p.length;
      options.folds = folds;
      Cusick specimen = cusick_specimen(options);
      CHECK(hang(specimen).converged);
      const double dc = drape_coefficient(specimen);
      CAPTURE(p.length, folds, dc);
      CHECK(std::abs(dc - p.coefficient) < 0.05);
      CHECK(drape_nodes(specimen) >= 5);
      CHECK(drape_nodes(specimen) <= 9);
    }
  }
}

TEST_CASE("cusick: where leapfrog comes to rest, settle stays", "[release]") {
  CusickOptions options;
  options.rings = 10;
  Cusick moved = cusick_specimen(options);
  SimulateOptions motion;
  motion.gravity = {0, 0, -cusick_gravity};
  motion.seconds = 6;
  motion.air_drag = 4;
  motion.spring_damping = 0.1;
  const double start = drape_energy(moved);
  CHECK(simulate(moved.cloth, nullptr, motion).outcome == Outcome::finished);
  Cusick settled = moved;
  const SettleReport report = hang(settled, 1e-7);  // finer than where the motion ends
  CHECK(report.converged);
  CHECK(report.iterations > 0);
  double farthest = 0;
  for (std::size_t i = 0; i < moved.cloth.particles.size(); ++i)
    farthest = std::max(farthest, (moved.cloth.particles.x[i] - settled.cloth.particles.x[i]).norm());
  CAPTURE(farthest);
  CHECK(farthest < 1e-3 * moved.radius);
  CHECK(drape_energy(settled) == Approx(drape_energy(moved)).margin(0.01 * (start - drape_energy(moved))));
  CHECK(std::abs(drape_coefficient(settled) - elastic_curve[2].coefficient) < 0.08);  // cells of 15 mm
}
