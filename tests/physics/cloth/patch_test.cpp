// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/cases/patch_test.h"

#include <catch2/catch.hpp>

#include "tests/cases/flat_meshes.h"

using namespace furrow::physics;
using namespace furrow::cases;

namespace {

const Carrier constant_strain = std::nullopt;

Cloth square(double jitter, std::uint64_t seed = 1) {
  return triangular_sheet(1, 1, 26, equilateral_rows(1, 1, 26), 0.1, jitter, seed);
}

/// The mean over seeds 1 to `seeds`.
PatchScore mean_score(double jitter, const Carrier& carrier, int seeds) {
  PatchScore mean{};
  const auto add = [&](PatchAnswer& to, const PatchAnswer& a) {
    to.energy += a.energy / seeds;
    to.non_affine += a.non_affine / seeds;
  };
  for (int seed = 1; seed <= seeds; ++seed) {
    const PatchScore s = patch_test(square(jitter, seed), 26, carrier);
    add(mean.dilation, s.dilation);
    add(mean.stretch, s.stretch);
    add(mean.slide, s.slide);
    mean.dt_limit += s.dt_limit / seeds;
  }
  return mean;
}

/// Means of three other seeds, by an independent program (numpy).
struct Reference {
  MembraneLaw law;
  double jitter, non_affine, dilation, stretch, slide, dt_limit;
};
const Reference references[] = {
    {MembraneLaw::paper, 0.1, 0.8058, 0.9379, 0.9840, 0.9483, 0.5072},
    {MembraneLaw::uniform, 0.1, 0.4884, 0.9693, 1.0068, 0.9574, 0.4706},
    {MembraneLaw::inverse, 0.1, 0.3126, 0.9887, 1.0202, 0.9565, 0.4232},
    {MembraneLaw::van_gelder, 0.1, 0.2624, 0.9917, 0.9967, 0.9750, 0.4387},
    {MembraneLaw::paper, 0.2, 1.2286, 0.7863, 0.9018, 0.8696, 0.4838},
    {MembraneLaw::uniform, 0.2, 1.0094, 0.8851, 0.9573, 0.9117, 0.4306},
    {MembraneLaw::inverse, 0.2, 0.7671, 0.9526, 0.9829, 0.9240, 0.3407},
    {MembraneLaw::van_gelder, 0.2, 0.6951, 0.9634, 0.9565, 0.9399, 0.3625},
    {MembraneLaw::paper, 0.3, 2.1408, 0.6379, 0.8033, 0.7767, 0.4516},
    {MembraneLaw::uniform, 0.3, 1.6661, 0.7933, 0.8928, 0.8514, 0.3772},
    {MembraneLaw::inverse, 0.3, 1.3085, 0.9092, 0.9300, 0.8757, 0.2682},
    {MembraneLaw::van_gelder, 0.3, 1.2808, 0.9263, 0.9005, 0.8889, 0.2940},
};

}  // namespace

TEST_CASE("patch test: triangles of constant strain are an exact membrane on any mesh", "[release]") {
  const Cloth sheets[] = {square(0), square(0.2, 2), square(0.3, 3), right_sheet(1, 1, 26, 26),
                          right_sheet(1, 1, 26, 26, 0.1, true)};
  for (const Cloth& sheet : sheets) {
    const PatchScore score = patch_test(sheet, 26, constant_strain);
    for (const PatchAnswer& a : {score.dilation, score.stretch, score.slide}) {
      CHECK(a.non_affine < 1e-10);
      CHECK(std::abs(a.energy - 1) < 1e-10);
    }
  }
  CHECK(mean_score(0.2, constant_strain, 10).dt_limit == Approx(0.3214).epsilon(0.05));
}

TEST_CASE("patch test: on regular meshes springs score as an independent program says, to its digits",
          "[release]") {
  const auto agrees = [](const PatchScore& s, const std::array<double, 5>& r) {
    CHECK(s.dilation.non_affine == Approx(r[0]).epsilon(1e-9).margin(1e-11));
    CHECK(s.dilation.energy == Approx(r[1]).epsilon(1e-9));
    CHECK(s.stretch.energy == Approx(r[2]).epsilon(1e-9));
    CHECK(s.slide.energy == Approx(r[3]).epsilon(1e-9));
    CHECK(s.dt_limit == Approx(r[4]).epsilon(1e-7));
  };
  agrees(patch_test(square(0), 26, MembraneLaw::uniform),
         {0.240759876922, 0.998536035861, 1.02386053687, 0.973211534849, 0.491599681051});
  agrees(patch_test(square(0), 26, MembraneLaw::paper),
         {0.475536219278, 0.995677886632, 1.01399076024, 0.977365013021, 0.523626479308});
  agrees(patch_test(square(0), 26, MembraneLaw::inverse),
         {0, 1, 1.03278400107, 0.967215998929, 0.461327527071});
  agrees(patch_test(square(0), 26, MembraneLaw::van_gelder),
         {0.0846153255215, 0.999733948186, 1.01021527393, 0.986976583977, 0.518236650812});
  agrees(patch_test(square(0), 26, constant_strain), {0, 1, 1, 1, 0.470408545592});
  agrees(patch_test(right_sheet(1, 1, 26, 26), 26, MembraneLaw::paper),
         {0, 1, 0.846799103647, 1.15320089635, 0.76204843022});
  agrees(patch_test(right_sheet(1, 1, 26, 26), 26, MembraneLaw::van_gelder),
         {0, 1, 4.0 / 3, 2.0 / 3, 0.863654105176});
}

TEST_CASE("patch test: on jittered meshes each law is as soft as it is known to be", "[release]") {
  for (const Reference& r : references) {
    const PatchScore score = mean_score(r.jitter, r.law, 10);
    CAPTURE(int(r.law), r.jitter);
    CHECK(score.dilation.energy == Approx(r.dilation).epsilon(0.03));
    CHECK(score.stretch.energy == Approx(r.stretch).epsilon(0.03));
    CHECK(score.slide.energy == Approx(r.slide).epsilon(0.03));
    CHECK(score.dilation.non_affine == Approx(r.non_affine).epsilon(0.15));
    CHECK(score.dt_limit == Approx(r.dt_limit).epsilon(0.15));
  }
}
