// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/figure/border_seams.h"

#include <rapidcheck.h>

#include <catch2/catch.hpp>
#include <cmath>
#include <functional>
#include <numeric>
#include <random>
#include <set>

#include "geometry/mesh/face_point.h"
#include "geometry/mesh/measures.h"
#include "geometry/mesh/property_names.h"
#include "geometry/mesh/struts.h"
#include "geometry/rest/tie_length.h"
#include "tests/test_meshes.h"

using namespace furrow::geometry;
using namespace furrow::tests;

namespace {

Mesh moved(Mesh mesh, const Vector& by) {
  for (const Vertex v : mesh.vertices()) mesh.point(v) = mesh.point(v) + by;
  return mesh;
}

/// Two sheets of nx x ny cells of 1 m x 1 m, side by side, so far apart.
Mesh two_panels(int nx, int ny, double gap, int ny_right) {
  Mesh mesh = grid(nx, ny);
  append(mesh, moved(grid(nx, ny_right), {1 + gap, 0, gap / 2}));
  return mesh;
}
Mesh two_panels(int nx, int ny, double gap) { return two_panels(nx, ny, gap, ny); }

using Edges = std::set<std::pair<Vertex, Vertex>>;  // both ways

/// The mesh with its faces parted along edges: each fan of faces at a vertex gets a vertex of its own. `at`
/// says where it lies, by the vertex that it was and the middle of the fan's first face.
Mesh cut_along(const Mesh& mesh, const Edges& cut, const std::function<Point(Vertex, const Point&)>& at) {
  const std::size_t n = mesh.num_faces();
  std::vector<std::size_t> fan(3 * n);  // of each corner
  std::iota(fan.begin(), fan.end(), std::size_t{0});
  const auto lowest = [&](std::size_t i) {
    while (fan[i] != i) i = fan[i];
    return i;
  };
  const auto corner = [&](Face f, Vertex v) {
    const auto c = corners_of(mesh, f);
    return 3 * f.idx() + std::size_t(std::find(c.begin(), c.end(), v) - c.begin());
  };
  for (const Edge e : mesh.edges()) {
    const Vertex a = mesh.vertex(e, 0), b = mesh.vertex(e, 1);
    if (mesh.is_border(e) || cut.contains({a, b})) continue;
    const Face f = mesh.face(mesh.halfedge(e)), g = mesh.face(mesh.opposite(mesh.halfedge(e)));
    for (const Vertex v : {a, b}) {
      const std::size_t p = lowest(corner(f, v)), q = lowest(corner(g, v));
      fan[std::max(p, q)] = std::min(p, q);
    }
  }
  std::vector<int> number(3 * n, -1);
  std::vector<Point> points;
  std::vector<std::array<int, 3>> faces;
  for (const Face f : mesh.faces()) {
    const auto c = corners_of(mesh, f);
    const Point middle = CGAL::centroid(mesh.point(c[0]), mesh.point(c[1]), mesh.point(c[2]));
    std::array<int, 3> face{};
    for (std::size_t k = 0; k < 3; ++k) {
      int& its = number[lowest(3 * f.idx() + k)];
      if (its < 0) its = int(points.size()), points.push_back(at(c[k], middle));
      face[k] = its;
    }
    faces.push_back(face);
  }
  return mesh_of(points, faces);
}

/// The mesh with each vertex replaced by the one that it is joined with.
Mesh joined(const Mesh& mesh, const BorderSeams& seams) {
  const std::vector<Vertex> of = joined_vertices(mesh, seams);
  std::vector<int> number(of.size(), -1);
  std::vector<Point> points;
  std::vector<std::array<int, 3>> faces;
  for (const Vertex v : mesh.vertices())
    if (of[v.idx()] == v) number[v.idx()] = int(points.size()), points.push_back(mesh.point(v));
  for (const Face f : mesh.faces()) {
    std::array<int, 3> face{};
    const auto c = corners_of(mesh, f);
    for (std::size_t k = 0; k < 3; ++k) face[k] = number[of[c[k].idx()].idx()];
    faces.push_back(face);
  }
  return mesh_of(points, faces);
}

/// A slit along y = 0.5 from x = 0 to 0.8, edges of 0.1, open by `gap` of its distance from the tip.
Mesh slit(const std::function<double(double)>& gap) {
  const Mesh sheet = grid(10, 10);
  Edges cut;
  for (const Edge e : sheet.edges()) {
    const Vertex a = sheet.vertex(e, 0), b = sheet.vertex(e, 1);
    const auto on = [&](Vertex v) {
      return std::abs(sheet.point(v).y() - 0.5) < 1e-9 && sheet.point(v).x() < 0.85;
    };
    if (on(a) && on(b)) cut.insert({a, b}), cut.insert({b, a});
  }
  return cut_along(sheet, cut, [&](Vertex v, const Point& face) {
    const Point p = sheet.point(v);
    const bool on = std::abs(p.y() - 0.5) < 1e-9 && p.x() < 0.75;
    const double half = on ? gap(0.8 - p.x()) / 2 : 0;
    return Point(p.x(), p.y() + (face.y() > 0.5 ? half : -half), 0);
  });
}

}  // namespace

TEST_CASE("border_seams: the sides of two panels are found, the lower vertices first, and become one sheet") {
  const double gap = GENERATE(1e-9, 1e-5, 8.9e-4);
  const Mesh panels = two_panels(10, 10, gap);
  const BorderSeams seams = find_border_seams(panels);
  REQUIRE(seams.pairs.size() == 11);
  CHECK(seams.apart.size() == 11);
  CHECK(seams.splits.empty());
  CHECK(seams.gap == Approx(std::hypot(gap, gap / 2)));
  CHECK(seams.tolerance == Approx(1e-3));
  for (const auto& [a, b] : seams.pairs) CHECK(a < b);
  const MeshInfo sheet = measure(joined(panels, seams));
  CHECK(sheet.components == 1);
  CHECK(sheet.boundary_loops == 1);
  CHECK(sheet.vertices == 2 * 121 - 11);
}

TEST_CASE(
    "border_seams: beyond a hundredth of an edge, and without any gap unless asked for, there is none") {
  CHECK_FALSE(find_border_seams(two_panels(10, 10, 1.01e-3)).any());
  Mesh touching = grid(10, 10);
  append(touching, moved(grid(10, 10), {1, 0, 0}));
  for (const Vertex v : touching.vertices())  // 0.9 + 0.1 is not 1
    touching.point(v) = {std::round(touching.point(v).x() * 10) / 10, touching.point(v).y(), 0};
  CHECK_FALSE(find_border_seams(touching).any());
  CHECK(find_border_seams(touching, {.closed = true}).pairs.size() == 11);
  CHECK_FALSE(find_border_seams(grid(4, 4)).any());
  CHECK_FALSE(find_border_seams(icosphere(1)).any());
}

TEST_CASE("border_seams: sides that run along each other for three edges are none, for four they are") {
  CHECK_FALSE(find_border_seams(two_panels(4, 2, 1e-5)).any());
  CHECK_FALSE(find_border_seams(two_panels(4, 3, 1e-5)).any());
  CHECK(find_border_seams(two_panels(4, 4, 1e-5)).pairs.size() == 5);
  CHECK(find_border_seams(two_panels(4, 2, 1e-7)).pairs.size() == 3);  // single precision
}

TEST_CASE("border_seams: a slit that opens stays, one whose sides lie along each other is closed") {
  CHECK_FALSE(find_border_seams(slit([](double x) { return 0.05 * x; })).any());
  CHECK_FALSE(find_border_seams(slit([](double x) { return 0.002 * x; })).any());  // four edges, then wider
  CHECK_FALSE(find_border_seams(slit([](double) { return 2e-3; })).any());
  const Mesh cut = slit([](double) { return 5e-4; });
  const BorderSeams seams = find_border_seams(cut);
  CHECK(seams.pairs.size() == 8);
  CHECK(measure(joined(cut, seams)).vertices == 121);
}

TEST_CASE("border_seams: layers with one outline, and what ties hold, are left alone") {
  const Mesh front = grid(6, 6);
  Mesh both = front;
  std::vector<std::array<int, 3>> turned;
  std::vector<Point> points;
  for (const Vertex v : front.vertices()) points.push_back(front.point(v) + Vector(0, 0, 1e-5));
  for (const Face f : front.faces()) {
    const auto c = corners_of(front, f);
    turned.push_back({int(c[0].idx()), int(c[2].idx()), int(c[1].idx())});
  }
  append(both, mesh_of(points, turned));
  CHECK_FALSE(find_border_seams(both).any());

  Mesh tied = two_panels(10, 10, 1e-8);
  std::vector<Strut> ties;
  for (const auto& [a, b] : find_border_seams(tied).pairs) ties.push_back({a, b, tie_length, 100});
  REQUIRE(ties.size() == 11);
  set_struts(tied, ties);
  CHECK_FALSE(find_border_seams(tied).any());
}

TEST_CASE("border_seams: vertices amid the edges of the other side are found, with their places along it") {
  const Mesh yoke = two_panels(10, 10, 1e-5, 30);
  const BorderSeams seams = find_border_seams(yoke);
  CHECK(seams.pairs.size() == 11);
  REQUIRE(seams.splits.size() == 20);
  for (std::size_t i = 0; i < 20; ++i) {
    const SeamSplit& s = seams.splits[i];
    CHECK(s.t == Approx(i % 2 == 0 ? 1 / 3. : 2 / 3.));
    CHECK(yoke.is_border(s.border));
    const Point a = yoke.point(yoke.source(s.border)), b = yoke.point(yoke.target(s.border));
    CHECK(std::sqrt(CGAL::squared_distance(a + s.t * (b - a), yoke.point(s.at))) < 2e-5);
  }
  CHECK_FALSE(find_border_seams(yoke, {.split = false}).any());
}

TEST_CASE("border_seams: of groups that are not to be joined the borders are not seen beside each other") {
  const SeamOptions as_read{.within_groups = true, .split = false};
  Mesh panels = two_panels(10, 10, 1e-5);
  auto group = ensure_map(panels, attribute::group);
  for (const Face f : panels.faces()) group[f] = 0;
  CHECK(find_border_seams(panels, as_read).pairs.size() == 11);
  for (const Face f : panels.faces()) group[f] = panels.point(corners_of(panels, f)[0]).x() > 1;
  CHECK(find_border_seams(panels).pairs.size() == 11);
  CHECK_FALSE(find_border_seams(panels, as_read).any());
}

TEST_CASE(
    "border_seams: a sheet cut along any path, its sides moved by a two-hundredth of an edge, is whole") {
  CHECK(rc::check([] {
    const int n = *rc::gen::inRange(5, 12);
    const Mesh sheet = jittered(n, n, 0.2, unsigned(*rc::gen::inRange(0, 1000)));
    double shortest = 1;
    for (const Edge e : sheet.edges())
      shortest = std::min(shortest, std::sqrt(CGAL::squared_distance(sheet.point(sheet.vertex(e, 0)),
                                                                     sheet.point(sheet.vertex(e, 1)))));
    std::vector<Vertex> path{Vertex(Vertex::size_type(*rc::gen::inRange(0, (n + 1) * (n + 1))))};
    const int length = *rc::gen::inRange(4, 20);
    for (int i = 0; i < length; ++i) {
      std::vector<Vertex> ways;
      for (const Vertex v : sheet.vertices_around_target(sheet.halfedge(path.back())))
        if (!sheet.is_border(v) && std::find(path.begin(), path.end(), v) == path.end()) ways.push_back(v);
      if (ways.empty()) break;
      path.push_back(ways[std::size_t(*rc::gen::inRange(0, 6)) % ways.size()]);
    }
    RC_PRE(path.size() > 4);
    Edges cut;
    for (std::size_t i = 1; i < path.size(); ++i)
      cut.insert({path[i - 1], path[i]}), cut.insert({path[i], path[i - 1]});
    std::mt19937 random(unsigned(*rc::gen::inRange(1, 1000)));
    std::uniform_real_distribution<double> by(-1, 1);
    const Mesh parted = cut_along(sheet, cut, [&](Vertex v, const Point&) {
      const bool on = std::find(path.begin(), path.end(), v) != path.end();
      const Vector way(by(random), by(random), by(random));
      const double at_least = std::max(1., std::sqrt(way.squared_length()));
      return sheet.point(v) + (on ? shortest / 210 / at_least : 0) * way;
    });
    // What was moved may shorten the shortest edge by a hundredth.
    const BorderSeams seams = find_border_seams(parted);
    const MeshInfo was = measure(sheet), now = measure(joined(parted, seams));
    RC_ASSERT(now.vertices == was.vertices);
    RC_ASSERT(now.edges == was.edges);
    RC_ASSERT(now.boundary_loops == was.boundary_loops);
    RC_ASSERT(now.euler_characteristic == was.euler_characteristic);
  }));
}
