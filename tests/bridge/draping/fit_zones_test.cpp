// SPDX-License-Identifier: GPL-3.0-or-later
#include "bridge/draping/fit_zones.h"

#include <catch2/catch.hpp>
#include <stdexcept>

#include "tests/test_meshes.h"

using namespace furrow;
using namespace furrow::tests;

TEST_CASE(
    "fit_zones: two patches over a threshold are two zones, the larger first, and a tiny one is left out") {
  const geometry::Mesh sheet = grid(20, 20);  // cells of 0.05 m
  std::vector<double> values(sheet.num_vertices(), 0.0);
  const auto raise = [&](double x0, double x1, double y0, double y1, double value) {
    for (auto v : sheet.vertices()) {
      const auto& p = sheet.point(v);
      if (p.x() > x0 - 1e-9 && p.x() < x1 + 1e-9 && p.y() > y0 - 1e-9 && p.y() < y1 + 1e-9)
        values[v.idx()] = value;
    }
  };
  raise(0.1, 0.4, 0.1, 0.3, 1);
  raise(0.6, 0.9, 0.5, 0.9, 1);
  raise(0.1, 0.1, 0.8, 0.8, 5);
  // At a threshold just under the value a face is in if all its corners are.
  const bridge::FitZones found = bridge::fit_zones(sheet, values, 0.99, 0.01);
  REQUIRE(found.zones.size() == 2);
  CHECK(found.zones[0].area == Approx(0.12).epsilon(1e-9));
  CHECK(found.zones[0].peak == 1);
  CHECK(found.zones[0].centre.x() == Approx(0.75).margin(1e-9));
  CHECK(found.zones[0].centre.y() == Approx(0.7).margin(1e-9));
  CHECK(found.zones[1].area == Approx(0.06).epsilon(1e-9));
  CHECK(found.zones[1].centre.x() == Approx(0.25).margin(1e-9));
  CHECK(found.zones[1].centre.y() == Approx(0.2).margin(1e-9));
  CHECK(found.left_out == 1);
  CHECK(bridge::fit_zones(sheet, values, 0.99, 0).zones.size() == 3);
  CHECK(bridge::fit_zones(sheet, values, 10, 0).zones.empty());
  CHECK_THROWS_AS(bridge::fit_zones(sheet, {1, 2}, 0, 0), std::invalid_argument);
}

TEST_CASE("fit_zones: zones that meet in a corner only are two") {
  const geometry::Mesh sheet = grid(2, 2);
  // Vertex (i, j) is i + 3 j: over the threshold are the lower left and the upper right cell's outer faces.
  std::vector<double> values(sheet.num_vertices(), 0.0);
  values[0] = values[8] = 3.5;
  const bridge::FitZones found = bridge::fit_zones(sheet, values, 1, 0);
  CHECK(found.zones.size() == 2);
}
