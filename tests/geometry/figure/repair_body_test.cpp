// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/figure/repair_body.h"

#include <CGAL/boost/graph/Euler_operations.h>

#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include "geometry/mesh/errors.h"
#include "geometry/mesh/measures.h"
#include "tests/test_meshes.h"
#include "tests/test_paths.h"

using namespace furrow::geometry;
using namespace furrow::tests;

namespace {

/// Closed and consistently wound: every directed edge is there once, with its opposite.
bool is_sealed(const Body& body) {
  std::map<std::pair<int, int>, int> edges;
  for (const auto& t : body.triangles)
    for (std::size_t i = 0; i < 3; ++i) ++edges[{t[i], t[(i + 1) % 3]}];
  for (const auto& [edge, n] : edges)
    if (n != 1 || !edges.count({edge.second, edge.first})) return false;
  return true;
}
double volume(const Body& body) {
  double sum = 0;
  for (const auto& t : body.triangles) {
    const auto p = [&](std::size_t i) { return body.points[static_cast<std::size_t>(t[i])] - CGAL::ORIGIN; };
    sum += CGAL::determinant(p(0), p(1), p(2)) / 6;
  }
  return sum;
}
Mesh turned(const Mesh& mesh) {
  std::vector<std::array<int, 3>> faces;
  for (Face f : mesh.faces()) {
    const Halfedge h = mesh.halfedge(f);
    faces.push_back({static_cast<int>(mesh.source(h).idx()),
                     static_cast<int>(mesh.target(mesh.next(h)).idx()),
                     static_cast<int>(mesh.target(h).idx())});
  }
  return mesh_of({mesh.points().begin(), mesh.points().end()}, faces);
}

}  // namespace

TEST_CASE("repair_body: it leaves a sound body what it is") {
  const Body body = repair_body(icosphere(2));
  CHECK(body.points.size() == 162);
  CHECK(body.triangles.size() == 320);
  CHECK(is_sealed(body));
  CHECK(volume(body) == Approx(*measure(icosphere(2)).volume));
  const BodyReport& r = body.report;
  CHECK(r.dropped_faces + r.merged_points + r.reversed_faces + r.filled_holes + r.self_intersections == 0);
  CHECK(r.components == 1);
  CHECK(r.closed);
}

TEST_CASE("repair_body: it closes holes, small and large") {
  const Body tube = repair_body(cylinder(1, 2, 48, 6));
  CHECK(tube.report.filled_holes == 2);
  CHECK(tube.report.filling_faces == 2 * 46);
  CHECK(is_sealed(tube));
  CHECK(volume(tube) == Approx(2 * 24 * std::sin(2 * 3.14159265358979 / 48)).epsilon(1e-12));  // of a 48-gon
  const Body large = repair_body(cylinder(1, 1, 1500, 1));
  CHECK(large.report.filling_faces == 2 * 1500);
  CHECK(is_sealed(large));
}

TEST_CASE("repair_body: it turns inside-out bodies, part by part") {
  const Body body = repair_body(turned(icosphere(2)));
  CHECK(body.report.reversed_faces == 320);
  CHECK(volume(body) > 4);
  Mesh parts = icosphere(2);
  append(parts, turned(icosphere(1, 0.5, {3, 0, 0})));
  const Body two = repair_body(parts);
  CHECK(two.report.components == 2);
  CHECK(two.report.reversed_faces == 80);
  CHECK(volume(two) ==
        Approx(*measure(icosphere(2)).volume + *measure(icosphere(1, 0.5)).volume).epsilon(1e-12));
}

TEST_CASE("repair_body: parts that cross are counted, and wound outwards each") {
  Mesh parts = icosphere(2);
  append(parts, turned(icosphere(2, 1, {1.03, 0.02, 0.01})));
  const Body body = repair_body(parts);
  CHECK(body.report.self_intersections > 10);
  CHECK(body.report.reversed_faces == 320);
  CHECK(volume(body) == Approx(2 * *measure(icosphere(2)).volume).epsilon(1e-12));
}

TEST_CASE("repair_body: it merges parted seams and drops faces without three corners") {
  Mesh mesh = cube();
  mesh.point(Vertex(7)) = mesh.point(Vertex(6));  // an edge of the cube shrinks to a point
  const Body squeezed = repair_body(mesh);
  CHECK(squeezed.report.merged_points == 1);
  CHECK(squeezed.report.dropped_faces >= 2);
  CHECK(is_sealed(squeezed));
  Mesh halves;  // two half tubes that meet along parted seams
  for (int half = 0; half < 2; ++half) {
    Mesh sheet = grid(16, 4);
    for (Vertex v : sheet.vertices()) {
      const int i = static_cast<int>(v.idx()) % 17;
      const double angle = 3.14159265358979323846 * ((i + 16 * half) % 32) / 16;
      sheet.point(v) = {std::sin(angle), sheet.point(v).y(), std::cos(angle)};
    }
    append(halves, sheet);
  }
  const Body joined = repair_body(halves);
  CHECK(joined.report.merged_points == 10);
  CHECK(joined.report.filled_holes == 2);
  CHECK(is_sealed(joined));
}

TEST_CASE("repair_body: two fans of 1,500 faces each, in any order, are a body as it is", "[long]") {
  constexpr int n = 1500;
  std::vector<Point> points{{0, 1, 0}, {0, 0, 0}};
  std::vector<std::array<int, 3>> faces;
  for (int i = 0; i < n; ++i) {
    const double angle = 2 * 3.14159265358979 * i / n;
    points.push_back({std::cos(angle), 0, std::sin(angle)});
    const int at = 2 + 7 * i % n, next = 2 + (7 * i + 1) % n;  // each seventh, so that no face joins the last
    faces.push_back({0, next, at});
    faces.push_back({1, at, next});
  }
  const Body body = repair_body(mesh_of(points, faces));
  CHECK(is_sealed(body));
  CHECK(body.report.self_intersections == 0);
  CHECK(body.report.filled_holes == 0);
  CHECK(body.points.size() == points.size());
  CHECK(body.triangles.size() == 2 * n);
  CHECK(volume(body) == Approx(3.14159265358979 / 3).epsilon(1e-4));
}

TEST_CASE("repair_body: it refuses what is no body") {
  CHECK_THROWS_AS(repair_body(Mesh()), ContentError);
  Mesh point = single_triangle();
  for (Vertex v : point.vertices()) point.point(v) = Point(1, 1, 1);
  CHECK_THROWS_AS(repair_body(point), ContentError);
  point.point(Vertex(0)) = Point(0, 0, std::numeric_limits<double>::quiet_NaN());
  CHECK_THROWS_AS(repair_body(point), ContentError);
}

TEST_CASE("repair_body: it seals the real bodies") {
  if (!have_shared()) {
    WARN("skipped: no shared data");
    return;
  }
  const Body body = repair_body(read_plain_obj(shared_dir() / "meshes/pairs/mh_male/body.obj"));
  CHECK(body.report.closed);
  CHECK(is_sealed(body));
  CHECK(volume(body) > 0.04);
  CHECK(volume(body) < 0.12);  // a man, in cubic metres
}
