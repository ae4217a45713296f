// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/stroke/pierced_faces.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <catch2/catch.hpp>
#include <limits>
#include <numeric>
#include <random>

#include "geometry/mesh/errors.h"
#include "tests/geometry/figure/triangle_soup.h"
#include "tests/test_meshes.h"

using namespace furrow::geometry;
using namespace furrow::tests;

namespace {

int count(const Mesh& mesh, const TriangleSoup& surface) {
  const std::vector<char> pierced = pierced_faces(mesh, surface.points, surface.triangles);
  REQUIRE(pierced.size() == mesh.num_faces());
  return std::accumulate(pierced.begin(), pierced.end(), 0);
}

}  // namespace

TEST_CASE("pierced_faces: a needle through the middle of a face, all corners of which lie outside") {
  const Mesh sheet = grid(1, 1);  // two faces over the unit square, z = 0
  const auto needle = [](double tip) {
    return TriangleSoup(mesh_of({{0.7, 0.2, tip}, {0.71, 0.2, -1}, {0.7, 0.21, -1}, {0.69, 0.19, -1}},
                                {{0, 1, 2}, {0, 2, 3}, {0, 3, 1}, {1, 3, 2}}));
  };
  CHECK(count(sheet, needle(1)) == 1);
  CHECK(count(sheet, needle(1e-300)) == 1);   // by the smallest step
  CHECK(count(sheet, needle(0)) == 1);        // touches
  CHECK(count(sheet, needle(-1e-300)) == 0);  // just does not
}

TEST_CASE(
    "pierced_faces: a sheet through a ball is pierced along their circle, and nowhere inside or outside") {
  const TriangleSoup ball(icosphere(3, 0.3));
  Mesh sheet = grid(40, 40);
  for (Vertex v : sheet.vertices()) sheet.point(v) = sheet.point(v) - Vector(0.5, 0.5, 0.01);
  const std::vector<char> pierced = pierced_faces(sheet, ball.points, ball.triangles);
  int crossing = 0;
  for (Face f : sheet.faces()) {
    double nearest = 10, farthest = 0;  // of the corners from the axis
    for (Vertex v : sheet.vertices_around_face(sheet.halfedge(f))) {
      const double r = std::hypot(sheet.point(v).x(), sheet.point(v).y());
      nearest = std::min(nearest, r);
      farthest = std::max(farthest, r);
    }
    crossing += pierced[f.idx()];
    if (pierced[f.idx()]) CHECK((nearest < 0.302 && farthest > 0.295));
    if (nearest < 0.295 && farthest > 0.302) CHECK(pierced[f.idx()]);
  }
  CHECK(crossing > 50);
  CHECK(count(icosphere(3, 0.29), ball) == 0);
  CHECK(count(icosphere(3, 0.31), ball) == 0);
}

TEST_CASE("pierced_faces: it equals all pairs tested one by one") {
  using Exact = CGAL::Exact_predicates_inexact_constructions_kernel;
  std::mt19937 engine(7);
  const auto uniform = [&] { return engine() / static_cast<double>(std::mt19937::max()); };
  const auto soup = [&](int n) {
    std::vector<Point> points;
    std::vector<std::array<int, 3>> triangles;
    for (int i = 0; i < n; ++i) {
      const Point c(uniform(), uniform(), uniform());
      for (int k = 0; k < 3; ++k) points.push_back(c + 0.2 * Vector(uniform(), uniform(), uniform()));
      triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
    }
    return mesh_of(points, triangles);
  };
  const Mesh cloth = soup(80);
  const TriangleSoup body(soup(90));
  const auto shape = [](const Point& a, const Point& b, const Point& c) {
    const auto p = [](const Point& q) { return Exact::Point_3(q.x(), q.y(), q.z()); };
    return Exact::Triangle_3(p(a), p(b), p(c));
  };
  const TriangleSoup faces(cloth);
  int expected = 0;
  for (const auto& s : faces.triangles) {
    bool hit = false;
    for (const auto& t : body.triangles)
      hit = hit || CGAL::do_intersect(shape(faces.points[s[0]], faces.points[s[1]], faces.points[s[2]]),
                                      shape(body.points[t[0]], body.points[t[1]], body.points[t[2]]));
    expected += hit;
  }
  REQUIRE(expected > 10);
  REQUIRE(expected < 80);
  CHECK(count(cloth, body) == expected);
}

TEST_CASE("pierced_faces: what is no surface is refused, faces without area are left out") {
  Mesh sheet = grid(2, 2);
  const TriangleSoup ball(icosphere(1, 1));
  CHECK(count(sheet, ball) > 0);
  CHECK_THROWS_AS(pierced_faces(sheet, ball.points, std::vector<std::array<int, 3>>{{0, 1, 99}}),
                  ContentError);
  std::vector<Point> broken = ball.points;
  broken[3] = Point(0, std::numeric_limits<double>::quiet_NaN(), 0);
  CHECK_THROWS_AS(pierced_faces(sheet, broken, ball.triangles), ContentError);
  CHECK(count(sheet, TriangleSoup(Mesh())) == 0);
  for (Vertex v : sheet.vertices()) sheet.point(v) = Point(0, 0, 0.5 + 0.5 * double(v.idx()));
  CHECK(count(sheet, ball) == 0);
  sheet.point(Vertex(3)) = Point(0, std::numeric_limits<double>::infinity(), 0);
  CHECK_THROWS_AS(pierced_faces(sheet, ball.points, ball.triangles), ContentError);
}
