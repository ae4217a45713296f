// SPDX-License-Identifier: GPL-3.0-or-later
#include "bridge/draping/fit_piercing.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <stdexcept>

#include "bridge/arrays/convert.h"
#include "bridge/draping/fit_report.h"
#include "tests/bridge/test_body.h"
#include "tests/test_meshes.h"

using namespace furrow;
using namespace furrow::tests;

namespace {

bridge::FitPiercing measure(const geometry::Mesh& garment, const Body& body) {
  std::vector<double> distances;
  for (const physics::Vec3& x : bridge::positions_of(garment))
    distances.push_back(body.distance.sample(x).value);
  return bridge::measure_piercing(garment, body.triangles, body.distance, distances);
}

}  // namespace

TEST_CASE("fit_piercing: two faces that cut a ball without a vertex in it are as deep as their middle",
          "[long]") {
  const Body ball(icosphere(5, 0.3));
  geometry::Mesh sheet = grid(1, 1, 2, 2);
  for (const double height : {0.1, 0.25, 0.29}) {
    for (auto v : sheet.vertices())
      sheet.point(v) = {2.0 * (v.idx() % 2) - 1, height, 2.0 * double(v.idx() / 2) - 1};
    const bridge::FitPiercing p = measure(sheet, ball);
    CHECK(p.faces == 2);
    CHECK(p.deepest == Approx(0.3 - height).margin(0.0005));
    REQUIRE(p.zones.size() == 1);
    CHECK(p.zones[0].peak == p.deepest);
    CHECK(p.zones[0].area == Approx(4));
    geometry::Mesh garment = sheet;
    const bridge::FitReport r = bridge::fit_report(garment, ball.triangles, ball.distance);
    CHECK(r.distance.vertices_inside == 0);
    CHECK(r.distance.min > 0);
    CHECK(r.distance.deepest_penetration == p.deepest);
    CHECK(r.piercing.faces == 2);
    REQUIRE(r.piercing.zones.size() == 1);
    CHECK(r.piercing.zones[0].height_share == Approx((height + 0.3) / 0.6).epsilon(1e-6));
  }
}

TEST_CASE(
    "fit_piercing: the corners told are those of the faces that the body comes through, and of no others") {
  const Body ball(icosphere(4, 0.3));
  geometry::Mesh sheet = grid(6, 6, 3, 3);  // the ball is 0.33 m wide at the sheet's height
  for (auto v : sheet.vertices()) {
    const geometry::Point p = sheet.point(v);
    sheet.point(v) = {p.x() - 1.5, 0.25, p.y() - 1.5};
  }
  std::vector<std::size_t> around;
  for (auto v : sheet.vertices()) {
    const geometry::Point& p = sheet.point(v);
    if (std::abs(p.x()) > 1e-9 || std::abs(p.z()) > 1e-9) continue;
    around.push_back(v.idx());
    for (auto n : sheet.vertices_around_target(sheet.halfedge(v))) around.push_back(n.idx());
  }
  std::sort(around.begin(), around.end());
  REQUIRE(around.size() == 7);
  const bridge::FitPiercing p = measure(sheet, ball);
  CHECK(p.faces == 6);
  CHECK(p.corners == around);
  for (auto v : sheet.vertices()) sheet.point(v) = sheet.point(v) + geometry::Vector(0, 0.1, 0);
  CHECK(measure(sheet, ball).corners.empty());
  CHECK(measure(icosphere(1, 0.2), ball).corners.size() == icosphere(1, 0.2).num_vertices());
}

TEST_CASE(
    "fit_piercing: a garment outside is not pierced, one wholly inside neither, but its depth and its zone "
    "are told") {
  const Body ball(icosphere(4, 0.3));
  const bridge::FitPiercing outside = measure(icosphere(3, 0.31), ball);
  CHECK(outside.faces == 0);
  CHECK(outside.deepest == 0);
  CHECK(outside.zones.empty());
  const bridge::FitPiercing inside = measure(icosphere(3, 0.2), ball);
  CHECK(inside.faces == 0);
  CHECK(inside.deepest == Approx(0.1).epsilon(0.02));
  CHECK(inside.zones.size() == 1);
  CHECK_THROWS_AS(bridge::measure_piercing(icosphere(1, 1), ball.triangles, ball.distance, {}),
                  std::invalid_argument);
}
