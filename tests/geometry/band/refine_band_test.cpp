// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/band/refine_band.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "geometry/mesh/edge_metric.h"
#include "geometry/mesh/property_names.h"
#include "geometry/mesh/sheet.h"
#include "geometry/rest/rest_state.h"
#include "tests/geometry/band/band_checks.h"
#include "tests/test_meshes.h"

using namespace furrow::geometry;
using namespace furrow::tests;

namespace {

constexpr double width = 0.1, height = 0.015;

std::vector<Point> wave(double x0, double y0, double x1, double y1, double amplitude) {
  std::vector<Point> points;
  for (int i = 0; i <= 100; ++i) {
    const double t = i / 100.0, s = amplitude * std::sin(9 * t);
    points.push_back({x0 + t * (x1 - x0) - s * (y1 - y0), y0 + t * (y1 - y0) + s * (x1 - x0), 0});
  }
  return points;
}

void require_good(const Mesh& before, const Mesh& after, const std::vector<FoldCurve>& curves,
                  const BandReport& report) {
  CHECK(faults_of_band(before, after, curves, report) == std::vector<std::string>{});
  CHECK(report.min_angle_deg >= least_angle(report, curves[0].width[0], curves[0].height[0]));
}

}  // namespace

TEST_CASE("crest_edge: the rule of the sizing") {
  CHECK(crest_edge(0.1, 0, Detail::normal, 0.003) == Approx(0.1 / 8));
  CHECK(crest_edge(0.1, 0.016, Detail::normal, 0.003) == Approx(0.35 * 0.01 / (20 * 0.016)));
  CHECK(crest_edge(0.1, -0.06, Detail::normal, 0.003) == Approx(0.1 / 14));
  CHECK(crest_edge(0.1, 0.06, Detail::coarse, 0.003) == Approx(0.1 / 10));
  CHECK(crest_edge(0.03, 0.02, Detail::fine, 0.003) == 0.003);
}

TEST_CASE("BandSizing: fine in the band, growing by 0.35 beyond it") {
  const Mesh sheet = equilateral_sheet(0.6, 0.8, 0.05);
  const std::vector<FoldCurve> curves{curve_on(sheet, {{0, 0.2, 0}, {0, 0.6, 0}}, width, 0)};
  const BandSizing sizing(curves, Detail::normal, 0.003);
  const double h = width / 8;
  CHECK(sizing.at({0, 0.4, 0}, 1) == Approx(h));
  CHECK(sizing.at({0.055, 0.4, 0}, 1) == Approx(h));
  CHECK(sizing.at({0.155, 0.4, 0}, 1) == Approx(h + 0.035));
  CHECK(sizing.at({0.155, 0.4, 0}, 0.02) == 0.02);
  CHECK(sizing.at({0, 0.7, 0}, 1) == Approx(h + 0.35 * 0.045));
  CHECK(sizing.in_band({0.06, 0.4, 0}));
  CHECK_FALSE(sizing.in_band({0.07, 0.4, 0}));
}

TEST_CASE("BandSizing: finer where steep folds and the valley between them run over a border") {
  const Mesh sheet = equilateral_sheet(0.6, 0.8, 0.05);
  const double w = 0.12, steep = 0.08;
  std::vector<FoldCurve> curves{curve_on(sheet, {{0, 0.2, 0}, {0, 0.8, 0}}, w, steep),
                                curve_on(sheet, {{w, 0.2, 0}, {w, 0.8, 0}}, w, steep)};
  for (int i = 0; i < 2; ++i) curves[i].line = i, curves[i].ends_at_border = true;
  const double end = curves[0].points.back().y(), crest = w / 14, flank = w / 8;
  const auto at = [&](double x, double y) {
    return BandSizing(curves, Detail::normal, 0.003).at({x, y, 0}, 1);
  };
  CHECK(at(0, end) == Approx(w / 28));
  CHECK(at(w / 2, end) == Approx(w / 28));
  CHECK(at(0, end - 0.003) > w / 28 + 0.0015);
  CHECK(at(0, end - 0.003) < w / 28 + 0.003);
  CHECK(at(w / 4, end) > w / 14);
  CHECK(at(0, 0.5) == Approx(crest));
  CHECK(at(w / 2, 0.5) == Approx(flank));
  CHECK(at(w / 2, 0.2) == Approx(flank));
  curves[1].height.assign(curves[1].height.size(), -steep);  // no valley between them
  CHECK(at(w / 2, end) == Approx(flank));
  curves[0].height.assign(curves[0].height.size(), 0.1 * w);  // no steep fold
  CHECK(at(0, end) == Approx(flank));
}

TEST_CASE("refine_band: a line on a flat sheet, from coarse to fine", "[long]") {
  for (double edge : {width / 3, width / 5, width / 10, width / 20}) {
    CAPTURE(edge);
    const Mesh sheet = equilateral_sheet(0.6, 0.8, edge);
    Mesh mesh = sheet;
    const std::vector<FoldCurve> curves{curve_on(sheet, wave(-0.15, 0.1, 0.15, 0.7, 0.08), width, height)};
    const BandReport report = refine_band(mesh, curves);
    require_good(sheet, mesh, curves, report);
    // a flat sheet stays flat, and its rest lengths are those in space: an isometry
    const std::vector<double> lengths = rest_lengths(mesh);
    for (Edge e : mesh.edges())
      CHECK(lengths[e.idx()] == Approx(spatial_length(mesh, e)).epsilon(0).margin(1e-12));
    CHECK(rest_area(mesh) == Approx(rest_area(sheet)).epsilon(1e-12));
    const double h = crest_edge(width, height, Detail::normal, 0.003);
    for (std::size_t i = 1; i < report.chains[0].vertices.size(); ++i)
      CHECK(report.chains[0].along[i] - report.chains[0].along[i - 1] < 1.34 * h);
  }
}

TEST_CASE("refine_band: two lines that cross share a vertex") {
  const Mesh sheet = equilateral_sheet(0.6, 0.8, 0.02);
  Mesh mesh = sheet;
  const std::vector<FoldCurve> curves{
      curve_on(sheet, wave(-0.15, 0.1, 0.15, 0.7, 0.08), width, height),
      curve_on(sheet, wave(-0.2, 0.45, 0.2, 0.5, 0.02), width, height, false, 1)};
  const BandReport report = refine_band(mesh, curves);
  require_good(sheet, mesh, curves, report);
  int shared = 0;
  for (Vertex v : report.chains[0].vertices)
    shared += std::count(report.chains[1].vertices.begin(), report.chains[1].vertices.end(), v);
  CHECK(shared == 1);
}

TEST_CASE("refine_band: a closed ring around a tube") {
  const Mesh tube = cylinder(0.1, 0.6, 24, 24);
  Mesh mesh = tube;
  std::vector<Point> ring;
  for (int i = 0; i < 100; ++i) {
    const double a = 2 * std::numbers::pi * i / 100;
    ring.push_back({0.1 * std::cos(a), 0.3 + 0.03 * std::sin(2 * a), 0.1 * std::sin(a)});
  }
  const std::vector<FoldCurve> curves{curve_on(tube, ring, width, height, true)};
  const BandReport report = refine_band(mesh, curves);
  require_good(tube, mesh, curves, report);
  CHECK(report.chains[0].closed);
}

TEST_CASE("refine_band: a line over the hem ends on it") {
  const Mesh sheet = equilateral_sheet(0.6, 0.8, 0.02);
  Mesh mesh = sheet;
  const std::vector<FoldCurve> curves{curve_on(sheet, {{0.013, 0.5, 0}, {0.03, -0.02, 0}}, width, height)};
  REQUIRE(curves[0].ends_at_border);
  const BandReport report = refine_band(mesh, curves);
  require_good(sheet, mesh, curves, report);
  CHECK(mesh.is_border(report.chains[0].vertices.back()));
}

TEST_CASE("refine_band: bad options are refused") {
  const Mesh sheet = equilateral_sheet(0.6, 0.8, 0.05);
  Mesh mesh = sheet;
  std::vector<FoldCurve> curves{curve_on(sheet, {{0, 0.2, 0}, {0, 0.6, 0}}, width, height)};
  CHECK_THROWS_AS(refine_band(mesh, curves, {Detail::normal, 0, {}}), std::invalid_argument);
  curves[0].width[3] = 0;
  CHECK_THROWS_AS(refine_band(mesh, curves), std::invalid_argument);
  curves[0].width.pop_back();
  CHECK_THROWS_AS(refine_band(mesh, curves), std::invalid_argument);
  CHECK(mesh.num_vertices() == sheet.num_vertices());
}
