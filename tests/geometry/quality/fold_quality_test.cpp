// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/quality/fold_quality.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <random>

#include "geometry/fold/fold_base.h"
#include "geometry/fold/wrinkle.h"
#include "geometry/mesh/errors.h"
#include "geometry/mesh/property_names.h"
#include "geometry/mesh/sheet.h"
#include "geometry/mesh/tangent_frames.h"
#include "tests/geometry/band/band_checks.h"
#include "tests/test_meshes.h"

using namespace furrow::geometry;
using namespace furrow::tests;

namespace {

constexpr double w = 0.08, k = 0.012;

double phi(double t) { return std::abs(t) < 1 ? std::pow(1 - t * t, 2.5) : 0; }

std::vector<Point> places_of(const Mesh& mesh) { return {mesh.points().begin(), mesh.points().end()}; }

/// A flat cloth with a line up its middle, over both hems, and what is raised on it.
struct Sheet {
  Mesh mesh = grid(120, 400, 0.12, 0.4);  // 1 x 1 mm
  std::vector<Point> before = places_of(mesh);
  FoldCurve curve = curve_on(mesh, {{0.06, -0.02, 0}, {0.06, 0.2, 0}, {0.06, 0.42, 0}}, w, k);

  /// height(d, s)
  template <class Height>
  LineQuality measured(const Height& height) {
    lift(mesh, [&](double x, double y) { return height(x - 0.06, y); });
    return measure_line(surface_over(mesh, before), curve);
  }
};

/// What a parabola over 41 rows w/40 apart leaves of a wave of that length: closed form of the filter of
/// Savitzky and Golay.
double left_of_wave(double length) {
  constexpr int m = 20;
  double kept = 0;
  for (int j = -m; j <= m; ++j)
    kept += 3.0 * (3 * m * (m + 1) - 1 - 5 * j * j) / ((2.0 * m - 1) * (2 * m + 1) * (2 * m + 3)) *
            std::cos(2 * std::numbers::pi * j * w / 40 / length);
  return 1 - kept;
}

/// The mesh with its faces in another order, each beginning with another corner.
Mesh in_other_order(const Mesh& mesh) {
  std::vector<Face> faces(mesh.faces().begin(), mesh.faces().end());
  std::mt19937 random(5);
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

void check_ideal(const LineQuality& q, double height, double tolerance) {
  INFO(q.name << " ripple " << q.crest_ripple.value() << " lateral " << q.lateral.value() << " sweep "
              << q.sweep.value() << " normals " << q.normals_deg.value() << " fit " << q.fit.value());
  CHECK(q.missing.empty());
  CHECK(q.crest_ripple.value() < tolerance);
  CHECK(q.sweep.value() < tolerance);
  CHECK(q.fit.value() < tolerance);
  CHECK(q.crest_height.value() == Approx(height).epsilon(tolerance));
  CHECK(q.fitted_height.value() == Approx(height).epsilon(tolerance));
  CHECK(q.fitted_width.value() == Approx(w).epsilon(2 * tolerance));
}

/// Raises a body's cloth along its normals by the fold's section over straight distances from the line.
template <class Normal, class Distance>
Mesh raised(Mesh mesh, double height, const Normal& normal, const Distance& distance) {
  for (Vertex v : mesh.vertices()) {
    const Point p = mesh.point(v);
    mesh.point(v) = p + height * phi(2 * distance(p) / w) * normal(p);
  }
  return mesh;
}

std::vector<Point> arc_points(double radius, double y, double from, double to) {
  std::vector<Point> points;
  for (int i = 0; i <= 200; ++i) {
    const double a = from + (to - from) * i / 200;
    points.emplace_back(radius * std::sin(a), y, radius * std::cos(a));
  }
  return points;
}

}  // namespace

TEST_CASE("fold_quality: an ideal fold on a fine sheet has its height and width, and no faults",
          "[release]") {
  for (const double height : {k, -k, 0.4 * w}) {
    Sheet sheet;
    for (double& h : sheet.curve.height) h = height;
    const LineQuality q = sheet.measured([&](double d, double) { return height * phi(2 * d / w); });
    check_ideal(q, height, 1e-3);
    CHECK(q.lateral.value() < 1e-6);
    CHECK(q.normals_deg.value() < 1);  // the two faces of a cell
    CHECK(q.sections > 190);
  }
}

TEST_CASE("fold_quality: a line that runs across the mesh, and a base of another mesh, change little",
          "[release]") {
  Mesh mesh = grid(300, 300, 0.3, 0.3);
  const double angle = 0.3, c = std::cos(angle), s = std::sin(angle);
  lift(mesh, [&](double x, double y) { return k * phi(2 * (c * (x - 0.15) + s * (y - 0.15)) / w); });
  const auto on = [&](double way) { return Point(0.15 - s * way, 0.15 + c * way, 0); };
  const Mesh coarse = equilateral_sheet(0.8, 0.8, 0.05);
  const FoldCurve curve = curve_on(coarse, {on(-0.12), on(0), on(0.12)}, w, k);
  const LineQuality q = measure_line(surface_over(mesh, coarse), curve);
  check_ideal(q, k, 3e-3);
  CHECK(q.lateral.value() < 0.01);  // the mesh's own edges are w / 80
}

TEST_CASE("fold_quality: ideal folds along a tube, around it and over a sphere", "[release]") {
  constexpr double radius = 0.1;
  const auto outward = [](const Point& p) { return normalized(Vector(p.x(), 0, p.z())); };
  const Mesh tube = cylinder(radius, 0.3, 500, 200);
  const FoldCurve along = curve_on(tube, {{0, -0.02, radius}, {0, 0.15, radius}, {0, 0.32, radius}}, w, k);
  const Mesh ridge =
      raised(tube, k, outward, [&](const Point& p) { return std::hypot(p.x(), p.z() - radius); });
  check_ideal(measure_line(surface_over(ridge, places_of(tube)), along), k, 2e-3);
  check_ideal(measure_line(surface_over(ridge, tube), along), k, 2e-3);

  std::vector<Point> ring = arc_points(radius, 0.15, 0, 2 * std::numbers::pi);
  ring.pop_back();
  const FoldCurve around = curve_on(tube, ring, w, -k, true);
  const Mesh valley = raised(tube, -k, outward, [](const Point& p) { return p.y() - 0.15; });
  const LineQuality q = measure_line(surface_over(valley, tube), around);
  check_ideal(q, -k, 2e-3);
  CHECK(q.sections == Approx(2 * std::numbers::pi * radius / (w / 40)).epsilon(0.02));

  constexpr double large = 0.15;
  const Mesh ball = icosphere(6, large);
  const auto from_centre = [](const Point& p) { return normalized(p - CGAL::ORIGIN); };
  // over a great circle in the plane y = 0: straight distance from it
  const auto off = [&](const Point& p) {
    const double level = std::hypot(p.x(), p.z());
    return std::hypot(p.y(), large - level);
  };
  const Mesh folded = raised(ball, k, from_centre, off);
  check_ideal(measure_line(surface_over(folded, ball), curve_on(ball, arc_points(large, 0, -1.2, 1.2), w, k)),
              k, 5e-3);
}

TEST_CASE("fold_quality: ripples of known size are measured as such", "[release]") {
  for (const double length : {w / 6, w / 4})
    for (const double amplitude : {0.002, 0.01, 0.05}) {
      CAPTURE(length, amplitude);
      Sheet sheet;
      const LineQuality q = sheet.measured([&](double d, double s) {
        return k * phi(2 * d / w) * (1 + amplitude * std::sin(2 * std::numbers::pi * s / length));
      });
      const double expected = amplitude / std::sqrt(2.0) * std::abs(left_of_wave(length));
      CHECK(q.crest_ripple.value() == Approx(expected).epsilon(0.06));
      CHECK(q.crest_height.value() == Approx(k).epsilon(0.002));
    }
}

TEST_CASE("fold_quality: a height that rises and sinks over widths is no ripple", "[long]") {
  Sheet sheet;
  const LineQuality q =
      sheet.measured([&](double d, double s) { return k * phi(2 * d / w) * (0.6 + s - s * s); });
  CHECK(q.crest_ripple.value() < 1e-3);
  CHECK(q.sweep.value() < 1e-3);
}

TEST_CASE("fold_quality: a crest that snakes beside its stroke is measured as such", "[release]") {
  for (const double amplitude : {0.002, 0.01, 0.05}) {
    Sheet sheet;
    const auto shift = [&](double s) { return amplitude * w * std::sin(2 * std::numbers::pi * s / w); };
    for (Vertex v : sheet.mesh.vertices()) {
      const Point p = sheet.mesh.point(v);
      sheet.before[v.idx()] = {p.x() + shift(p.y()), p.y(), 0};
      sheet.mesh.point(v) = {p.x() + shift(p.y()), p.y(), k * phi(2 * (p.x() - 0.06) / w)};
    }
    const LineQuality q = measure_line(surface_over(sheet.mesh, sheet.before), sheet.curve);
    CHECK(q.lateral.value() == Approx(amplitude / std::sqrt(2.0)).epsilon(0.02));
    // of a path that is given it is the distance
    const LinePath path{{Eigen::Vector3d(0.06 + w, -1, 0), Eigen::Vector3d(0.06 + w, 1, 0)}};
    const LineQuality beside = measure_line(surface_over(sheet.mesh, sheet.before), sheet.curve, path, true);
    CHECK(beside.lateral.value() == Approx(1).epsilon(0.01));
    CHECK_FALSE(beside.sweep);
  }
}

TEST_CASE("fold_quality: sections that waver, and normals that turn, are measured as such", "[release]") {
  const double length = w / 4;
  for (const double amplitude : {0.005, 0.02}) {
    Sheet sheet;
    const LineQuality q = sheet.measured([&](double d, double s) {
      return k * phi(2 * d / w) + amplitude * k * std::sin(2 * std::numbers::pi * s / length);
    });
    const double expected = amplitude / std::sqrt(2.0) * std::abs(left_of_wave(length));
    CHECK(q.sweep.value() == Approx(expected).epsilon(0.06));
  }
  for (const double slope : {0.02, 0.1}) {  // of the waves, on a fold that is nearly flat
    Sheet sheet;
    const LineQuality q = sheet.measured([&](double d, double s) {
      return 0.01 * w * phi(2 * d / w) +
             slope * length / (2 * std::numbers::pi) * std::sin(2 * std::numbers::pi * s / length);
    });
    const double mean_square = std::pow(std::atan(slope), 2) / 2;
    CHECK(q.normals_deg.value() == Approx(std::sqrt(mean_square) * 180 / std::numbers::pi).epsilon(0.06));
  }
}

TEST_CASE("fold_quality: the fit finds other heights and widths, and tells tents from folds", "[release]") {
  Sheet narrow;
  const LineQuality other =
      narrow.measured([&](double d, double) { return 0.7 * k * phi(2 * d / (0.8 * w)); });
  CHECK(other.fit.value() < 1e-3);
  CHECK(other.fitted_height.value() == Approx(0.7 * k).epsilon(0.002));
  CHECK(other.fitted_width.value() == Approx(0.8 * w).epsilon(0.002));
  const auto tent = [](double d, double) { return k * std::max(0.0, 1 - std::abs(2 * d / w)); };
  Sheet sharp;
  CHECK(sharp.measured(tent).fit.value() > 0.03);
  Sheet known;
  known.curve.sharpness = 1;
  CHECK(known.measured(tent).fit.value() < 1e-3);
}

TEST_CASE("fold_quality: what cannot be measured says why", "[long]") {
  Sheet flared;
  flared.curve.rise = {0.75 * flared.curve.length, 0};
  const LineQuality q = flared.measured([](double d, double) { return k * phi(2 * d / w); });
  CHECK_FALSE(q.fit);
  CHECK(q.missing.size() == 1);
  CHECK(q.sweep);
  Sheet flat;
  const LineQuality none = flat.measured([](double, double) { return 0.0; });
  CHECK_FALSE(none.crest_ripple);
  CHECK(none.missing.size() == 1);
  Mesh far = grid(4, 4);
  for (Vertex v : far.vertices()) far.point(v) = far.point(v) + Vector(5, 5, 5);
  const LineQuality away = measure_line(surface_over(far, places_of(far)), flat.curve);
  CHECK(away.sections == 0);
  CHECK_FALSE(away.lateral);
  CHECK_THROWS_AS(surface_over(far, std::vector<Point>(3)), std::invalid_argument);
  CHECK_THROWS_AS(surface_over(far, Mesh{}), ContentError);
}

TEST_CASE("fold_quality: the order of faces does not matter") {
  Mesh mesh = jittered(40, 40, 0.2, 3, 0.4, 0.4);
  const std::vector<Point> before = places_of(mesh);
  const FoldCurve curve = curve_on(mesh, {{0.2, -0.02, 0}, {0.21, 0.2, 0}, {0.2, 0.42, 0}}, w, k);
  lift(mesh, [](double x, double) { return k * phi(2 * (x - 0.2) / w); });
  const Mesh other = in_other_order(mesh);
  const LineQuality a = measure_line(surface_over(mesh, before), curve),
                    b = measure_line(surface_over(other, before), curve);
  CHECK(b.crest_ripple.value() == Approx(a.crest_ripple.value()).epsilon(1e-9));
  CHECK(b.lateral.value() == Approx(a.lateral.value()).epsilon(1e-9));
  CHECK(b.sweep.value() == Approx(a.sweep.value()).epsilon(1e-9));
  CHECK(b.normals_deg.value() == Approx(a.normals_deg.value()).epsilon(1e-9));
  CHECK(b.fit.value() == Approx(a.fit.value()).epsilon(1e-9));
  const MeshQuality whole = measure_quality(mesh), same = measure_quality(other);
  CHECK(same.angle_defect == Approx(whole.angle_defect).epsilon(1e-9));
  CHECK(same.min_angle_deg == whole.min_angle_deg);
  CHECK(same.hems.at(0).turn_deg == Approx(whole.hems.at(0).turn_deg).epsilon(1e-9));
}

TEST_CASE("fold_quality: knobs of a cone and of a sphere, thin faces, hems of polygons") {
  const int n = 24;
  const double height = 0.3;
  std::vector<Point> points{{0, 0, height}};
  std::vector<std::array<int, 3>> faces;
  for (int i = 0; i < n; ++i) {
    const double a = 2 * std::numbers::pi * i / n;
    points.emplace_back(std::cos(a), std::sin(a), 0);
    faces.push_back({0, 1 + i, 1 + (i + 1) % n});
  }
  const Mesh cone = mesh_of(points, faces);
  const double side = std::hypot(1, height), base = 2 * std::sin(std::numbers::pi / n);
  const double corner = 2 * std::asin(base / 2 / side);
  CHECK(angle_defects(cone)[0] == Approx(2 * std::numbers::pi - n * corner));
  const MeshQuality q = measure_quality(cone);
  const double area = n * 0.5 * side * side * std::sin(corner);
  CHECK(q.angle_defect == Approx((2 * std::numbers::pi - n * corner) / area));
  CHECK(q.min_angle_deg == Approx(corner * 180 / std::numbers::pi));
  CHECK(q.min_rest_angle_deg == Approx(q.min_angle_deg));
  CHECK(q.vertices == n + 1);
  CHECK(measure_quality(icosphere(4, 0.5)).angle_defect == Approx(4).epsilon(0.01));
  // edges of 26 cm: one corner in so many pieces of 6 mm
  const double turn = 360.0 / n;
  CHECK(q.hems.at(0).turn_deg == Approx(turn * std::sqrt(0.006 / base)));

  const auto polygon = [](int sides, double edge) {
    const double radius = edge / (2 * std::sin(std::numbers::pi / sides));
    std::vector<Point> loop;
    for (int i = 0; i < sides; ++i)
      loop.emplace_back(radius * std::cos(2 * std::numbers::pi * i / sides),
                        radius * std::sin(2 * std::numbers::pi * i / sides), 0);
    return loop;
  };
  const double angle = 2 * std::numbers::pi / 40;
  CHECK(turn_of(polygon(40, 0.012), 0.006) == Approx(angle * std::sqrt(0.5)));
  CHECK(turn_of(polygon(40, 0.004), 0.006) == Approx(angle * std::sqrt(2.5)));
  CHECK(turn_of(polygon(40, 0.0024), 0.006) == Approx(angle * std::sqrt(6.5)));
  CHECK(std::isnan(turn_of(polygon(3, 0.001), 0.006)));
}

TEST_CASE("fold_quality: rest lengths that make no triangle have the angle 0") {
  Mesh mesh = grid(4, 4);
  auto rest = ensure_map(mesh, attribute::rest_length);
  CHECK(measure_quality(mesh).min_rest_angle_deg == Approx(45));
  rest[*mesh.edges().begin()] = 100;
  CHECK(measure_quality(mesh).min_rest_angle_deg == 0);
  CHECK(measure_quality(mesh).min_angle_deg == Approx(45));
}
