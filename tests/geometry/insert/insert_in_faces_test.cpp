// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/insert/insert_in_faces.h"

#include <CGAL/boost/graph/helpers.h>
#include <CGAL/subdivision_method_3.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <set>

#include "geometry/mesh/errors.h"
#include "geometry/rest/rest_state.h"
#include "tests/geometry/insert/insertion_checks.h"
#include "tests/geometry/insert/insertion_meshes.h"

namespace furrow::tests {

using namespace geometry;

namespace {

std::vector<FacePoint> centroids(const Mesh& mesh) {
  std::vector<FacePoint> points;
  for (Face f : mesh.faces()) points.push_back({f, {1.0 / 3, 1.0 / 3, 1.0 / 3}});
  return points;
}

std::set<std::set<Vertex>> faces_of(const Mesh& mesh) {
  std::set<std::set<Vertex>> faces;
  for (Face f : mesh.faces()) {
    const auto c = corners_of(mesh, f);
    faces.insert({c[0], c[1], c[2]});
  }
  return faces;
}

}  // namespace

TEST_CASE(
    "insert_in_faces: all faces of a closed mesh with the paper's rule give CGAL's sqrt(3) subdivision") {
  for (const Mesh& closed : {torus(12, 8), icosahedron()}) {
    Mesh ours = closed, theirs = closed;
    InsertionOptions options;
    options.rule = InsertionRule::paper;
    const InsertionReport report = insert_in_faces(ours, centroids(ours), options);
    CGAL::Subdivision_method_3::Sqrt3_subdivision(theirs, CGAL::parameters::number_of_iterations(1));
    CHECK(report.inserted == closed.number_of_faces());
    CHECK(report.flipped == closed.number_of_edges());
    CHECK(ours.number_of_faces() == 3 * closed.number_of_faces());
    CHECK(faces_of(ours) == faces_of(theirs));
    CHECK(CGAL::is_valid_polygon_mesh(ours));
  }
}

TEST_CASE("insert_in_faces: the rest metric does not see how the mesh lies in space") {
  Mesh flat = regular_sheet(8, 0.2), bent = flat;
  ensure_rest_lengths(flat);
  ensure_rest_lengths(bent);
  for (Vertex v : bent.vertices()) {
    const Point& p = bent.point(v);
    bent.point(v) = Point(1.2 * p.x(), p.y() * p.y(), 0.3 * std::sin(5 * p.x()));
  }
  std::vector<FacePoint> points;
  for (Face f : flat.faces()) {
    if (f % 3 == 0) points.push_back({f, {0.2, 0.3, 0.5}});
  }
  const InsertionReport a = insert_in_faces(flat, points), b = insert_in_faces(bent, points);
  CHECK(a.flipped == b.flipped);
  CHECK(a.flipped > 0);
  CHECK(faces_of(flat) == faces_of(bent));
  const auto rest = *find_map(flat, attribute::rest_length),
             carried = *find_map(bent, attribute::rest_length);
  double worst = 0;
  for (Edge e : flat.edges()) {
    const double space =
        std::sqrt(CGAL::squared_distance(flat.point(flat.vertex(e, 0)), flat.point(flat.vertex(e, 1))));
    worst = std::max({worst, std::abs(rest[e] - space), std::abs(carried[e] - rest[e])});
  }
  CHECK(worst < 1e-14);
  CHECK(audit_rest_metric(flat).area == Approx(audit_rest_metric(regular_sheet(8, 0.2)).area).epsilon(1e-13));
}

TEST_CASE("insert_in_faces: it refuses what it cannot do and leaves the mesh alone") {
  Mesh mesh = regular_sheet(4);
  const std::string before = fingerprint(mesh);
  const Face f(3);
  const auto insert = [&](std::vector<FacePoint> points, InsertionOptions options = {}) {
    insert_in_faces(mesh, points, options);
  };
  CHECK_THROWS_AS(insert({{f, {0.3, 0.3, 0.4}}, {f, {0.3, 0.3, 0.4}}}), std::invalid_argument);
  CHECK_THROWS_AS(insert({{f, {0, 0.5, 0.5}}}), std::invalid_argument);
  CHECK_THROWS_AS(insert({{f, {0.5, 0.5, 0.5}}}), std::invalid_argument);
  CHECK_THROWS_AS(insert({{Face(1000), {0.3, 0.3, 0.4}}}), std::invalid_argument);
  InsertionOptions options;
  options.min_barycentric = 0.4;
  CHECK_THROWS_WITH(insert({{f, {0.3, 0.3, 0.4}}}, options),
                    Catch::Contains("min_barycentric") && Catch::Contains("0.4"));
  CHECK(fingerprint(mesh) == before);
  ensure_rest_lengths(mesh)[mesh.edge(mesh.halfedge(f))] = 10;
  CHECK_THROWS_AS(insert({{f, {0.3, 0.3, 0.4}}}), ContentError);
  Mesh quad;
  const auto v = [&](double x, double y) { return quad.add_vertex(Point(x, y, 0)); };
  quad.add_face(v(0, 0), v(1, 0), v(1, 1), v(0, 1));
  CHECK_THROWS_AS(insert_in_faces(quad, std::vector<FacePoint>{}), ContentError);
}

TEST_CASE("insert_in_faces: clamping keeps the sum and the floor") {
  for (const Barycentrics& b :
       {Barycentrics{1, 0, 0}, Barycentrics{0.5, 0.5, 0}, Barycentrics{0.1, 0.2, 0.7}}) {
    const Barycentrics c = clamped(b, 0.2);
    CHECK(c[0] + c[1] + c[2] == Approx(1).epsilon(1e-15));
    for (double value : c) CHECK(value >= 0.2);
  }
  CHECK(clamped({0.3, 0.3, 0.4}, 0)[2] == Approx(0.4));
  CHECK(clamped({1, 0, 0}, 1.0 / 3)[0] == Approx(1.0 / 3));
}

}  // namespace furrow::tests
