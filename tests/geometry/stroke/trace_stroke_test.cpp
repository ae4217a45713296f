// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/stroke/trace_stroke.h"

#include <CGAL/boost/graph/Euler_operations.h>

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <set>

#include "geometry/mesh/errors.h"
#include "tests/geometry/insert/insertion_meshes.h"

namespace furrow::tests {

using namespace geometry;

namespace {

TracedStroke trace(const Mesh& mesh, const Stroke& stroke, double h, double max_distance = 0.05) {
  return trace_stroke(mesh, SurfaceProjector(mesh), stroke, {max_distance, h});
}

Stroke polyline(const std::vector<Point>& points) {
  Stroke stroke;
  stroke.points.assign(points.begin(), points.end());
  return stroke;
}

/// Sheets at z = 0 (normals up) and z = gap, 20 x 20 cells each; a fold at x = 1 joins them if wanted.
Mesh two_layers(double gap, bool joined) {
  Mesh mesh = union_jack_sheet(20);
  const auto lower = static_cast<std::uint32_t>(mesh.number_of_vertices());
  Mesh upper = union_jack_sheet(20);
  for (Vertex v : upper.vertices()) mesh.add_vertex(upper.point(v) + Vector(0, 0, gap));
  for (Face f : upper.faces()) {
    const auto c = corners_of(upper, f);
    mesh.add_face(Vertex(c[0] + lower), Vertex(c[2] + lower), Vertex(c[1] + lower));
  }
  for (std::uint32_t j = 0; joined && j < 20; ++j) {
    const Vertex a(j * 21 + 20), b((j + 1) * 21 + 20), c(a + lower), d(b + lower);
    mesh.add_face(a, c, b);
    mesh.add_face(b, c, d);
  }
  return mesh;
}

/// Heights of the nodes in whole micrometres.
std::set<double> heights_of(const Mesh& mesh, const TracedStroke& traced) {
  std::set<double> heights;
  for (const SubStroke& part : traced.sub_strokes) {
    for (const CrossedFace& visit : part.faces)
      heights.insert(std::round(1e6 * position_of(mesh, {visit.face, visit.node}).z()));
  }
  return heights;
}

}  // namespace

TEST_CASE("trace_stroke: no crossed face is missed, and each shares an edge with the next") {
  const Mesh mesh = regular_sheet(20, 0.25, 3);
  const Point a(0.13, 0.21, 0), b(0.87, 0.66, 0);
  const TracedStroke traced = trace(mesh, polyline({a, b}), 0.05);
  REQUIRE(traced.sub_strokes.size() == 1);
  const auto& faces = traced.sub_strokes[0].faces;
  std::set<Face> crossed;
  for (std::size_t i = 0; i < faces.size(); ++i) {
    crossed.insert(faces[i].face);
    for (double value : faces[i].node) CHECK(value > 0);
    if (i == 0) continue;
    CHECK(mesh.opposite(faces[i - 1].exit->halfedge) == faces[i].entry->halfedge);
    CHECK(faces[i].stroke_parameter >= faces[i - 1].stroke_parameter);
  }
  CHECK(crossed.size() == faces.size());
  const SurfaceProjector projector(mesh);
  for (int i = 0; i <= 5000; ++i)
    CHECK(crossed.count(projector.closest(a + (i / 5000.0) * (b - a)).point.face) == 1);
  CHECK_FALSE(faces.front().entry.has_value());
  CHECK_FALSE(faces.back().exit.has_value());
}

TEST_CASE("trace_stroke: a node lies at the mean of its samples, else in the middle of the part inside") {
  const Mesh mesh = regular_sheet(10);
  const Face face(0);
  const Point p = position_of(mesh, {face, {0.5, 0.3, 0.2}}), q = position_of(mesh, {face, {0.2, 0.3, 0.5}});
  const TracedStroke inside = trace(mesh, polyline({p, q}), 0.1);
  REQUIRE(inside.sub_strokes[0].faces.size() == 1);
  CHECK(inside.sub_strokes[0].faces[0].samples == 2);
  CHECK(inside.sub_strokes[0].faces[0].node[0] == Approx(0.35).epsilon(1e-3));
  CHECK(inside.sub_strokes[0].faces[0].node[1] == Approx(0.3).epsilon(1e-3));
  const TracedStroke across = trace(mesh, polyline({Point(0.12, 0.11, 0), Point(0.86, 0.63, 0)}), 0.1);
  for (const CrossedFace& visit : across.sub_strokes[0].faces) {
    if (visit.samples > 0) continue;
    const Point middle = CGAL::midpoint(visit.entry->position, visit.exit->position);
    CHECK(CGAL::squared_distance(position_of(mesh, {visit.face, visit.node}), middle) < 1e-24);
  }
}

TEST_CASE("trace_stroke: a stroke never leaps to a layer 5 mm away") {
  for (bool joined : {false, true}) {
    const Mesh mesh = two_layers(0.005, joined);
    Stroke stroke;
    // Every other point lies nearer to the upper layer.
    for (int i = 0; i <= 30; ++i)
      stroke.points.push_back(Point(0.2 + 0.022 * i, 0.31 + 0.01 * i, i % 2 ? 0.0045 : 0.0002));
    const TracedStroke traced = trace(mesh, stroke, 0.055);
    CHECK(traced.sub_strokes.size() == 1);
    CHECK(heights_of(mesh, traced).size() == 1);
    CHECK(traced.samples.size() == 31);
    CHECK(traced.warnings.empty());
  }
}

TEST_CASE("trace_stroke: a stroke breaks, with a warning, where no way leads on") {
  Mesh mesh = union_jack_sheet(20);
  const auto n = static_cast<std::uint32_t>(mesh.number_of_vertices());
  const Mesh far = union_jack_sheet(20);
  for (Vertex v : far.vertices()) mesh.add_vertex(far.point(v) + Vector(0, 0, 0.3));
  for (Face f : far.faces()) {
    const auto c = corners_of(far, f);
    mesh.add_face(Vertex(c[0] + n), Vertex(c[1] + n), Vertex(c[2] + n));
  }
  Stroke stroke =
      polyline({Point(0.3, 0.31, 0), Point(0.5, 0.52, 0), Point(0.51, 0.53, 0.3), Point(0.7, 0.62, 0.3)});
  stroke.name = "leap";
  const TracedStroke traced = trace(mesh, stroke, 0.055);
  REQUIRE(traced.sub_strokes.size() == 2);
  REQUIRE(traced.warnings.size() == 1);
  CHECK_THAT(traced.warnings[0], Catch::Contains("leap"));
  CHECK(heights_of(mesh, traced).size() == 2);
}

TEST_CASE("trace_stroke: a stroke ends at the border and starts again where it comes back") {
  Mesh mesh = union_jack_sheet(20);
  for (Face f : mesh.faces()) {  // a hole of 0.2 x 0.4 m in the middle
    const Point p = position_of(mesh, {f, {1.0 / 3, 1.0 / 3, 1.0 / 3}});
    if (std::abs(p.x() - 0.5) < 0.1 && std::abs(p.y() - 0.5) < 0.2)
      CGAL::Euler::remove_face(mesh.halfedge(f), mesh);
  }
  for (int points : {2, 5, 61}) {
    CAPTURE(points);
    Stroke stroke;
    for (int i = 0; i < points; ++i) {
      stroke.points.push_back(Point(0.11 + 0.83 * i / (points - 1), 0.47 + 0.08 * i / (points - 1), 0));
    }
    const TracedStroke traced = trace(mesh, stroke, 0.055, 0.2);
    REQUIRE(traced.sub_strokes.size() == 2);
    const EdgeCrossing end = *traced.sub_strokes[0].faces.back().exit,
                       start = *traced.sub_strokes[1].faces.front().entry;
    CHECK(mesh.is_border(mesh.opposite(end.halfedge)));
    CHECK(mesh.is_border(mesh.opposite(start.halfedge)));
    CHECK(end.position.x() == Approx(0.4));
    CHECK(start.position.x() == Approx(0.6));
  }
}

TEST_CASE("trace_stroke: points a little beyond the border are taken, points far beyond are not") {
  const Mesh mesh = union_jack_sheet(20);
  const TracedStroke near = trace(mesh, polyline({Point(0.5, 0.93, 0), Point(0.52, 1.02, 0)}), 0.055);
  CHECK(near.samples.size() == 2);
  const TracedStroke far = trace(mesh, polyline({Point(0.5, 0.93, 0), Point(0.52, 1.04, 0)}), 0.055);
  CHECK(far.samples.size() == 1);
  CHECK(far.sub_strokes[0].faces.back().exit->position.y() == Approx(1));
  CHECK_THROWS_AS(trace(mesh, polyline({Point(0.5, 1.04, 0), Point(0.52, 1.04, 0)}), 0.055), ContentError);
}

TEST_CASE("trace_stroke: a two-point chord follows a strongly curved surface") {
  const Mesh mesh = cylinder(40);
  const double r = 0.5 / std::numbers::pi;
  Stroke stroke = polyline({Point(0, 0.3, r), Point(r * std::sin(2.5), 0.6, r * std::cos(2.5))});
  const TracedStroke traced = trace(mesh, stroke, 0.025);
  REQUIRE(traced.sub_strokes.size() == 1);
  CHECK(traced.warnings.empty());
  CHECK(traced.sub_strokes[0].faces.size() > 20);
}

TEST_CASE("trace_stroke: along a ray the first face that faces the ray's origin is taken") {
  const Mesh mesh = cylinder(40);
  Stroke stroke = polyline({Point(-0.05, 0.3, 0.18), Point(0.05, 0.6, 0.18)});
  stroke.direction = Vector(0, 0, -2);
  const TracedStroke traced = trace(mesh, stroke, 0.025);
  for (const ProjectedSample& sample : traced.samples) CHECK(sample.position.z() > 0.1);
  CHECK(traced.samples[1].position.x() == Approx(0.05).margin(1e-4));
  CHECK_THROWS_WITH(trace(mesh, stroke, 0.025, 0.01), Catch::Contains("point 0") && Catch::Contains("10 mm"));
  stroke.points[1] = Point(0.5, 0.6, 0.18);
  CHECK_THROWS_WITH(trace(mesh, stroke, 0.025), Catch::Contains("misses"));
}

TEST_CASE("trace_stroke: projection tells distance and how far a point lies beyond the border") {
  const Mesh mesh = union_jack_sheet(4);
  const SurfaceProjector projector(mesh);
  const SurfaceHit above = projector.closest(Point(0.4, 0.3, 0.2));
  CHECK(above.distance == Approx(0.2));
  CHECK_FALSE(above.on_border);
  CHECK(above.beyond_border == 0);
  CHECK(CGAL::squared_distance(position_of(mesh, above.point), Point(0.4, 0.3, 0)) < 1e-28);
  const SurfaceHit beyond = projector.closest(Point(0.4, 1.3, 0.4));
  CHECK(beyond.on_border);
  CHECK(beyond.distance == Approx(0.5));
  CHECK(beyond.beyond_border == Approx(0.3));
  CHECK(projector.closest(Point(1.3, 1.4, 0)).beyond_border == Approx(0.5));
  CHECK_THROWS_AS(SurfaceProjector(Mesh()), ContentError);
}

TEST_CASE("trace_stroke: a stroke with breaks has parts that nothing joins") {
  const Mesh mesh = union_jack_sheet(20);
  Stroke stroke = polyline({Point(0.11, 0.21, 0), Point(0.32, 0.22, 0), Point(0.61, 0.51, 0),
                            Point(0.91, 0.52, 0), Point(0.73, 0.84, 0)});
  stroke.breaks = {2, 4};
  const TracedStroke traced = trace(mesh, stroke, 0.05);
  REQUIRE(traced.sub_strokes.size() == 3);
  CHECK(traced.warnings.empty());
  CHECK(traced.sub_strokes[2].faces.size() == 1);
  for (const CrossedFace& visit : traced.sub_strokes[0].faces)
    CHECK(position_of(mesh, {visit.face, visit.node}).x() < 0.35);
  for (const CrossedFace& visit : traced.sub_strokes[1].faces)
    CHECK(position_of(mesh, {visit.face, visit.node}).x() > 0.58);
  // A part may begin beyond the border: it enters there, and the one before does not leave.
  stroke.points[2] = Point(0.6, 1.04, 0);
  const TracedStroke entering = trace(mesh, stroke, 0.05);
  REQUIRE(entering.sub_strokes.size() == 3);
  CHECK_FALSE(entering.sub_strokes[0].faces.back().exit);
  REQUIRE(entering.sub_strokes[1].faces.front().entry);
  CHECK(mesh.is_border(mesh.edge(entering.sub_strokes[1].faces.front().entry->halfedge)));
  for (const auto& breaks : {std::vector<std::size_t>{0}, {5}, {2, 2}, {3, 1}}) {
    stroke.breaks = breaks;
    CHECK_THROWS_WITH(trace(mesh, stroke, 0.05), Catch::Contains("out of place"));
  }
  stroke.breaks = {2};
  stroke.closed = true;
  CHECK_THROWS_AS(trace(mesh, stroke, 0.05), ContentError);
}

}  // namespace furrow::tests
