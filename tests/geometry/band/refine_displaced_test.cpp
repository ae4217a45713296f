// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/band/refine_displaced.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <string>

#include "geometry/mesh/errors.h"
#include "geometry/mesh/sheet.h"
#include "tests/geometry/band/band_checks.h"

using namespace furrow::geometry;
using namespace furrow::tests;

namespace {

constexpr double steep_width = 0.1, steep_height = 0.06;

/// A straight fold along x = 0, which begins at y = 0.1 m.
Point raised(const Point& p) {
  const double t = 2 * p.x() / steep_width, s = std::clamp((p.y() - 0.1) / 0.15, 0.0, 1.0);
  const double taper = s * s * s * (10 - 15 * s + 6 * s * s);
  return {p.x(), p.y(), std::abs(t) < 1 ? steep_height * taper * std::pow(1 - t * t, 2.5) : 0};
}

std::vector<Point> raised(const Mesh& mesh) {
  std::vector<Point> places;
  for (Vertex v : mesh.vertices()) places.push_back(raised(mesh.point(v)));
  return places;
}

/// Of a shape that is a function of the place.
template <class Shape>
Displacing displacing_by(const Mesh& given, const Shape& shape) {
  return {[&given, shape](const Between&, const FacePoint& at) { return shape(position_of(given, at)); },
          [](Vertex) {}};
}

double longest_in_band(const Mesh& mesh, const BandReport& band, const std::vector<Point>& places) {
  double longest = 0;
  for (Face f : mesh.faces())
    for (Halfedge h : halfedges_of(mesh, f)) {
      const Point &a = mesh.point(mesh.source(h)), &b = mesh.point(mesh.target(h));
      if (!band.in_band[f.idx()] || std::abs(a.x() + b.x()) > steep_width || a.y() + b.y() < 0.2) continue;
      const Point &p = places[mesh.source(h).idx()], &q = places[mesh.target(h).idx()];
      longest = std::max(longest, std::sqrt((p - q).squared_length()));
    }
  return longest;
}

}  // namespace

TEST_CASE("refine_displaced: edges of a steep flank become short, the chain stays") {
  const Mesh sheet = equilateral_sheet(0.4, 0.5, 0.02);
  Mesh mesh = sheet;
  const std::vector<FoldCurve> curves{
      curve_on(sheet, {{0, 0.1, 0}, {0, 0.52, 0}}, steep_width, steep_height)};
  BandReport band = refine_band(mesh, curves);
  std::vector<Point> places = raised(mesh);
  const double h = crest_edge(steep_width, 0, Detail::normal, 0.003);  // of flanks
  REQUIRE(longest_in_band(mesh, band, places) > 1.5 * h);
  const std::size_t before = mesh.num_vertices();
  const Displacing on_flat = displacing_by(sheet, [](const Point& p) { return raised(p); });
  const DisplacedReport report = refine_displaced(mesh, sheet, curves, places, on_flat, band);
  CHECK(report.inserted == mesh.num_vertices() - before);
  CHECK(report.inserted > 0);
  CHECK(places.size() == mesh.num_vertices());
  CHECK(longest_in_band(mesh, band, places) <= 1.6 * h);
  CHECK(report.min_angle_deg >= 15);
  CHECK(band.min_angle_deg >= 10);
  CHECK(faults_of_band(sheet, mesh, curves, band) == std::vector<std::string>{});
  for (Vertex v : mesh.vertices()) CHECK((places[v.idx()] - raised(mesh.point(v))).squared_length() < 1e-24);
}

TEST_CASE("refine_displaced: nothing to do where nothing is raised") {
  const Mesh sheet = equilateral_sheet(0.4, 0.5, 0.02);
  Mesh mesh = sheet;
  const std::vector<FoldCurve> curves{curve_on(sheet, {{0, 0.1, 0}, {0.02, 0.4, 0}}, steep_width, 0.01)};
  BandReport band = refine_band(mesh, curves);
  const BandReport first = band;
  std::vector<Point> places(mesh.points().begin(), mesh.points().end());
  const Displacing on_flat = displacing_by(sheet, [](const Point& p) { return p; });
  const DisplacedReport report = refine_displaced(mesh, sheet, curves, places, on_flat, band);
  CHECK(report.inserted == 0);
  CHECK(band.chains[0].vertices == first.chains[0].vertices);
  places.pop_back();
  CHECK_THROWS_AS(refine_displaced(mesh, sheet, curves, places, on_flat, band), std::invalid_argument);
}

TEST_CASE("refine_displaced: where heights jump it ends or says so, however high the jump is") {
  const Mesh sheet = equilateral_sheet(0.4, 0.5, 0.02);
  for (const double jump : {0.05, 5.0}) {
    Mesh mesh = sheet;
    const std::vector<FoldCurve> curves{
        curve_on(sheet, {{0, 0.1, 0}, {0, 0.4, 0}}, steep_width, steep_height)};
    BandReport band = refine_band(mesh, curves);
    const auto torn = [&](const Point& p) { return Point(p.x(), p.y(), p.x() > 0.0131 ? jump : 0); };
    std::vector<Point> places;
    for (Vertex v : mesh.vertices()) places.push_back(torn(mesh.point(v)));
    const Displacing on_torn = displacing_by(sheet, torn);
    const std::size_t before = mesh.num_vertices();
    try {
      const DisplacedReport report = refine_displaced(mesh, sheet, curves, places, on_torn, band);
      CHECK(report.inserted > 0);
    } catch (const ContentError& e) {
      CHECK(std::string(e.what()).find("their heights jump") != std::string::npos);
    }
    CAPTURE(jump, before);
    CHECK(mesh.num_vertices() <= 5 * before + 5000);
  }
}
