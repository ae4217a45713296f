// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>

#include "tests/cases/plates.h"
#include "tests/physics/cloth/strips.h"
#include "tests/physics/rest/settled.h"

using namespace furrow;
using namespace furrow::cases;
using namespace furrow::tests;
using physics::Vec3;

namespace {

/// w L^3 / B at which a strip that stands on edge, clamped at one end, turns aside under its weight, over
/// what Michell and Prandtl have for a strip without width that does not sag: 12.8538 sqrt(E I G J) / (B b),
/// with E I = B b and G J = 2 B b / (1 + nu).
double lateral_load(SheetKind kind, double width, int across, double poisson, double stretch) {
  const ClampedStrip strip = clamped_strip(kind, 1, width, int(across / width), stretch);
  physics::Cloth cloth = strip.cloth;
  add_plate(cloth, physics::isotropic_plate(1, poisson));
  const double theory = 12.853763321 * std::sqrt(2 / (1 + poisson));
  double below = 0.9 * theory, above = 1.3 * theory;
  while (above - below > 1e-3 * theory) {
    const double gamma = (below + above) / 2;
    const Vec3 gravity = gravity_for(gamma, strip.density, 1, 1) * Vec3(0, -1, 0);
    (find_rest(cloth, down_to(1e-4, gravity)).stable ? below : above) = gamma;
  }
  return (below + above) / 2 / theory;
}

}  // namespace

TEST_CASE("plate: a strip on edge turns aside at Michell and Prandtl's load", "[release]") {
  for (const SheetKind kind : {SheetKind::one_diagonal, SheetKind::equilateral}) {
    for (const double poisson : {0.0, 0.3}) {
      const double load = lateral_load(kind, 0.05, 8, poisson, 2e7);
      CAPTURE(name_of(kind), poisson, load);
      CHECK(load == Approx(1).margin(0.05));
    }
  }
  // What is left comes from the clamp, which lets no end warp, in proportion to the width.
  const double wide = lateral_load(SheetKind::one_diagonal, 0.1, 4, 0, 2e7) - 1,
               narrow = lateral_load(SheetKind::one_diagonal, 0.025, 4, 0, 2e7) - 1;
  CAPTURE(wide, narrow);
  CHECK(narrow == Approx(wide / 4).margin(0.003));
  // And from a strip that sags in its plane before: 1 / sqrt((1 - a) (1 - 2 a)), a = 12 L^2 B / (Y b^2).
  const double sagging = lateral_load(SheetKind::one_diagonal, 0.05, 4, 0, 2e5),
               stiff = lateral_load(SheetKind::one_diagonal, 0.05, 4, 0, 2e7), a = 12 * 400 / 2e5;
  CAPTURE(sagging, stiff);
  CHECK(sagging / stiff == Approx(1 / std::sqrt((1 - a) * (1 - 2 * a))).margin(0.005));
}
