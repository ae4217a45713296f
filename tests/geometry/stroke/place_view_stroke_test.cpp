// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/stroke/place_view_stroke.h"

#include <rapidcheck.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "geometry/mesh/errors.h"
#include "geometry/stroke/trace_stroke.h"
#include "tests/geometry/stroke/point_distance.h"
#include "tests/test_meshes.h"

using namespace furrow::geometry;
using namespace furrow::tests;

namespace {

const Point eye_point(0.5, 0.4, 3);

std::vector<SightLine> sight_of(const std::vector<Point>& points, const Point& eye = eye_point) {
  std::vector<SightLine> lines;
  for (const Point& p : points) lines.push_back({eye, normalized(p - eye)});
  return lines;
}

PlacedStroke place_in_view(const Mesh& mesh, const std::vector<SightLine>& sight, bool closed = false,
                           bool parallel = false) {
  return place_view_stroke(mesh, SurfaceProjector(mesh), sight, parallel, closed, "fold");
}

Mesh bumpy(double amount) {
  Mesh mesh = jittered(24, 24, 0.2, 7);
  lift(mesh, [&](double x, double y) { return amount * std::sin(9 * x) * std::cos(7 * y); });
  return mesh;
}

TracedStroke trace(const Mesh& mesh, const std::vector<Point>& points,
                   const std::vector<std::size_t>& breaks = {}) {
  Stroke stroke;
  stroke.points.assign(points.begin(), points.end());
  stroke.breaks = breaks;
  return trace_stroke(mesh, SurfaceProjector(mesh), stroke, {0.05, 0.05});
}

}  // namespace

TEST_CASE("place_view_stroke: a stroke seen in a picture comes back to where it lies in space", "[long]") {
  CHECK(rc::check([] {
    const Mesh mesh = bumpy(0.04);
    const SurfaceProjector projector(mesh);
    std::vector<Point> points;
    const auto count = *rc::gen::inRange(2, 6);
    for (int i = 0; i < count; ++i) {
      const double x = 0.05 + 0.9 * *rc::gen::inRange(0, 1000) / 1000.,
                   y = 0.05 + 0.9 * *rc::gen::inRange(0, 1000) / 1000.;
      points.push_back(projector.first_hit({x, y, 2}, {0, 0, -1})->position);
    }
    const auto sight = sight_of(points);
    const PlacedStroke placed = place_in_view(mesh, sight);
    RC_ASSERT(placed.warnings.empty());
    RC_ASSERT(placed.breaks.empty());
    std::size_t at = 0;
    for (std::size_t i = 0; i < points.size(); ++i) {
      // A hit is moved by up to 1e-4 of its face to lie strictly inside.
      while (at < placed.points.size() && distance(placed.points[at], points[i]) > 3e-5) {
        const Vector plane = i > 0
                                 ? normalized(CGAL::cross_product(sight[i - 1].direction, sight[i].direction))
                                 : Vector(0, 0, 0);
        if (i > 0 && distance(points[i - 1], points[i]) > 0.05)
          RC_ASSERT(std::abs(plane * (placed.points[at] - eye_point)) < 5e-4);
        RC_ASSERT(projector.closest(placed.points[at]).distance < 1e-12);
        ++at;
      }
      RC_ASSERT(at < placed.points.size());
    }
    RC_ASSERT(trace(mesh, placed.points).sub_strokes.size() == 1u);
  }));
}

TEST_CASE("place_view_stroke: each crossed face has a point, so the trace is the plane's cut") {
  const Mesh mesh = bumpy(0.04);
  const PlacedStroke placed = place_in_view(mesh, sight_of({{0.1, 0.2, 0}, {0.9, 0.7, 0}}));
  const TracedStroke traced = trace(mesh, placed.points);
  REQUIRE(traced.sub_strokes.size() == 1);
  CHECK(traced.sub_strokes[0].faces.size() > 30);
  for (const CrossedFace& visit : traced.sub_strokes[0].faces) CHECK(visit.samples > 0);
}

TEST_CASE(
    "place_view_stroke: it never jumps to a layer in front, but parts the stroke where the one behind goes "
    "out of sight") {
  Mesh mesh = grid(20, 20);
  Mesh patch = grid(6, 6, 0.3, 0.3);
  for (Vertex v : patch.vertices()) patch.point(v) = patch.point(v) + Vector(0.41, 0.33, 0.2);
  append(mesh, patch);
  const PlacedStroke placed =
      place_in_view(mesh, sight_of({{0.1, 0.45, 0}, {0.55, 0.45, 0.2}, {0.9, 0.47, 0}}));
  REQUIRE(placed.breaks.size() == 2);
  CHECK(placed.warnings.size() == 2);
  for (std::size_t i = 0; i < placed.points.size(); ++i) {
    const bool front = i >= placed.breaks[0] && i < placed.breaks[1];
    CHECK(placed.points[i].z() == Approx(front ? 0.2 : 0).margin(1e-9));
    // Behind the patch nothing is drawn: seen from the eye it covers x from about 0.4 to 0.73 of the sheet.
    if (!front) CHECK((placed.points[i].x() < 0.42 || placed.points[i].x() > 0.70));
  }
  CHECK(trace(mesh, placed.points, placed.breaks).sub_strokes.size() == 3);
}

TEST_CASE("place_view_stroke: where lines of sight miss, the stroke runs over the border, or is cut") {
  const Mesh mesh = grid(20, 20);
  const PlacedStroke over = place_in_view(mesh, sight_of({{0.5, 0.52, 0}, {0.63, 0.83, 0}, {0.7, 1.4, 0}}));
  CHECK(over.breaks.empty());
  REQUIRE(over.warnings.size() == 1);
  CHECK(over.warnings[0].find("stroke \"fold\": point 2 misses the garment") == 0);
  CHECK(over.points.back().y() > 1.025);
  const TracedStroke traced = trace(mesh, over.points);
  REQUIRE(traced.sub_strokes.size() == 1);
  const auto& last = traced.sub_strokes[0].faces.back();
  REQUIRE(last.exit);
  CHECK(mesh.is_border(mesh.edge(last.exit->halfedge)));

  Mesh two = grid(10, 10, 0.4, 1);
  Mesh right = grid(10, 10, 0.4, 1);
  for (Vertex v : right.vertices()) right.point(v) = right.point(v) + Vector(0.6, 0, 0);
  append(two, right);
  const PlacedStroke gap = place_in_view(two, sight_of({{0.2, 0.52, 0}, {0.5, 0.53, 0}, {0.8, 0.52, 0}}));
  CHECK(gap.breaks.size() == 1);
  CHECK(trace(two, gap.points, gap.breaks).sub_strokes.size() == 2);
}

TEST_CASE("place_view_stroke: over the outline of a ball the stroke stays on the side that is seen") {
  const Mesh ball = icosphere(4, 0.5);
  const Point eye(0, 0, 4);
  std::vector<SightLine> sight = sight_of({{0.1, 0.05, 0.4}, {0.3, 0.1, 0.3}, {0.9, 0.2, 0}}, eye);
  const PlacedStroke placed = place_in_view(ball, sight);
  CHECK(placed.breaks.empty());
  for (const Point& p : placed.points) CHECK((p - CGAL::ORIGIN) * (eye - p) > -0.02);
  CHECK(placed.points.back().x() > 0.46);
}

TEST_CASE("place_view_stroke: closed strokes and parallel lines of sight") {
  const Mesh mesh = bumpy(0.03);
  std::vector<SightLine> sight;
  for (const auto& [x, y] : {std::pair{0.2, 0.2}, {0.8, 0.25}, {0.5, 0.8}})
    sight.push_back({{x, y, 5}, {0, 0, -1}});
  const PlacedStroke placed = place_in_view(mesh, sight, true, true);
  CHECK(placed.closed);
  CHECK(placed.breaks.empty());
  CHECK(distance(placed.points.front(), placed.points.back()) > 0.001);
  CHECK(distance(placed.points.front(), placed.points.back()) < 0.1);
  for (const Point& p : placed.points) {
    const double side = std::min({std::abs(-(p.x() - 0.2) * 0.05 + (p.y() - 0.2) * 0.6) / 0.602,
                                  std::abs(-(p.x() - 0.8) * 0.55 - (p.y() - 0.25) * 0.3) / 0.626,
                                  std::abs((p.x() - 0.5) * 0.6 - (p.y() - 0.8) * 0.3) / 0.671});
    CHECK(side < 1e-4);
  }
}

TEST_CASE("place_view_stroke: it tells each run of misses once") {
  const Mesh mesh = grid(20, 20);
  const PlacedStroke placed = place_in_view(
      mesh, sight_of({{-2, 0.5, 0}, {-1, 0.5, 0}, {0.3, 0.52, 0}, {0.4, 3, 0}, {0.6, 0.52, 0}}));
  REQUIRE(placed.warnings.size() == 2);
  CHECK(placed.warnings[0].find("points 0 to 1 miss the garment") != std::string::npos);
  CHECK(placed.warnings[1].find("point 3 misses the garment") != std::string::npos);
  CHECK(placed.breaks.size() == 1);
  CHECK(placed.points.front().x() < -0.02);
}

TEST_CASE("place_view_stroke: the inside of the cloth is told, a stroke that misses everything is refused") {
  Mesh mesh = grid(8, 8);
  const PlacedStroke inside = place_in_view(mesh, sight_of({{0.2, 0.3, 0}, {0.8, 0.6, 0}}, {0.5, 0.5, -3}));
  REQUIRE(inside.warnings.size() == 1);
  CHECK(inside.warnings[0].find("inside of the cloth") != std::string::npos);
  CHECK(inside.breaks.empty());
  CHECK(inside.points.size() > 8);
  CHECK_THROWS_WITH(place_in_view(mesh, sight_of({{2, 2, 0}, {3, 2, 0}})),
                    Catch::StartsWith("stroke \"fold\", point 0: it and all others miss"));
  std::vector<SightLine> bad = sight_of({{0.2, 0.3, 0}, {0.8, 0.6, 0}});
  bad[1].direction = Vector(0, 0, NAN);
  CHECK_THROWS_WITH(place_in_view(mesh, bad),
                    Catch::StartsWith("stroke \"fold\", point 1: its line of sight is not finite"));
}

TEST_CASE("place_view_stroke: lines of sight through edges and vertices hit the layer in front") {
  Mesh mesh = grid(20, 20);
  Mesh behind = grid(3, 3);
  for (Vertex v : behind.vertices()) behind.point(v) = behind.point(v) + Vector(0, 0, -0.5);
  append(mesh, behind);
  const SurfaceProjector projector(mesh);
  for (int i = 1; i < 20; ++i)
    for (int j = 1; j < 40; ++j) {
      const Point target(i / 20., j / 40., 0);
      const auto hit = projector.first_hit(eye_point, normalized(target - eye_point));
      REQUIRE(hit);
      CHECK(distance(hit->position, target) < 1e-9);
    }
}
