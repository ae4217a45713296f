// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <numeric>

#include "physics/cloth/join_cloths.h"
#include "physics/cloth/pins.h"
#include "physics/pairs/edge_face_crossings.h"
#include "physics/rest/settle.h"
#include "tests/cases/flat_meshes.h"
#include "tests/physics/body/test_bodies.h"
#include "tests/physics/cloth/test_cloths.h"

using namespace furrow::physics;
using namespace furrow::tests;
namespace cases = furrow::cases;

namespace {

constexpr double thick = 1e-3;  // m
const Sphere under_sheets(Vec3(0, 0, -0.1), 0.1);

/// Soft, as this scheme needs many passes for what is stiff; in the plane z = height, its middle on the axis.
Cloth soft_sheet(double width, int columns, double height, std::uint64_t seed) {
  Cloth cloth = cases::triangular_sheet(width, width, columns, cases::equilateral_rows(width, width, columns),
                                        0.12, 0.15, seed);
  cloth.structural.clear();
  cases::add_flat_membrane(cloth, 2);
  cases::add_flat_hinges(cloth, 1e-7);
  for (Vec3& x : cloth.particles.x) x = Vec3(x.x() - width / 2, x.y() - width / 2, height);
  return cloth;
}

Cloth held(Cloth cloth) {
  std::vector<int> all(cloth.particles.size());
  std::iota(all.begin(), all.end(), 0);
  pin(cloth.particles, all);
  return cloth;
}

/// Over the ball.
Cloth falling_pair() {
  return join_cloths(std::vector{soft_sheet(0.06, 5, 0.005, 3), soft_sheet(0.054, 4, 0.007, 4)});
}

DisplaceOptions on_cloth() {
  DisplaceOptions options;
  options.gravity = {0, 0, -9.81};
  options.tolerance = 0.01;
  options.self.on = true;
  return options;
}

int edges_through(const Cloth& cloth) {
  return int(edge_face_crossings(pair_mesh(cloth, thick), cloth.particles.x).size());
}

/// The most edges through faces in any pass, each 50th without contact.
int most_crossings(Cloth& cloth, const Collider* body, const DisplaceOptions& options,
                   DisplaceReport& report) {
  int most = 0;
  report = displace_by_force(cloth, body, options, [&](const SettleProgress& now) {
    if (options.self.on || now.iteration % 50 == 0) most = std::max(most, edges_through(cloth));
    return true;
  });
  return most;
}

double farthest(const std::vector<Vec3>& a, const std::vector<Vec3>& b) {
  double most = 0;
  for (std::size_t i = 0; i < a.size(); ++i) most = std::max(most, (a[i] - b[i]).norm());
  return most;
}

struct Slide {
  DisplaceReport report;
  double way = 0, expected = 0;  ///< mean of the sheet [m]; as Coulomb has it
};

/// Of a sheet on one that is held; slope: over the friction of 0.3.
Slide slide(double slope) {
  Cloth cloth = held(soft_sheet(0.2, 10, 0, 5));
  const std::size_t n = cloth.particles.size();
  cloth = join_cloths(std::vector{cloth, soft_sheet(0.06, 5, 0.99 * thick, 6)});
  const Cloth start = cloth;
  const double angle = std::atan(0.3 * slope);
  DisplaceOptions options = on_cloth();
  options.gravity = 9.81 * Vec3(std::sin(angle), 0, -std::cos(angle));
  options.max_passes = 3000;
  Slide slid;
  slid.report = displace_by_force(cloth, nullptr, options);
  double mass = 0;
  for (std::size_t i = n; i < cloth.particles.size(); ++i) {
    slid.way += (cloth.particles.x[i] - start.particles.x[i]).x() / double(cloth.particles.size() - n);
    mass += cloth.particles.mass[i] / double(cloth.particles.size() - n);
  }
  slid.expected =
      slid.report.passes * slid.report.rate * mass * 9.81 * (std::sin(angle) - 0.3 * std::cos(angle));
  return slid;
}

}  // namespace

TEST_CASE("displace_by_force: two sheets that fall on a ball rest a thickness apart, and no pass crosses",
          "[displace][long]") {
  Cloth cloth = falling_pair(), without = cloth;
  DisplaceOptions options = on_cloth();
  options.tolerance = 0.002;
  DisplaceReport report;
  CHECK(most_crossings(cloth, &under_sheets, options, report) == 0);
  CHECK(report.outcome == DisplaceOutcome::converged);
  CHECK(report.residual <= options.tolerance);
  CHECK(report.self.acted);
  CHECK(report.self.pairs > 20);
  CHECK(report.self.nearest > 0.95 * thick);
  CHECK(report.self.nearest <= thick);
  CHECK(report.self.crossed_at_start == 0);
  Cloth later = cloth;  // what rests stays
  options.tolerance = 1e-9;
  options.max_passes = 1000;
  displace_by_force(later, &under_sheets, options);
  CHECK(farthest(later.particles.x, cloth.particles.x) < 5e-5);  // its weight would take it 3 mm
  options = on_cloth();
  options.self.on = false;
  CHECK(most_crossings(without, &under_sheets, options, report) > 50);
  CHECK(report.self.pairs == 0);
  CHECK_FALSE(report.self.cut_moves);
}

TEST_CASE("displace_by_force: a sheet on an incline of cloth sticks or slides as Coulomb says",
          "[displace][long]") {
  const Slide stuck = slide(0.9), sliding = slide(1.2);
  CHECK(stuck.report.outcome == DisplaceOutcome::converged);
  CHECK(std::abs(stuck.way) < 1e-5);
  CHECK(stuck.report.self.sliding == 0);
  CHECK(sliding.report.outcome == DisplaceOutcome::unfinished);
  CHECK(sliding.way == Approx(sliding.expected).epsilon(0.02));
  CHECK(sliding.report.self.sliding > 20);
}

TEST_CASE("displace_by_force: with contact of cloth, where nothing is near, every bit is the same",
          "[displace]") {
  const Sphere low(Vec3(0, 0, -0.12), 0.1);
  Cloth a = soft_sheet(0.06, 5, 0, 3), b = a;
  pin(a.particles, std::vector<int>{0});
  pin(b.particles, std::vector<int>{0});
  DisplaceOptions options = on_cloth();
  options.max_passes = 2000;
  const DisplaceReport with = displace_by_force(a, &low, options);
  options.self.on = false;
  const DisplaceReport without = displace_by_force(b, &low, options);
  CHECK(with.self.list_builds > 0);
  CHECK_FALSE(with.self.acted);
  CHECK(a.particles.x == b.particles.x);
  CHECK(with.residual == without.residual);
  CHECK(with.capped == without.capped);
}

TEST_CASE("displace_by_force: with contact of cloth, the same bits for any number of threads",
          "[displace][long]") {
  Cloth a = falling_pair(), b = a;
  DisplaceOptions options = on_cloth();
  options.max_passes = 1500;
  const DisplaceReport one = displace_by_force(a, &under_sheets, options);
  options.threads = 2;
  displace_by_force(b, &under_sheets, options);
  CHECK(one.self.pairs > 5);
  CHECK(a.particles.x == b.particles.x);
}

TEST_CASE("displace_by_force: a sheet without room between two held ones is not said to rest",
          "[displace][long]") {
  const std::vector<Cloth> layers{held(soft_sheet(0.06, 5, 0, 3)), soft_sheet(0.05, 4, 0.4 * thick, 4),
                                  held(soft_sheet(0.06, 6, 0.8 * thick, 5))};
  Cloth cloth = join_cloths(layers);
  DisplaceOptions options = on_cloth();
  options.max_passes = 3000;
  DisplaceReport report;
  CHECK(most_crossings(cloth, nullptr, options, report) == 0);
  CHECK(report.outcome != DisplaceOutcome::converged);
  CHECK(report.outcome != DisplaceOutcome::diverged);
  CHECK(*report.self.cut_moves > 1000);  // sweeps find no place, so that the guard has to act
  CHECK(report.self.cut_searches > 100);
}

TEST_CASE("displace_by_force: springs to what is held pull a sheet onto a held one, and not through it",
          "[displace][long]") {
  Cloth cloth = held(soft_sheet(0.08, 6, 0, 3));
  const int n = int(cloth.particles.size());
  cloth = join_cloths(std::vector{cloth, soft_sheet(0.05, 4, 2 * thick, 4)});
  const int last = int(cloth.particles.size());
  const double weight = 9.81 * cloth.particles.mass[std::size_t(n)];
  for (int i = n; i < last; i += 3) {
    add_particle(cloth, cloth.particles.x[std::size_t(i)] - Vec3(0, 0, 0.05), 1);
    const int end = int(cloth.particles.size()) - 1;
    cloth.particles.inv_mass[std::size_t(end)] = 0;
    cloth.structural.push_back({i, end, 0.01, 200 * weight});  // pulls with eight weights
  }
  Cloth without = cloth;
  DisplaceOptions options = on_cloth();
  DisplaceReport report;
  CHECK(most_crossings(cloth, nullptr, options, report) == 0);
  CHECK(report.outcome == DisplaceOutcome::converged);  // the pairs bear what pulls
  CHECK(report.self.pairs > 20);
  for (int i = n; i < last; ++i) CHECK(cloth.particles.x[std::size_t(i)].z() > 0.9 * thick);
  options.self.on = false;
  displace_by_force(without, nullptr, options);
  CHECK(without.particles.x[std::size_t(n)].z() < -thick);
}

TEST_CASE("displace_by_force: with contact of cloth, what diverges is told", "[displace]") {
  Cloth cloth = falling_pair();
  DisplaceOptions options = on_cloth();
  options.cap = false;
  options.rate = 100 * displacement_rate(cloth, options.gravity, options.gap);
  std::vector<Vec3>& x = cloth.particles.x;
  *std::min_element(x.begin(), x.end(), [](const Vec3& a, const Vec3& b) {
    return a.head<2>().norm() + a.z() < b.head<2>().norm() + b.z();
  }) += Vec3(0, 0, 4e-3);  // the middle of the lower sheet goes through the upper one
  const DisplaceReport report = displace_by_force(cloth, &under_sheets, options);
  CHECK(report.outcome == DisplaceOutcome::diverged);
  CHECK(report.self.crossed_at_start > 0);
}

TEST_CASE("displace_by_force: contact of cloth needs triangles and options within their range",
          "[displace]") {
  Cloth cloth = soft_sheet(0.06, 5, 0, 3);
  const std::vector<Vec3> before = cloth.particles.x;
  DisplaceOptions options = on_cloth();
  options.self.thickness = 0;
  CHECK_THROWS_WITH(displace_by_force(cloth, nullptr, options), Catch::Contains("thickness"));
  options.self = {true, thick, -0.1};
  CHECK_THROWS_WITH(displace_by_force(cloth, nullptr, options), Catch::Contains("friction"));
  options.self = {true, thick, 0.1};
  options.threads = 0;
  CHECK_THROWS_WITH(displace_by_force(cloth, nullptr, options), Catch::Contains("threads"));
  options.threads = 1;
  cloth.triangles.clear();
  CHECK_THROWS_WITH(displace_by_force(cloth, nullptr, options), Catch::Contains("triangles"));
  CHECK(cloth.particles.x == before);
}
