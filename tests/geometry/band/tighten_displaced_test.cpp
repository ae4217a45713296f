// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/band/tighten_displaced.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <random>

#include "geometry/fold/fold_base.h"
#include "geometry/mesh/sheet.h"
#include "geometry/rest/rest_metric.h"

using namespace furrow::geometry;

namespace {

/// A sheet whose inner vertices lie irregularly.
Mesh shaken_sheet() {
  Mesh mesh = equilateral_sheet(0.4, 0.4, 0.02);
  std::mt19937 random(7);
  std::uniform_real_distribution<double> shift(-0.004, 0.004);
  for (Vertex v : mesh.vertices()) {
    const Vector by(shift(random), shift(random), 0);
    if (!mesh.is_border(v)) mesh.point(v) = mesh.point(v) + by;
  }
  return mesh;
}

/// Rolled around an axis that is oblique to the rows of vertices, without stretch.
Point rolled(const Point& p) {
  const double s = 0.8 * p.x() + 0.6 * p.y(), t = -0.6 * p.x() + 0.8 * p.y(), radius = 0.08;
  return {radius * std::sin(s / radius), t, radius * std::cos(s / radius)};
}

std::vector<Point> places_of(const Mesh& mesh, Point (*shape)(const Point&)) {
  std::vector<Point> places;
  for (Vertex v : mesh.vertices()) places.push_back(shape(mesh.point(v)));
  return places;
}

double knobs(const Mesh& mesh, const std::vector<Point>& places) {
  Mesh shape = mesh;
  for (Vertex v : shape.vertices()) shape.point(v) = places[v.idx()];
  return angle_defect(shape);
}

double smallest_angle_deg(const Mesh& mesh, const std::vector<Point>& places) {
  double least = 60;
  for (Face f : mesh.faces()) {
    const auto c = corners_of(mesh, f);
    TriangleLengths lengths;
    for (int i = 0; i < 3; ++i)
      lengths[i] = std::sqrt((places[c[i].idx()] - places[c[(i + 1) % 3].idx()]).squared_length());
    least = std::min(least, smallest_angle(lengths) * 180 / std::numbers::pi);
  }
  return least;
}

std::vector<Point> points_of(const Mesh& mesh) { return {mesh.points().begin(), mesh.points().end()}; }

}  // namespace

TEST_CASE("tighten_displaced: a rolled sheet loses close to half of its knobs, and gets no thin faces") {
  const Mesh sheet = shaken_sheet();
  Mesh mesh = sheet;
  BandMesh band(mesh);
  band.in_band.assign(mesh.num_faces(), true);
  const std::vector<Point> places = places_of(mesh, rolled);
  const double before = knobs(mesh, places);
  REQUIRE(smallest_angle_deg(mesh, places) > 17);
  const std::size_t count = tighten_displaced(band, places);
  CHECK(count > 50);
  CHECK(band.flips == count);
  CHECK(knobs(mesh, places) < 0.6 * before);
  CHECK(smallest_angle_deg(mesh, places) >= 17 - 1e-9);
  CHECK(smallest_angle_deg(mesh, points_of(mesh)) >= 13.5 - 1e-9);
  CHECK(points_of(mesh) == points_of(sheet));
  CHECK(mesh.num_edges() == sheet.num_edges());
  for (Edge e : mesh.edges()) {
    const double length =
        std::sqrt((mesh.point(mesh.vertex(e, 0)) - mesh.point(mesh.vertex(e, 1))).squared_length());
    CHECK(band.rest[e] == Approx(length).epsilon(1e-9));
  }
  CHECK(tighten_displaced(band, places) == 0);
}

TEST_CASE("tighten_displaced: a flat sheet, faces outside of the band and lines keep their edges") {
  Mesh mesh = shaken_sheet();
  BandMesh band(mesh);
  const std::vector<Point> places = places_of(mesh, rolled);
  CHECK(tighten_displaced(band, places) == 0);  // nothing is in the band
  band.in_band.assign(mesh.num_faces(), true);
  CHECK(tighten_displaced(band, points_of(mesh)) == 0);
  for (Edge e : mesh.edges()) band.editor.line_edge()[e] = true;
  CHECK(tighten_displaced(band, places) == 0);
}
