// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>

#include "physics/linear/free_stiffness.h"
#include "physics/rest/settle.h"
#include "tests/cases/flat_meshes.h"
#include "tests/cases/layered.h"

using namespace furrow::physics;
namespace cases = furrow::cases;

namespace {

void check_all(const cases::LayeredCase& c) {
  CHECK(c.rests);
  CHECK(c.crossings == 0);
  CHECK_FALSE(c.numbers.empty());
  for (const cases::LayeredNumber& n : c.numbers) {
    INFO(n.what << ": " << n.found << " for " << n.answer);
    CHECK(n.holds());
  }
}

void check_all_but_numbers(const cases::LayeredCase& c) {
  CHECK(c.rests);
  CHECK(c.crossings == 0);
}

}  // namespace

TEST_CASE("settle: sheets in a stack bear the weight of all above, by 1 or 2 threads", "[long]") {
  check_all(cases::stacked_sheets(1, 12));
  const cases::LayeredCase one = cases::stacked_sheets(3, 9);
  check_all(one);
  CHECK(cases::stacked_sheets(3, 9, 2).x == one.x);
}

TEST_CASE("settle: a pair is pressed to where its barrier balances the load") {
  for (const bool edges : {false, true})
    for (const double load : {0.01, 0.25, 1.0}) check_all(cases::pressed_pair(edges, load));
}

TEST_CASE("settle: a sheet on a sheet stays on an incline as steep as friction bears, and no steeper",
          "[release]") {
  CHECK(cases::on_incline(0.98, 16).rests);
  CHECK_FALSE(cases::on_incline(1.02, 16).rests);
}

TEST_CASE("settle: a sheet between two is pulled out by what friction bears on both its sides", "[release]") {
  check_all_but_numbers(cases::pulled_sheet(0.97, 20));
  CHECK_FALSE(cases::pulled_sheet(1.03, 20).rests);
}

TEST_CASE("settle: a strip over a sleeve holds the length of the heavy capstan", "[release]") {
  check_all_but_numbers(cases::capstan_on_sleeve(0.96, 48));
  CHECK_FALSE(cases::capstan_on_sleeve(1.04, 48).rests);
}

TEST_CASE("settle: a strip folded over onto itself is as high as the heavy elastica", "[release]") {
  check_all(cases::heavy_fold(0.025, 8));
}

TEST_CASE("settle: the end of a coil in a tube touches at the angle and with the force of the elastica",
          "[release]") {
  check_all(cases::coil_in_tube(48));
}

TEST_CASE("settle: the friction of cloth is not below 0, and sheets that coincide keep their numbers") {
  Cloth cloth = cases::right_sheet(0.1, 0.1, 4, 4);
  cloth.structural.clear();
  cases::add_flat_membrane(cloth, 450);
  const int n = int(cloth.particles.size());
  const Cloth once = cloth;
  for (int i = 0; i < n; ++i) {
    cloth.particles.x.push_back(once.particles.x[std::size_t(i)]);
    cloth.particles.v.push_back(Vec3::Zero());
    cloth.particles.mass.push_back(once.particles.mass[std::size_t(i)]);
    cloth.particles.inv_mass.push_back(i == 0 ? 0 : once.particles.inv_mass[std::size_t(i)]);
  }
  cloth.particles.inv_mass[0] = 0;
  for (auto t : once.triangles) cloth.triangles.push_back({t[0] + n, t[1] + n, t[2] + n});
  for (auto t : once.membrane) {
    for (int& v : t.vertices) v += n;
    cloth.membrane.push_back(t);
  }
  SettleOptions options;
  options.self.on = true;
  options.max_iterations = 20;
  options.self.friction = -0.1;
  CHECK_THROWS_AS(settle(cloth, nullptr, options), std::invalid_argument);
  options.self.friction = 0.3;
  const SettleReport report = settle(cloth, nullptr, options);
  CHECK(report.self.crossed_at_start > 0);
  for (const Vec3& x : cloth.particles.x) CHECK(x.allFinite());
}
