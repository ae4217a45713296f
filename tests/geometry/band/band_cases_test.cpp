// SPDX-License-Identifier: GPL-3.0-or-later
#include <rapidcheck.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <random>

#include "geometry/band/refine_band.h"
#include "geometry/mesh/edge_metric.h"
#include "geometry/mesh/property_names.h"
#include "geometry/mesh/sheet.h"
#include "geometry/rest/rest_metric.h"
#include "geometry/rest/rest_state.h"
#include "tests/geometry/band/band_checks.h"
#include "tests/test_meshes.h"
#include "tests/test_paths.h"

using namespace furrow::geometry;
using namespace furrow::tests;

namespace {

constexpr double case_width = 0.1, case_height = 0.015;
const std::vector<std::string> none;

std::vector<Point> arc_points(double x0, double y0, double x1, double y1, double bend) {
  std::vector<Point> points;
  for (int i = 0; i <= 60; ++i) {
    const double t = i / 60.0, s = 4 * bend * t * (1 - t);
    points.push_back({x0 + t * (x1 - x0) - s * (y1 - y0), y0 + t * (y1 - y0) + s * (x1 - x0), 0});
  }
  return points;
}

/// The same mesh with its faces in another order, each beginning with another corner.
Mesh permuted(const Mesh& mesh, unsigned seed) {
  std::vector<Face> faces(mesh.faces().begin(), mesh.faces().end());
  std::mt19937 random(seed);
  std::shuffle(faces.begin(), faces.end(), random);
  Mesh result;
  for (Vertex v : mesh.vertices()) result.add_vertex(mesh.point(v));
  for (Face f : faces) {
    auto c = corners_of(mesh, f);
    std::rotate(c.begin(), c.begin() + random() % 3, c.end());
    result.add_face(c[0], c[1], c[2]);
  }
  return result;
}

double group_area(const Mesh& mesh, int group) {
  const auto groups = find_map(mesh, attribute::group);
  double sum = 0;
  for (Face f : mesh.faces())
    if ((*groups)[f] == group) sum += 0.5 * std::sqrt(area_normal_of(mesh, f).squared_length());
  return sum;
}

}  // namespace

TEST_CASE("refine_band: the same line twice embeds onto itself", "[long]") {
  const Mesh sheet = equilateral_sheet(0.6, 0.8, 0.025);
  const FoldCurve curve = curve_on(sheet, arc_points(-0.15, 0.1, 0.15, 0.7, 0.1), case_width, case_height);
  Mesh mesh = sheet;
  const std::vector<FoldCurve> both{curve, curve};
  const BandReport report = refine_band(mesh, both);
  CHECK(faults_of_band(sheet, mesh, both, report) == none);
  CHECK(report.chains[0].vertices == report.chains[1].vertices);
  Mesh alone = sheet;
  CHECK(refine_band(alone, std::vector<FoldCurve>{curve}).inserted == report.inserted);
  // and once more, later
  const Mesh before = mesh;
  const FoldCurve again = curve_on(before, arc_points(-0.15, 0.1, 0.15, 0.7, 0.1), case_width, case_height);
  const BandReport second = refine_band(mesh, std::vector<FoldCurve>{again});
  CHECK(second.inserted == 0);
  CHECK(second.snapped.empty());
  CHECK(second.chains[0].vertices == report.chains[0].vertices);
}

TEST_CASE("refine_band: permuted faces give the same surface", "[long]") {
  const Mesh sheet = jittered(20, 26, 0.2, 7, 0.6, 0.8);
  Mesh mesh = sheet;
  const auto points = arc_points(0.1, 0.1, 0.45, 0.7, 0.1);
  const BandReport report =
      refine_band(mesh, std::vector<FoldCurve>{curve_on(sheet, points, case_width, case_height)});
  for (unsigned seed : {1u, 2u}) {
    const Mesh other = permuted(sheet, seed);
    Mesh refined = other;
    const BandReport same =
        refine_band(refined, std::vector<FoldCurve>{curve_on(other, points, case_width, case_height)});
    REQUIRE(refined.num_vertices() == mesh.num_vertices());
    CHECK(same.chains[0].vertices == report.chains[0].vertices);
    for (Vertex v : mesh.vertices()) CHECK((refined.point(v) - mesh.point(v)).squared_length() < 1e-18);
    for (Edge e : mesh.edges()) CHECK(refined.halfedge(mesh.vertex(e, 0), mesh.vertex(e, 1)).is_valid());
  }
}

TEST_CASE("refine_band: a strained cloth keeps its rest metric") {
  Mesh cloth = equilateral_sheet(0.6, 0.8, 0.025);
  ensure_rest_lengths(cloth);
  for (Vertex v : cloth.vertices()) {
    const Point p = cloth.point(v);
    cloth.point(v) = {1.06 * p.x(), 0.98 * p.y(), 0};
  }
  Mesh mesh = cloth;
  const std::vector<FoldCurve> curves{
      curve_on(cloth, arc_points(-0.15, 0.1, 0.15, 0.7, 0.1), case_width, case_height)};
  const BandReport report = refine_band(mesh, curves);
  CHECK(faults_of_band(cloth, mesh, curves, report) == none);
  CHECK(report.min_angle_deg >= 15);
  const auto lengths = rest_lengths(mesh);
  for (Edge e : mesh.edges()) {
    const Vector d = mesh.point(mesh.vertex(e, 1)) - mesh.point(mesh.vertex(e, 0));
    CHECK(lengths[e.idx()] == Approx(std::hypot(d.x() / 1.06, d.y() / 0.98)).epsilon(0).margin(1e-11));
  }
}

TEST_CASE("refine_band: a strained star that does not lie flat is not snapped") {
  Mesh cone = grid(8, 8, 0.4, 0.4);
  lift(cone, [](double x, double y) { return 0.4 * std::max(0.0, 0.15 - std::hypot(x - 0.2, y - 0.2)); });
  ensure_rest_lengths(cone);
  auto rest = *find_map(cone, attribute::rest_length);
  for (Edge e : cone.edges()) rest[e] *= 1.05;  // slack everywhere
  Vertex apex;
  for (Vertex v : cone.vertices())
    if (!apex.is_valid() || cone.point(v).z() > cone.point(apex).z()) apex = v;
  Mesh mesh = cone;
  const std::vector<FoldCurve> curves{curve_on(
      cone, {{0.05, 0.203, 0.02}, {0.2, 0.203, 0.06}, {0.35, 0.203, 0.02}}, case_width, case_height)};
  const BandReport report = refine_band(mesh, curves);
  CHECK(std::count(report.snapped.begin(), report.snapped.end(), apex) == 0);
  CHECK(mesh.point(apex) == cone.point(apex));
  CHECK(report.detours == 0);
}

TEST_CASE("refine_band: a line over a seam leaves the seam where it was") {
  Mesh sheet = equilateral_sheet(0.6, 0.8, 0.025);
  const double seam = 0.8 * 18 / 37;  // the height of a row of vertices
  auto group = ensure_map(sheet, attribute::group);
  auto texture = ensure_map(sheet, attribute::texture);
  for (Face f : sheet.faces()) {
    const auto c = corners_of(sheet, f);
    group[f] = sheet.point(c[0]).y() + sheet.point(c[1]).y() + sheet.point(c[2]).y() > 3 * seam ? 1 : 0;
    for (Halfedge h : halfedges_of(sheet, f)) {
      const Point& p = sheet.point(sheet.target(h));
      texture[h] = {p.x() + 5 * group[f], p.y()};
    }
  }
  Mesh mesh = sheet;
  const std::vector<FoldCurve> curves{
      curve_on(sheet, arc_points(-0.1, 0.15, 0.1, 0.65, 0.1), case_width, case_height)};
  const BandReport report = refine_band(mesh, curves);
  CHECK(faults_of_band(sheet, mesh, curves, report) == none);
  // vertices of a seam do not slide: where a line crosses one near a vertex, faces get thin
  CHECK(report.min_angle_deg >= 5);
  for (int g : {0, 1}) CHECK(group_area(mesh, g) == Approx(group_area(sheet, g)).epsilon(1e-12));
  const auto uv = *find_map(mesh, attribute::texture);
  const auto side = *find_map(mesh, attribute::group);
  for (Face f : mesh.faces())
    for (Halfedge h : halfedges_of(mesh, f)) {
      const Point& p = mesh.point(mesh.target(h));
      CHECK(std::hypot(uv[h][0] - p.x() - 5 * side[f], uv[h][1] - p.y()) < 1e-12);
    }
}

TEST_CASE("refine_band: a line along the hem takes the hem's edges") {
  const Mesh sheet = equilateral_sheet(0.6, 0.8, 0.025);
  Mesh mesh = sheet;
  const std::vector<FoldCurve> curves{curve_on(sheet, {{-0.2, 0, 0}, {0.2, 0, 0}}, case_width, case_height)};
  const BandReport report = refine_band(mesh, curves);
  CHECK(faults_of_band(sheet, mesh, curves, report) == none);
  CHECK(report.min_angle_deg >= 15);
  for (Vertex v : report.chains[0].vertices) CHECK(mesh.is_border(v));
}

TEST_CASE("refine_band: attributes are those of the place that a new vertex came from") {
  Mesh sheet = equilateral_sheet(0.6, 0.8, 0.025);
  auto texture = ensure_map(sheet, attribute::texture);
  auto velocity = ensure_map(sheet, attribute::velocity);
  for (Halfedge h : sheet.halfedges()) {
    const Point& p = sheet.point(sheet.target(h));
    if (!sheet.is_border(h)) texture[h] = {p.x(), p.y()};
  }
  for (Vertex v : sheet.vertices()) velocity[v] = sheet.point(v) - Point(1, 2, 3);
  Mesh mesh = sheet;
  refine_band(mesh, std::vector<FoldCurve>{
                        curve_on(sheet, arc_points(-0.1, 0.15, 0.1, 0.65, 0.1), case_width, case_height)});
  const auto uv = *find_map(mesh, attribute::texture);
  const auto moving = *find_map(mesh, attribute::velocity);
  for (Face f : mesh.faces())
    for (Halfedge h : halfedges_of(mesh, f)) {
      const Point& p = mesh.point(mesh.target(h));
      CHECK(std::hypot(uv[h][0] - p.x(), uv[h][1] - p.y()) < 1e-12);
    }
  for (Vertex v : mesh.vertices())
    CHECK((moving[v] - (mesh.point(v) - Point(1, 2, 3))).squared_length() < 1e-24);
}

TEST_CASE("refine_band: random smooth lines on random sheets have complete chains and good angles",
          "[release]") {
  CHECK(rc::check([] {
    const auto seed = *rc::gen::resize(100, rc::gen::inRange(0, 1 << 30));
    std::mt19937 random(static_cast<unsigned>(seed));
    const auto in = [&](double a, double b) { return std::uniform_real_distribution<>(a, b)(random); };
    const int columns = static_cast<int>(in(8, 26));
    const Mesh sheet = jittered(columns, columns, 0.2, static_cast<unsigned>(seed), 0.4, 0.4);
    const double wide = in(3, 12) * 0.4 / columns, high = in(0.1, 0.5) * wide;
    if (wide < 0.03 || wide > 0.15) return;
    const std::vector<FoldCurve> curves{curve_on(
        sheet, arc_points(in(0.08, 0.32), in(0.06, 0.14), in(0.08, 0.32), in(0.26, 0.34), in(-0.15, 0.15)),
        wide, high)};
    Mesh mesh = sheet;
    const BandReport report = refine_band(mesh, curves);
    RC_ASSERT(faults_of_band(sheet, mesh, curves, report) == none);
    RC_ASSERT(report.min_angle_deg >= least_angle(report, wide, high));
    RC_ASSERT(std::abs(rest_area(mesh) / rest_area(sheet) - 1) < 1e-10);
  }));
}

TEST_CASE("refine_band: a coarse imported garment keeps its vertices") {
  if (!have_shared()) {
    WARN("skipped: no shared data");
    return;
  }
  const auto path = shared_dir() / "meshes" / "pairs" / "mh_male" / "tshirt.obj";
  const Mesh shirt = read_plain_obj(path);
  std::vector<Point> down;
  Point low(0, 1e9, 0), high(0, -1e9, 0);
  for (Vertex v : shirt.vertices()) {
    if (shirt.point(v).y() < low.y()) low = shirt.point(v);
    if (shirt.point(v).y() > high.y()) high = shirt.point(v);
  }
  const double top = low.y() + 0.7 * (high.y() - low.y()), bottom = low.y() + 0.2 * (high.y() - low.y());
  const double size = high.y() - low.y();
  for (int i = 0; i <= 50; ++i) down.push_back({0.1 * size, top + (bottom - top) * i / 50, 2 * size});
  const std::vector<FoldCurve> curves{curve_on(shirt, down, 0.12 * size, 0.015 * size)};
  Mesh mesh = shirt;
  const BandReport report = refine_band(mesh, curves);
  CHECK(faults_of_band(shirt, mesh, curves, report) == none);
  CHECK(report.inserted > 100);
  CHECK(report.min_angle_deg >= least_angle(report, 0.12, 0.015));
}
