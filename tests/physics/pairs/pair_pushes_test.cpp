// SPDX-License-Identifier: GPL-3.0-or-later
#include "physics/pairs/pair_pushes.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "physics/pairs/edge_face_crossings.h"
#include "tests/physics/motion/stacked_sheets.h"

using namespace furrow::physics;
using namespace furrow::tests;

namespace {

constexpr double sheet_thickness = 1e-3;  // m

/// A sheet, and a smaller one over it.
struct SheetOverSheet {
  Cloth cloth = level_sheet(0.1, 5, 0, 0, 3);
  std::size_t lower = cloth.particles.size();
  std::vector<double> mobility;
  explicit SheetOverSheet(double apart) {
    put_over(cloth, level_sheet(0.08, 4, apart, 0.01, 4));
    mobility.assign(cloth.particles.size(), 1);
  }
  /// Where a move leads; the lower sheet goes the other way.
  std::vector<Vec3> moved(const Vec3& upper) const {
    std::vector<Vec3> x = cloth.particles.x;
    for (std::size_t i = 0; i < x.size(); ++i) x[i] += i < lower ? Vec3(-upper) : upper;
    return x;
  }
  /// The sums of what the lower and the upper one have.
  std::array<Vec3, 2> sums(const std::vector<Vec3>& of) const {
    std::array<Vec3, 2> sum{Vec3::Zero(), Vec3::Zero()};
    for (std::size_t i = 0; i < of.size(); ++i) sum[i >= lower] += of[i];
    return sum;
  }
};

std::vector<Vec3> change(const std::vector<Vec3>& from, const std::vector<Vec3>& to) {
  std::vector<Vec3> way(from.size());
  for (std::size_t i = 0; i < way.size(); ++i) way[i] = to[i] - from[i];
  return way;
}

}  // namespace

TEST_CASE("pair_pushes: what meets is pushed apart, equal and opposite, and rubs within Coulomb's cone") {
  const SheetOverSheet two(1.1 * sheet_thickness);
  const std::vector<Vec3>& start = two.cloth.particles.x;
  for (const double friction : {0.0, 0.1, 1.0}) {
    PairPushOptions options;
    options.friction = friction;
    options.lasting = true;
    PairPushes pushes(two.cloth, start, options, nullptr);
    const std::vector<Vec3> asked = two.moved({6e-5, 0, -4e-4});
    std::vector<Vec3> x = asked;
    REQUIRE(pushes.begin_step(start, x, nullptr));
    bool again = true;
    for (int k = 0; k < 500; ++k) again = pushes.sweep(x, two.mobility);
    CHECK_FALSE(again);
    const auto [down, up] = two.sums(change(asked, x));
    CAPTURE(friction, up.transpose(), down.transpose());
    CHECK((up + down).norm() < 1e-12);
    CHECK(up.z() > 5e-3);
    if (friction == 0) CHECK(std::abs(up.x()) < 0.01 * up.z());
    if (friction == 0.1) CHECK(-up.x() == Approx(0.1 * up.z()).epsilon(0.05));
    if (friction == 1) CHECK(-up.x() < 0.5 * up.z());
    const PairPushes::Touching touching = pushes.touching(x);
    CHECK(touching.pairs > 20);
    CHECK(touching.nearest == Approx(0.99 * sheet_thickness).epsilon(0.01));
    if (friction == 0.1) CHECK(touching.sliding > 10);
    if (friction == 0) CHECK(touching.sliding == 0);
    if (friction == 1) CHECK(touching.sliding < 0.2 * touching.pairs);
    CHECK(pushes.guard(x, two.mobility, nullptr).empty());
    std::vector<Vec3> force(x.size(), Vec3::Zero());
    pushes.add_reactions(x, two.mobility, 50, force);
    const auto [below, above] = two.sums(force);
    CHECK((below + above).norm() < 1e-11);
    CHECK((above - 50 * up).norm() < 0.05 * above.norm());
  }
}

TEST_CASE("pair_pushes: pushes that last begin the next step, and are forgotten where the pair parts") {
  const SheetOverSheet two(1.1 * sheet_thickness);
  PairPushOptions options;
  options.lasting = true;
  PairPushes pushes(two.cloth, two.cloth.particles.x, options, nullptr);
  const std::vector<Vec3> down = two.moved({0, 0, -1e-4});
  std::vector<Vec3> x = down;
  REQUIRE(pushes.begin_step(two.cloth.particles.x, x, nullptr));
  for (int k = 0; k < 500; ++k) pushes.sweep(x, two.mobility);
  const std::vector<Vec3> before = x;
  std::vector<Vec3> reaction(x.size(), Vec3::Zero());
  pushes.add_reactions(x, two.mobility, 1, reaction);
  for (std::size_t i = 0; i < x.size(); ++i)
    x[i] += reaction[i] + (i < two.lower ? 0.5e-4 : -0.5e-4) * Vec3::UnitZ();
  pushes.begin_step(before, x, nullptr);
  pushes.sweep(x, two.mobility);
  std::vector<Vec3> next(x.size(), Vec3::Zero());
  pushes.add_reactions(x, two.mobility, 1, next);
  CHECK(two.sums(next)[1].z() > 0.3 * two.sums(reaction)[1].z());
  const std::vector<Vec3> apart = two.moved({0, 0, 1e-3});
  std::vector<Vec3> none(x.size(), Vec3::Zero());
  pushes.add_reactions(apart, two.mobility, 1, none);
  pushes.add_reactions(x, two.mobility, 1, none);
  CHECK(two.sums(none)[1] == Vec3::Zero());
}

TEST_CASE("pair_pushes: the guard cuts what would pass through cloth, and only that") {
  const SheetOverSheet two(2 * sheet_thickness);
  const std::vector<Vec3>& start = two.cloth.particles.x;
  PairPushes pushes(two.cloth, start, {}, nullptr);
  std::vector<Vec3> x = two.moved({0, 0, -2e-3});
  pushes.begin_step(start, x, nullptr);
  const std::vector<int> cut = pushes.guard(x, two.mobility, nullptr);
  CHECK(std::is_sorted(cut.begin(), cut.end()));
  CHECK(cut.size() > two.cloth.particles.size() - two.lower);
  double bottom = 1;  // of the upper one, which meets the other half-way
  for (std::size_t i = two.lower; i < x.size(); ++i) bottom = std::min(bottom, x[i].z());
  CHECK(bottom > sheet_thickness);
  CHECK(bottom < start.back().z());
  CHECK(edge_face_crossings(pushes.contact().mesh(), x).empty());
  std::vector<Vec3> free = two.moved({0, 0, 2e-3});
  const std::vector<Vec3> wanted = free;
  pushes.begin_step(start, free, nullptr);
  CHECK(pushes.guard(free, two.mobility, nullptr).empty());
  CHECK(free == wanted);
}

TEST_CASE("pair_pushes: depth is made up by a share of what is missing, and what is held does not move") {
  const SheetOverSheet two(0.5 * sheet_thickness);
  std::vector<Vec3> x = two.cloth.particles.x;
  PairPushOptions options;
  options.lasting = true;
  PairPushes pushes(two.cloth, x, options, nullptr);
  while (pushes.contact().widen(x)) {
  }
  std::vector<double> mobility = two.mobility;
  std::fill(mobility.begin(), mobility.begin() + std::ptrdiff_t(two.lower), 0.0);
  const std::vector<Vec3> start = x;
  pushes.begin_step(start, x, nullptr);
  CHECK(pushes.recover(x, mobility, 0.1) == Approx(0.49).epsilon(0.01));
  const auto [below, above] = two.sums(change(start, x));
  CHECK(below == Vec3::Zero());
  CHECK(above.z() > 1e-4);
  double missing = 1;
  for (int k = 0; k < 100; ++k) {
    pushes.begin_step(x, x, nullptr);
    missing = pushes.recover(x, mobility, 0.1);
  }
  CHECK(missing < 0.01);
}
