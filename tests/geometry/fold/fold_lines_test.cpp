// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/fold/fold_lines.h"

#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <functional>
#include <numbers>
#include <set>
#include <string>

#include "geometry/fold/fold_base.h"
#include "geometry/mesh/errors.h"
#include "geometry/mesh/property_names.h"
#include "geometry/mesh/sheet.h"
#include "geometry/rest/fold_rest.h"
#include "geometry/rest/rest_angles.h"
#include "geometry/stroke/place_path_stroke.h"
#include "geometry/stroke/project_onto_surface.h"
#include "physics/base/cancel_scope.h"
#include "tests/test_meshes.h"
#include "tests/test_paths.h"

using namespace furrow::geometry;
using namespace furrow::tests;

namespace {

constexpr double width = 0.08, height = 0.012;

Stroke line(const std::vector<Point>& points, double k = height, double w = width) {
  Stroke stroke;
  stroke.name = "fold";
  stroke.height = k;
  stroke.width = w;
  stroke.points.assign(points.begin(), points.end());
  return stroke;
}

/// On beyond both hems of a sheet of 0.5 x 0.5 m.
Stroke over_both_hems(double k = height) {
  return line({{0.013, -0.03, 0}, {0.013, 0.25, 0}, {0.013, 0.53, 0}}, k);
}

WrinkleOptions fold_options() {
  WrinkleOptions options;
  options.insertion.rule = InsertionRule::fold;
  return options;
}

WrinkleReport fold(Mesh& mesh, const std::vector<Stroke>& strokes,
                   const WrinkleOptions& options = fold_options()) {
  return wrinkle(mesh, strokes, options);
}

double section(double d) {
  const double t = 2 * d / width;
  return t < 1 ? std::pow(1 - t * t, 2.5) : 0;
}

double rms(const std::vector<double>& values) {
  double sum = 0;
  for (double v : values) sum += v * v;
  return std::sqrt(sum / static_cast<double>(std::max<std::size_t>(values.size(), 1)));
}

std::vector<Point> ring_points(double radius, double y) {
  std::vector<Point> points;
  for (int i = 0; i < 60; ++i) {
    const double a = 2 * std::numbers::pi * i / 60;
    points.emplace_back(radius * std::sin(a), y, radius * std::cos(a));
  }
  return points;
}

}  // namespace

TEST_CASE("fold_lines: on a sheet the surface is the closed form, and the crest lies on the stroke") {
  for (const double k : {height, -height}) {
    Mesh mesh = equilateral_sheet(0.5, 0.5, 0.015);
    const WrinkleReport report = fold(mesh, {over_both_hems(k)});
    std::vector<double> off, lateral, crest;
    for (Vertex v : mesh.vertices()) {
      const Point& p = mesh.point(v);
      off.push_back((p.z() - k * section(std::abs(p.x() - 0.013))) / k);
    }
    for (Vertex v : report.lines.at(0).chains.at(0)) {
      lateral.push_back((mesh.point(v).x() - 0.013) / width);
      crest.push_back(mesh.point(v).z() / k - 1);
    }
    CHECK(rms(off) <= 0.01);
    CHECK(rms(lateral) <= 0.005);
    CHECK(rms(crest) <= 0.003);
    CHECK(report.lines[0].crest_height.value() == Approx(k).epsilon(0.03));
    CHECK(report.lines[0].drawn_height == Approx(k).epsilon(0.03));
    CHECK(report.fold.value().min_angle_deg >= 15);
    CHECK(report.fold->invalid_faces == 0);
    CHECK(report.fold->angle_defect_after <= 40);
  }
}

TEST_CASE("fold_lines: along a tube and around it the fold has its height, ridge and valley", "[long]") {
  constexpr double radius = 0.1;
  for (const double k : {height, -height}) {
    Mesh mesh = cylinder(radius, 0.5, 32, 25);
    const WrinkleReport along =
        fold(mesh, {line({{0.003, -0.03, radius}, {0.003, 0.25, radius}, {0.003, 0.53, radius}}, k)});
    CHECK(along.lines.at(0).crest_height.value() == Approx(k).epsilon(0.08));
    CHECK(along.lines[0].drawn_height / k > 0.5);
    std::vector<double> off;
    for (Vertex v : mesh.vertices()) {
      const Point& p = mesh.point(v);
      const double r = std::hypot(p.x(), p.z()), a = std::atan2(p.x(), p.z()) - std::asin(0.003 / radius);
      off.push_back((r - radius - k * section(2 * radius * std::sin(std::abs(a) / 2))) / k);
    }
    CHECK(rms(off) <= 0.03);
    Mesh ringed = cylinder(radius, 0.5, 32, 25);
    Stroke ring = line(ring_points(radius, 0.25), k);
    ring.closed = true;
    const WrinkleReport around = fold(ringed, {ring});
    CHECK(around.lines.at(0).crest_height.value() == Approx(k).epsilon(0.08));
    CHECK(around.fold->invalid_faces == 0);
    std::vector<double> crest;
    for (Vertex v : around.lines[0].chains.at(0))
      crest.push_back((std::hypot(ringed.point(v).x(), ringed.point(v).z()) - radius) / k - 1);
    CHECK(rms(crest) <= 0.05);
  }
}

TEST_CASE("fold_lines: on a sphere the fold stands out by its height") {
  constexpr double radius = 0.15;
  Mesh mesh = icosphere(3, radius);
  std::vector<Point> points;
  for (int i = 0; i <= 40; ++i) {
    const double a = -1.2 + 2.4 * i / 40;
    points.emplace_back(radius * std::sin(a), 0.01, radius * std::cos(a));
  }
  const WrinkleReport report = fold(mesh, {line(points)});
  CHECK(report.lines.at(0).crest_height.value() == Approx(height).epsilon(0.08));
  CHECK(report.fold->invalid_faces == 0);
  double highest = 0;
  for (Vertex v : mesh.vertices())
    highest = std::max(highest, std::sqrt((mesh.point(v) - CGAL::ORIGIN).squared_length()) - radius);
  CHECK(highest == Approx(height).epsilon(0.08));
}

TEST_CASE("fold_lines: meshes of 20, 10 and 5 mm give one fold", "[release]") {
  const auto folded = [](double edge) {
    Mesh mesh = equilateral_sheet(0.5, 0.3, edge);
    fold(mesh, {line({{-0.17, 0.1, 0}, {-0.05, 0.13, 0}, {0.06, 0.19, 0}, {0.18, 0.2, 0}})});
    return mesh;
  };
  const Mesh fine = folded(0.0025);
  const SurfaceProjector projector(fine);
  for (const double edge : {0.02, 0.01, 0.005}) {
    CAPTURE(edge);
    const Mesh mesh = folded(edge);
    std::vector<double> off;
    for (Vertex v : mesh.vertices()) {
      const Point& p = mesh.point(v);
      if (std::abs(p.x()) > 0.2 || std::abs(p.y() - 0.15) > 0.09) continue;
      off.push_back((p.z() - projector.first_hit({p.x(), p.y(), 1}, {0, 0, -1})->position.z()) / height);
    }
    CHECK(rms(off) <= 0.005);
  }
}

TEST_CASE("fold_lines: height 0 on the facets is an isometry, and old vertices stay but for those on lines") {
  Mesh mesh = cylinder(0.1, 0.5, 24, 20);
  const Mesh before = mesh;
  WrinkleOptions options = fold_options();
  options.flat_base = true;
  const WrinkleReport report = fold(mesh, {line({{0.02, 0.1, 0.1}, {-0.03, 0.4, 0.1}}, 0)}, options);
  CHECK(report.rest_area_after == Approx(report.rest_area_before).epsilon(1e-12));
  std::size_t moved = 0;
  for (Vertex v : before.vertices()) moved += mesh.point(v) != before.point(v);
  CHECK(moved <= report.fold->snapped);
  CHECK(report.lines.at(0).chains.size() == 1);
}

TEST_CASE("fold_lines: held vertices stay, though a fold runs over them") {
  Mesh mesh = equilateral_sheet(0.5, 0.5, 0.015);
  WrinkleOptions options = fold_options();
  for (Vertex v : mesh.vertices())
    if (mesh.point(v).y() > 0.49) options.held.push_back(v);
  const Mesh before = mesh;
  const WrinkleReport report = fold(mesh, {over_both_hems()}, options);
  for (Vertex v : options.held) CHECK(mesh.point(v) == before.point(v));
  CHECK(report.lines.at(0).crest_height.value() > 0.8 * height);
}

TEST_CASE("fold_lines: of the fold's angles the rest has the share that the stroke sets") {
  for (const double set : {0.0, 1.0}) {
    Mesh mesh = equilateral_sheet(0.5, 0.5, 0.015);
    Stroke stroke = over_both_hems();
    stroke.set = set;
    fold(mesh, {stroke});
    const auto rest = find_map(mesh, attribute::rest_angle).value();
    for (Edge e : mesh.edges())
      if (!mesh.is_border(e)) CHECK(rest[e] == Approx(set * dihedral_angle(mesh, e)).margin(1e-9));
  }
}

TEST_CASE("fold_lines: random lines on a creased mesh leave no invalid triangle at rest", "[long]") {
  Mesh mesh = jittered(24, 24, 0.2, 5, 0.6, 0.6);
  lift(mesh, [](double x, double y) {
    return 0.12 * std::abs(std::sin(9 * x)) + 0.05 * std::abs(std::sin(13 * y));
  });
  std::vector<Stroke> strokes;
  for (int i = 0; i < 6; ++i) {
    const double a = 0.9 * i;
    strokes.push_back(line({{0.3 + 0.2 * std::cos(a), 0.3 + 0.2 * std::sin(a), 0.1},
                            {0.3 - 0.2 * std::cos(a + 1), 0.3 - 0.2 * std::sin(a + 1), 0.1}},
                           i % 2 ? 0.01 : -0.01));
    strokes.back().width.reset();
  }
  WrinkleOptions options = fold_options();
  options.insertion.max_distance = 1;
  const WrinkleReport report = fold(mesh, strokes, options);
  CHECK(report.fold->invalid_faces == 0);
  CHECK(invalid_rest_faces(mesh) == 0);
  CHECK(report.fold->min_angle_deg > 3);
}

TEST_CASE("fold_lines: on cloth that lies double the other layer stays, and no face becomes thin") {
  // bent about an axis, half a turn of radius 10 mm: a fold at s = -45 mm lies above s = 45 mm
  constexpr double bend = 0.01, half_turn = bend * std::numbers::pi / 2;
  Mesh mesh = grid(40, 30, 0.5, 0.4);
  const auto s_of = [](const Point& p) { return p.x() - 0.25; };
  const Mesh flat = mesh;
  for (Vertex v : mesh.vertices()) {
    const double s = s_of(flat.point(v)), y = flat.point(v).y(),
                 a = std::clamp(s, -half_turn, half_turn) / bend;
    const double beyond = std::max(0.0, std::abs(s) - half_turn);
    mesh.point(v) = Point(bend * std::cos(a) - beyond, y, -bend * std::sin(a));
  }
  const Mesh before = mesh;
  const double x = -(0.045 - half_turn);
  const WrinkleReport report =
      fold(mesh, {line({{x, 0.06, 1.1 * bend}, {x, 0.2, 1.1 * bend}, {x, 0.34, 1.1 * bend}}, 0.02, 0.12)});
  CHECK(report.lines.at(0).crest_height.value() == Approx(0.02).epsilon(0.03));
  CHECK(report.fold->min_angle_deg >= 10);
  CHECK(report.fold->invalid_faces == 0);
  CHECK(mesh.num_vertices() < 6000);
  for (Vertex v : before.vertices())
    if (s_of(flat.point(v)) > 0.08) CHECK(mesh.point(v) == before.point(v));
}

TEST_CASE("fold_lines: a line down both legs of real trousers is drawn, without thin faces") {
  if (!have_shared()) {
    WARN("skipped: no shared data");
    return;
  }
  Mesh mesh = read_plain_obj(shared_dir() / "meshes" / "pairs" / "mh_male" / "trousers.obj");
  const std::array<std::size_t, 2> ends{562, 487};
  const PlacedStroke placed = place_path_stroke(mesh, ends, false, "fold");
  Stroke stroke = line(placed.points, 0.02);
  stroke.width.reset();
  const WrinkleReport report = fold(mesh, {stroke});  // it was refused: heights jumped from leg to leg
  CHECK(report.fold->min_angle_deg >= 5);
  CHECK(report.fold->invalid_faces == 0);
}

TEST_CASE("fold_lines: folds are drawn over earlier ones, and thin faces that they leave are told",
          "[long]") {
  const auto told = [](const WrinkleReport& report) {
    return std::any_of(report.warnings.begin(), report.warnings.end(), [](const std::string& warning) {
      return warning.find("too thin for cloth") != std::string::npos;
    });
  };
  for (const double slope : {0.0, 0.3, 1.0}) {
    CAPTURE(slope);
    Mesh mesh = equilateral_sheet(0.5, 0.5, 0.02);
    const WrinkleReport first = fold(mesh, {over_both_hems(0.02)});
    CHECK_FALSE(told(first));
    WrinkleOptions options = fold_options();
    options.first_line = 1;
    options.insertion.max_distance = 0.1;
    options.insertion.mean_edge = 0.02;
    const WrinkleReport report =
        fold(mesh, {line({{-0.2, 0.25 - 0.2 * slope, 0}, {0.2, 0.25 + 0.2 * slope, 0}}, 0.015)}, options);
    CHECK(report.fold->invalid_faces == 0);
    CHECK(report.lines.at(0).crest_height.value() == Approx(0.015).epsilon(0.08));
    CHECK(report.fold->min_angle_deg >= 14);
    CHECK(told(report) ==
          (report.fold->min_angle_deg < std::min(3.0, report.fold->min_angle_before_deg / 2)));
  }
}

TEST_CASE("fold_lines: a ridge over a valley does not pinch the cloth in the hollow", "[long]") {
  // Without normals that are averaged further: 4.1, 1.5, 2.4, 0.9, 7.1 and 1.0 degrees.
  struct Case {
    double x, k, slope, least_deg;
  };
  for (const auto& [x, k, slope, least_deg] :
       {Case{0, 0.02, 0, 10}, Case{0, 0.02, 1, 10}, Case{0.0053, 0.02, 0.3, 5}, Case{0.0053, 0.02, 1, 10},
        Case{0.013, 0.015, 1, 10}, Case{0.013, 0.02, 0.3, 10}}) {
    CAPTURE(x, k, slope);
    Mesh mesh = equilateral_sheet(0.5, 0.5, 0.02);
    fold(mesh, {line({{x, -0.03, 0}, {x, 0.25, 0}, {x, 0.53, 0}}, -0.02)});
    WrinkleOptions options = fold_options();
    options.first_line = 1;
    options.insertion.max_distance = 0.1;
    options.insertion.mean_edge = 0.02;
    const WrinkleReport report =
        fold(mesh, {line({{-0.2, 0.25 - 0.2 * slope, 0}, {0.2, 0.25 + 0.2 * slope, 0}}, k)}, options);
    CHECK(report.fold->invalid_faces == 0);
    CHECK(report.lines.at(0).crest_height.value() == Approx(k).epsilon(0.08));
    CHECK(report.fold->min_angle_deg >= least_deg);
  }
}

namespace {

/// A point of a stroke in its own plane: x to the right, y up, about the middle of the cloth [m].
using Drawing = std::vector<std::array<double, 2>>;

Drawing figure_eight() {
  Drawing points;
  for (int i = 0; i < 96; ++i) {
    const double a = 2 * std::numbers::pi * (i + 0.5) / 96;
    points.push_back({0.17 * std::sin(a), 0.11 * std::sin(2 * a)});
  }
  return points;
}

Drawing loop() {
  Drawing points;
  for (int i = 0; i <= 80; ++i) {
    const double t = -1.35 + 2.7 * i / 80;  // a folium: it crosses itself at (0, -0.05)
    points.push_back({0.16 * t * (1 - t * t), 0.19 * (0.65 - t * t)});
  }
  return points;
}

/// Two windings, the inner one of which runs out onto the outer one.
Drawing spiral() {
  Drawing points;
  for (int i = 0; i <= 150; ++i) {
    const double a = 2 * std::numbers::pi * i / 75, r = 0.09 + 0.06 * std::sin(a / 4);
    points.push_back({r * std::cos(a), r * std::sin(a)});
  }
  return points;
}

double distance_to_segment(const std::array<double, 2>& p, const std::array<double, 2>& a,
                           const std::array<double, 2>& b) {
  const double x = b[0] - a[0], y = b[1] - a[1];
  const double t = std::clamp(((p[0] - a[0]) * x + (p[1] - a[1]) * y) / (x * x + y * y), 0.0, 1.0);
  return std::hypot(a[0] + t * x - p[0], a[1] + t * y - p[1]);
}

/// Where a line meets itself it has at most 1.1 of the height asked, elsewhere that height; `height_of` is
/// the height of a point above the cloth, `place_of` where it lies in the drawing.
void check_self_crossing(const WrinkleReport& report, const Mesh& mesh, const Drawing& drawing,
                         const std::function<double(const Point&)>& height_of,
                         const std::function<std::array<double, 2>(const Point&)>& place_of,
                         double tolerance) {
  REQUIRE(report.lines.size() == 1);
  REQUIRE(report.lines[0].chains.size() == 1);
  const auto& chain = report.lines[0].chains[0];
  CHECK(report.fold->invalid_faces == 0);
  CHECK(invalid_rest_faces(mesh) == 0);
  std::set<Vertex> seen;
  std::size_t twice = 0, full = 0;
  double highest = 0;
  CHECK(report.lines[0].crest_height.value() == Approx(height).epsilon(0.03 + tolerance));
  for (std::size_t i = 0; i < chain.size(); ++i) {
    if (i > 0) CHECK(mesh.halfedge(chain[i - 1], chain[i]).is_valid());
    if (!seen.insert(chain[i]).second && i + 1 < chain.size()) ++twice;
    const auto p = place_of(mesh.point(chain[i]));
    double near = 1;
    for (std::size_t k = 0; k < drawing.size(); ++k)
      near = std::min(near, distance_to_segment(p, drawing[k], drawing[(k + 1) % drawing.size()]));
    CHECK(near <= 0.03 * 0.05);  // where two passes share a vertex, it may lie beside one
    highest = std::max(highest, height_of(mesh.point(chain[i])));
    full += std::abs(height_of(mesh.point(chain[i])) / height - 1) <= 0.03 + tolerance;
  }
  CHECK(twice >= 1);
  CHECK(highest <= 1.1 * height * (1 + tolerance));
  CHECK(static_cast<double>(full) >= 0.6 * static_cast<double>(chain.size()));
}

}  // namespace

TEST_CASE("fold_lines: a stroke that crosses itself is one line, on a sheet", "[long]") {
  const auto at = GENERATE(0, 1, 2);
  CAPTURE(at);
  const Drawing drawing = at == 0 ? figure_eight() : at == 1 ? loop() : spiral();
  Mesh mesh = equilateral_sheet(0.5, 0.5, 0.015);
  std::vector<Point> points;
  for (const auto& p : drawing) points.emplace_back(p[0], 0.25 + p[1], 0);
  Stroke stroke = line(std::move(points), height, 0.05);
  stroke.closed = at == 0;
  const WrinkleReport report = fold(mesh, {stroke});
  check_self_crossing(
      report, mesh, drawing, [](const Point& p) { return p.z(); },
      [](const Point& p) -> std::array<double, 2> {
        return {p.x(), p.y() - 0.25};
      },
      0);
}

TEST_CASE("fold_lines: a stroke that crosses itself is one line, on a tube", "[long]") {
  constexpr double radius = 0.2;
  const auto at = GENERATE(0, 1, 2);
  CAPTURE(at);
  const Drawing drawing = at == 0 ? figure_eight() : at == 1 ? loop() : spiral();
  Mesh mesh = cylinder(radius, 0.5, 64, 25);
  std::vector<Point> points;
  for (const auto& p : drawing)
    points.emplace_back(radius * std::sin(p[0] / radius), 0.25 + p[1], radius * std::cos(p[0] / radius));
  Stroke stroke = line(std::move(points), height, 0.05);
  stroke.closed = at == 0;
  const WrinkleReport report = fold(mesh, {stroke});
  check_self_crossing(
      report, mesh, drawing, [](const Point& p) { return std::hypot(p.x(), p.z()) - radius; },
      [](const Point& p) -> std::array<double, 2> {
        return {radius * std::atan2(p.x(), p.z()), p.y() - 0.25};
      },
      0.03);
}

TEST_CASE("fold_base: a curved surface over the facets of a sphere is nearer to it, and keeps the corners") {
  const Mesh mesh = icosphere(2, 1);
  std::vector<Vector> normals;
  for (Vertex v : mesh.vertices()) normals.push_back(mesh.point(v) - CGAL::ORIGIN);
  for (Face f : mesh.faces()) {
    const FacePoint middle{f, {1.0 / 3, 1.0 / 3, 1.0 / 3}}, corner{f, {1, 0, 0}};
    const auto off = [](const Point& p) {
      return std::abs(1 - std::sqrt((p - CGAL::ORIGIN).squared_length()));
    };
    CHECK(off(curved_place(mesh, normals, middle)) < 0.1 * off(position_of(mesh, middle)));
    CHECK(std::sqrt(CGAL::squared_distance(curved_place(mesh, normals, corner), position_of(mesh, corner))) <
          1e-12);
  }
}

TEST_CASE("fold_base: the angle defect is that of Gauss and Bonnet, and 0 of a sheet") {
  CHECK(angle_defect(icosphere(3, 0.5)) == Approx(1 / 0.25).epsilon(0.02));  // 4 pi over 4 pi r^2
  CHECK(angle_defect(equilateral_sheet(0.5, 0.5, 0.02)) == Approx(0).margin(1e-9));
  CHECK(angle_defect(cylinder(0.1, 0.3, 20, 10)) == Approx(0).margin(1e-6));
}

TEST_CASE(
    "fold_lines: folds of more faces than are borne are refused by name, as on a garment in another unit") {
  Mesh mesh = grid(10, 10, 300, 300);
  try {
    fold(mesh, {line({{30, 30, 0}, {250, 240, 0}, {40, 260, 0}}, 0.001, 0.014)});
    FAIL("they were drawn");
  } catch (const ContentError& e) {
    CHECK_THAT(e.what(), Catch::Contains("stroke \"fold\"") && Catch::Contains("million faces") &&
                             Catch::Contains("`unit`"));
  }
  CHECK(mesh.number_of_vertices() == 121);
}

TEST_CASE("fold_lines: a scribble comes to its end after work that is bounded", "[long]") {
  const auto questions = [](int points) {
    Mesh mesh = grid(10, 10, 1, 1);
    Stroke zigzag = line({}, 0.01, 0.4);
    for (int i = 0; i < points; ++i)
      zigzag.points.emplace_back(0.1 + 0.8 * i / (points - 1), i % 2 ? 0.9 : 0.1, 0);
    int asked = 0;
    const furrow::physics::CancelScope scope([&] { return ++asked < 0; });
    try {
      fold(mesh, {zigzag});
    } catch (const ContentError&) {  // there may be no way along it
    }
    return asked;
  };
  CHECK(questions(400) < 30 * questions(50));  // 64 times as many, were they as its crossings
}
