// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/insert/insert_along_stroke.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "geometry/mesh/errors.h"
#include "geometry/rest/rest_metric.h"
#include "geometry/stroke/project_onto_surface.h"
#include "tests/geometry/insert/insertion_checks.h"
#include "tests/geometry/insert/insertion_meshes.h"

namespace furrow::tests {

using namespace geometry;

namespace {

Stroke diagonal() {
  Stroke stroke;
  for (int i = 0; i <= 40; ++i) stroke.points.push_back(Point(0.22 + 0.015 * i, 0.27 + 0.011 * i, 0));
  return stroke;
}

/// Texture, colour, groups and materials; where `seam`, the half x > 0.5 has another group and texture chart.
Mesh dressed_sheet(bool seam) {
  Mesh mesh = union_jack_sheet(20);
  auto texture = ensure_map(mesh, attribute::texture);
  auto color = ensure_map(mesh, attribute::color);
  auto group = ensure_map(mesh, attribute::group);
  auto material = ensure_map(mesh, attribute::material);
  auto mass = ensure_map(mesh, attribute::mass);
  auto bending = ensure_map(mesh, attribute::bending_rest_length);
  for (Vertex v : mesh.vertices()) {
    color[v] = {mesh.point(v).x(), mesh.point(v).y(), 0.5, 1};
    mass[v] = 0.001;
  }
  for (Edge e : mesh.edges()) bending[e] = 0.07;
  for (Face f : mesh.faces()) {
    const bool right = seam && position_of(mesh, {f, {1.0 / 3, 1.0 / 3, 1.0 / 3}}).x() > 0.5;
    group[f] = right ? 1 : 0;
    material[f] = 4;
    for (Halfedge h : halfedges_of(mesh, f)) {
      const Point& p = mesh.point(mesh.target(h));
      texture[h] = {2 * p.x() + (right ? 10 : 0), 3 * p.y()};
    }
  }
  return mesh;
}

/// Texture coordinates, groups and colours are what the position says.
void check_dress(const Mesh& mesh, bool seam) {
  const auto texture = *find_map(mesh, attribute::texture);
  const auto color = *find_map(mesh, attribute::color);
  const auto group = *find_map(mesh, attribute::group);
  const auto material = *find_map(mesh, attribute::material);
  double worst = 0;
  std::size_t wrong = 0;
  for (Face f : mesh.faces()) {
    const bool right = seam && position_of(mesh, {f, {1.0 / 3, 1.0 / 3, 1.0 / 3}}).x() > 0.5;
    wrong += group[f] != (right ? 1 : 0) || material[f] != 4;
    for (Halfedge h : halfedges_of(mesh, f)) {
      const Point& p = mesh.point(mesh.target(h));
      worst = std::max(worst, std::abs(texture[h][0] - 2 * p.x() - (right ? 10 : 0)));
      worst = std::max(worst, std::abs(texture[h][1] - 3 * p.y()));
    }
  }
  for (Vertex v : mesh.vertices()) {
    worst = std::max(
        {worst, std::abs(color[v][0] - mesh.point(v).x()), std::abs(color[v][1] - mesh.point(v).y())});
  }
  CHECK(wrong == 0);
  CHECK(worst < 1e-12);
}

}  // namespace

TEST_CASE(
    "insert_along_stroke: texture, colour, groups and materials survive, masses and bending springs become "
    "unset") {
  Mesh mesh = dressed_sheet(false);
  const std::size_t old_vertices = mesh.number_of_vertices();
  const Insertion insertion = insert_along_stroke(mesh, diagonal(), 3);
  CHECK(insertion.report.flipped > 40);
  check_dress(mesh, false);
  const auto mass = *find_map(mesh, attribute::mass);
  const auto bending = *find_map(mesh, attribute::bending_rest_length);
  for (Vertex v : mesh.vertices()) CHECK(std::isnan(mass[v]) == (v >= old_vertices));
  for (Face f : insertion.report.changed_faces) {
    for (Halfedge h : halfedges_of(mesh, f)) CHECK(std::isnan(bending[mesh.edge(h)]));
  }
}

TEST_CASE("insert_along_stroke: a seam is never flipped, but split where the line crosses it") {
  Mesh mesh = dressed_sheet(true);
  Mesh before = mesh;
  ensure_rest_lengths(before);
  const Insertion insertion = insert_along_stroke(mesh, diagonal(), 0);
  CHECK(faults_of_insertion(before, mesh, insertion, true) == std::vector<std::string>{});
  check_dress(mesh, true);
  CHECK(insertion.report.split_edges.size() == 1);
  CHECK(insertion.report.refused_flips.at(Refusal::seam) > 0);
  // No edge leads from the left to the right of the seam.
  for (Edge e : mesh.edges()) {
    const double a = mesh.point(mesh.vertex(e, 0)).x() - 0.5, b = mesh.point(mesh.vertex(e, 1)).x() - 0.5;
    CHECK(a * b > -1e-12);
  }
  const SplitEdge& split = insertion.report.split_edges[0];
  CHECK(mesh.point(split.vertex).x() == Approx(0.5));
  CHECK(mesh.halfedge(split.from, split.vertex).is_valid());
  CHECK_FALSE(mesh.halfedge(split.from, split.to).is_valid());
}

TEST_CASE("insert_along_stroke: a line edge far from any of its vertices is split at the crossing") {
  // One coarse line edge, marked by hand, across a finer stroke.
  Mesh mesh = union_jack_sheet(2);
  ensure_rest_lengths(mesh);
  const Vertex centre = nearest_vertex(mesh, Point(0.5, 0.5, 0)),
               right = nearest_vertex(mesh, Point(1, 0.5, 0));
  auto line = ensure_map(mesh, attribute::line);
  line[centre] = line[right] = 0;
  ensure_map(mesh, attribute::line_edge)[mesh.edge(mesh.halfedge(centre, right))] = true;
  Mesh before = mesh;
  Stroke stroke;
  stroke.points = {Point(0.74, 0.35, 0), Point(0.76, 0.65, 0)};
  InsertionOptions options;
  options.mean_edge = 0.1;
  const Insertion insertion = insert_along_stroke(mesh, stroke, 1, options);
  CHECK(faults_of_insertion(before, mesh, insertion, true) == std::vector<std::string>{});
  REQUIRE(insertion.report.split_edges.size() == 1);
  CHECK(insertion.line.chains[0].size() == 3);
  const Vertex middle = insertion.report.split_edges[0].vertex;
  CHECK(insertion.line.chains[0][1] == middle);
  CHECK(mesh.point(middle).x() == Approx(0.75).margin(1e-3));
  const auto line_edge = *find_map(mesh, attribute::line_edge);
  CHECK(line_edge[mesh.edge(mesh.halfedge(centre, middle))]);
  CHECK(line_edge[mesh.edge(mesh.halfedge(middle, right))]);
}

TEST_CASE("insert_along_stroke: bad strokes are refused by name, and the mesh keeps its bits") {
  Mesh mesh = regular_sheet(10);
  const std::string before = fingerprint(mesh);
  Stroke far = diagonal();
  far.name = "left fold";
  far.points[7] = Point(0.3, 0.3, 0.2);
  CHECK_THROWS_AS(insert_along_stroke(mesh, far, 0), ContentError);
  CHECK_THROWS_WITH(insert_along_stroke(mesh, far, 0),
                    Catch::Contains("left fold") && Catch::Contains("point 7") && Catch::Contains("200 mm"));
  CHECK_THROWS_AS(insert_along_stroke(mesh, Stroke{}, 0), ContentError);
  far.points[7] = Point(std::nan(""), 0, 0);
  CHECK_THROWS_AS(insert_along_stroke(mesh, far, 0), ContentError);
  CHECK_THROWS_AS(insert_along_stroke(mesh, diagonal(), -1), std::invalid_argument);
  InsertionOptions options;
  options.max_distance = 0;
  CHECK_THROWS_WITH(insert_along_stroke(mesh, diagonal(), 0, options), Catch::Contains("max_distance"));
  CHECK(fingerprint(mesh) == before);
  // A face without area beneath the stroke is found while the mesh is worked on.
  ensure_rest_lengths(
      mesh)[mesh.edge(mesh.halfedge(SurfaceProjector(mesh).closest(diagonal().points[9]).point.face))] = 5;
  const std::string degenerate = fingerprint(mesh);
  CHECK_THROWS_AS(insert_along_stroke(mesh, diagonal(), 0), ContentError);
  CHECK(fingerprint(mesh) == degenerate);
}

TEST_CASE("insert_along_stroke: the same input gives the same bits") {
  const auto draw = [] {
    Mesh mesh = irregular_sheet(12);
    InsertionOptions options;
    options.mean_edge = 0.08;
    insert_along_stroke(mesh, diagonal(), 0, options);
    Stroke across = diagonal();
    for (auto& p : across.points) p = {p.x(), 1 - p.y(), 0};
    insert_along_stroke(mesh, across, 1, options);
    return fingerprint(mesh);
  };
  CHECK(draw() == draw());
}

TEST_CASE("insert_along_stroke: a stroke inside one face becomes one vertex") {
  Mesh mesh = regular_sheet(4);
  const std::size_t old_vertices = mesh.number_of_vertices();
  const Face face(5);
  Stroke stroke;
  stroke.points = {position_of(mesh, {face, {0.3, 0.3, 0.4}})};
  for (int points : {1, 2}) {
    Mesh work = mesh;
    if (points == 2) stroke.points.push_back(position_of(mesh, {face, {0.4, 0.3, 0.3}}));
    for (bool closed : {false, true}) {
      Mesh copy = work;
      stroke.closed = closed;
      const Insertion insertion = insert_along_stroke(copy, stroke, 2);
      CHECK(insertion.report.inserted == 1);
      REQUIRE(insertion.line.chains.size() == 1);
      CHECK(insertion.line.chains[0] ==
            std::vector<Vertex>{Vertex(static_cast<std::uint32_t>(old_vertices))});
      REQUIRE(insertion.line.vertices.size() == 1);
      CHECK(insertion.line.vertices[0].normal.z() == Approx(1));
    }
  }
}

TEST_CASE("insert_along_stroke: where no flip is allowed the line goes through corners") {
  Mesh mesh = regular_sheet(20);
  Mesh before = mesh;
  ensure_rest_lengths(before);
  InsertionOptions options;
  std::size_t asked = 0;
  options.may_flip = [&](const std::array<Point, 4>& p) {
    ++asked;
    // The two ends of the edge lie on either side of the line between its apexes.
    const Vector across = p[3] - p[2];
    const double a = CGAL::cross_product(across, p[0] - p[2]).z(),
                 b = CGAL::cross_product(across, p[1] - p[2]).z();
    CHECK(a * b < 0);
    return false;
  };
  const Insertion insertion = insert_along_stroke(mesh, diagonal(), 0, options);
  CHECK(asked > 0);
  CHECK(faults_of_insertion(before, mesh, insertion, true) == std::vector<std::string>{});
  CHECK(insertion.report.flipped + insertion.report.delaunay_flips == 0);
  CHECK(insertion.report.refused_flips.at(Refusal::layer) > 0);
  CHECK(insertion.report.routed > 0);
}

TEST_CASE("insert_along_stroke: the normals of a line point outward") {
  Mesh mesh = cylinder(40);
  Stroke stroke;
  const double r = 0.5 / std::numbers::pi;
  for (int i = 0; i <= 40; ++i)
    stroke.points.push_back(Point(r * std::sin(0.05 * i), 0.2 + 0.01 * i, r * std::cos(0.05 * i)));
  const Insertion insertion = insert_along_stroke(mesh, stroke, 0);
  double last = 0;
  for (const LineVertex& v : insertion.line.vertices) {
    const Point& p = mesh.point(v.vertex);
    CHECK(v.normal * Vector(p.x(), 0, p.z()) / r > 0.95);
    CHECK(v.stroke_parameter >= last - 0.05);
    last = v.stroke_parameter;
  }
}

}  // namespace furrow::tests
