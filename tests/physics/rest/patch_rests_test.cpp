// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>
#include <cmath>

#include "physics/rest/settle.h"
#include "tests/cases/cusick.h"
#include "tests/cases/slit_annulus.h"

using namespace furrow::physics;
using namespace furrow::cases;

TEST_CASE(
    "patches: the slit annulus is lifted as shell elements are to 0.4 %, triangles are 1 to 3.5 % stiffer",
    "[release]") {
  for (const SheetKind kind :
       {SheetKind::one_diagonal, SheetKind::by_row, SheetKind::union_jack, SheetKind::cut_jittered}) {
    SlitAnnulus patched = slit_annulus(kind, 60, 10, true), plain = slit_annulus(kind, 60, 10, false);
    for (const AnnulusLift& wanted : annulus_lifts) {
      const AnnulusRest ours = lift(patched, wanted.share), locked = lift(plain, wanted.share);
      CAPTURE(name_of(kind), wanted.share);
      CHECK(ours.converged);
      CHECK(ours.inner == Approx(wanted.inner).epsilon(4e-3));
      CHECK(ours.outer == Approx(wanted.outer).epsilon(4e-3));
      CHECK(locked.inner / wanted.inner < 0.99);
      CHECK(locked.inner / wanted.inner > 0.965);
    }
  }
}

TEST_CASE("patches: a fine mesh of triangles comes to the same lifts", "[release]") {
  for (const SheetKind kind : {SheetKind::equilateral, SheetKind::jittered}) {
    SlitAnnulus coarse = slit_annulus(kind, 60, 10, true), fine = slit_annulus(kind, 120, 20, true);
    for (const AnnulusLift& wanted : annulus_lifts) {
      CAPTURE(name_of(kind), wanted.share);
      CHECK(lift(coarse, wanted.share).inner == Approx(wanted.inner).epsilon(1e-2));
      CHECK(lift(fine, wanted.share).inner == Approx(wanted.inner).epsilon(2e-3));
    }
  }
}

TEST_CASE("cusick: stiff cloth on patches drapes on 40 rings as on many, on triangles it is held up",
          "[release]") {
  const auto drape = [](bool patches, double jitter) {
    CusickOptions options;
    options.rings = 40;
    options.young = 20000;
    options.bending_length = 0.0131;
    options.plate = true;
    options.patches = patches;
    options.jitter = jitter;  // 7 folds at the start: the lowest energy of 6, 7 and 8
    Cusick specimen = cusick_specimen(options);
    SettleOptions settling;
    settling.gravity = {0, 0, -cusick_gravity};
    settling.max_iterations = 1000;
    CHECK(settle(specimen.cloth, nullptr, settling).converged);
    return drape_coefficient(specimen);
  };
  CHECK(drape(true, 0) == Approx(0.45).margin(0.04));
  CHECK(drape(true, 0.2) == Approx(0.45).margin(0.04));
  CHECK(drape(false, 0) > 0.52);
  CHECK(drape(false, 0.2) > 0.57);
}
