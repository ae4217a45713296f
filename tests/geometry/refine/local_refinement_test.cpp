// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/refine/local_refinement.h"

#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <random>
#include <set>

#include "geometry/mesh/border_loops.h"
#include "geometry/mesh/edge_metric.h"
#include "geometry/mesh/preconditions.h"
#include "geometry/mesh/property_names.h"
#include "geometry/mesh/sheet.h"
#include "geometry/refine/subdivide.h"
#include "geometry/rest/rest_state.h"
#include "tests/test_meshes.h"

using namespace furrow::geometry;
using namespace furrow::tests;

namespace {

/// With texture coordinates, groups, a line along y = 0.5 where edges lie there, and rest lengths 1.3 times
/// as long in x as it lies, on a wavy surface.
Mesh lined_and_pressed(Mesh mesh) {
  auto texture = ensure_map(mesh, attribute::texture);
  auto group = ensure_map(mesh, attribute::group);
  auto rest = ensure_map(mesh, attribute::rest_length);
  auto own = ensure_map(mesh, attribute::triangle_rest_length);
  auto line = ensure_map(mesh, attribute::line);
  auto line_edge = ensure_map(mesh, attribute::line_edge);
  for (Face f : mesh.faces()) {
    group[f] = int(f.idx()) % 3;
    for (Halfedge h : mesh.halfedges_around_face(mesh.halfedge(f)))
      texture[h] = {mesh.point(mesh.target(h)).x(), mesh.point(mesh.target(h)).y()};
  }
  for (Vertex v : mesh.vertices())
    if (mesh.point(v).y() == 0.5) line[v] = 7;
  for (Edge e : mesh.edges()) {
    const Point a = mesh.point(mesh.vertex(e, 0)), b = mesh.point(mesh.vertex(e, 1));
    rest[e] = std::hypot(1.3 * (a.x() - b.x()), a.y() - b.y());
    line_edge[e] = a.y() == 0.5 && b.y() == 0.5;
  }
  for (Halfedge h : mesh.halfedges()) own[h] = 1.1 * rest[mesh.edge(h)];
  for (Vertex v : mesh.vertices()) {
    const Point p = mesh.point(v);
    mesh.point(v) = Point(p.x(), p.y(), 0.1 * std::sin(9 * p.x()));
  }
  return mesh;
}

/// Cuts random faces, round by round.
LocalRefinement cut_at_random(const Mesh& mesh, int depth, unsigned seed) {
  LocalRefinement refined(mesh, depth);
  std::mt19937 random(seed);
  for (int round = 0; round < depth; ++round) {
    std::vector<Face> some;
    const Mesh now = refined.mesh();
    for (const Face f : now.faces())
      if (random() % 6 == 0) some.push_back(f);
    refined.refine(some);
  }
  return refined;
}

double area_at_rest(const Mesh& mesh) {
  const std::vector<double> length = rest_lengths(mesh);
  double sum = 0;
  for (Face f : mesh.faces()) {
    const auto [a, b, c] = edge_lengths(mesh, f, length);
    sum += triangle_area(a, b, c);
  }
  return sum;
}

std::set<std::set<int>> faces_of(const Mesh& mesh, const VertexMap<int>& name) {
  std::set<std::set<int>> faces;
  for (Face f : mesh.faces()) {
    std::set<int> corners;
    for (Vertex v : mesh.vertices_around_face(mesh.halfedge(f))) corners.insert(name[v]);
    faces.insert(corners);
  }
  return faces;
}

std::vector<Face> all_faces(const Mesh& mesh) { return {mesh.faces().begin(), mesh.faces().end()}; }

}  // namespace

TEST_CASE("local_refinement: with every face cut it is Loop's mesh, with all its attributes") {
  const Mesh mesh = lined_and_pressed(jittered(5, 4, 0.2, 3));
  Mesh loop = mesh;
  loop_subdivide(loop, 2);
  LocalRefinement refined(mesh, 2);
  CHECK(refined.refine(all_faces(refined.mesh())) == mesh.number_of_faces());
  CHECK(refined.refine(all_faces(refined.mesh())) == 4 * mesh.number_of_faces());
  CHECK(refined.refine(all_faces(refined.mesh())) == 0);
  const Mesh found = refined.mesh();
  REQUIRE(found.number_of_vertices() == loop.number_of_vertices());
  auto own_name = loop.add_property_map<Vertex, int>("v:name", 0).first;
  for (Vertex v : loop.vertices()) own_name[v] = int(v.idx());
  CHECK(faces_of(found, *uniform_indices(found)) == faces_of(loop, own_name));
  const auto rest = *find_map(found, attribute::rest_length),
             rest_loop = *find_map(loop, attribute::rest_length);
  const auto own = *find_map(found, attribute::triangle_rest_length),
             own_loop = *find_map(loop, attribute::triangle_rest_length);
  const auto texture = *find_map(found, attribute::texture),
             texture_loop = *find_map(loop, attribute::texture);
  const auto line_edge = *find_map(found, attribute::line_edge),
             line_edge_loop = *find_map(loop, attribute::line_edge);
  const auto line = *find_map(found, attribute::line), line_loop = *find_map(loop, attribute::line);
  for (Vertex v : found.vertices()) {
    CHECK(found.point(v) == loop.point(v));
    CHECK(line[v] == line_loop[v]);
  }
  for (Halfedge h : found.halfedges()) {
    const Halfedge l = loop.halfedge(found.source(h), found.target(h));
    REQUIRE(l.is_valid());
    CHECK(rest[found.edge(h)] == rest_loop[loop.edge(l)]);
    CHECK(line_edge[found.edge(h)] == line_edge_loop[loop.edge(l)]);
    if (found.is_border(h)) continue;
    CHECK(own[h] == own_loop[l]);
    for (std::size_t k = 0; k < 2; ++k) CHECK(texture[h][k] == Approx(texture_loop[l][k]).margin(1e-15));
  }
}

TEST_CASE("local_refinement: with no face cut it is the mesh, on Loop's surface") {
  const Mesh mesh = lined_and_pressed(jittered(5, 4, 0.2, 3));
  Mesh loop = mesh;
  loop_subdivide(loop, 3);
  const LocalRefinement refined(mesh, 3);
  const Mesh found = refined.mesh();
  REQUIRE(found.number_of_faces() == mesh.number_of_faces());
  const auto rest = *find_map(found, attribute::rest_length), given = *find_map(mesh, attribute::rest_length);
  for (Vertex v : mesh.vertices()) CHECK(found.point(v) == loop.point(v));
  for (Edge e : mesh.edges())
    CHECK(rest[found.edge(found.halfedge(mesh.vertex(e, 0), mesh.vertex(e, 1)))] == given[e]);
}

TEST_CASE(
    "local_refinement: whatever is cut, the cloth is whole, as large as it was, and finer by one step a "
    "face") {
  for (unsigned seed = 0; seed < FURROW_PROPERTY_CASES; ++seed) {
    const Mesh mesh = lined_and_pressed(jittered(5, 4, 0.2, int(seed)));
    const LocalRefinement refined = cut_at_random(mesh, 1 + int(seed % 4), seed);
    const Mesh found = refined.mesh();
    INFO("seed " << seed << ", " << found.number_of_faces() << " faces");
    REQUIRE_NOTHROW(check_mesh(found, "test"));
    CHECK(border_loops(found).size() == border_loops(mesh).size());
    CHECK(long(found.number_of_vertices()) - long(found.number_of_edges()) + long(found.number_of_faces()) ==
          long(mesh.number_of_vertices()) - long(mesh.number_of_edges()) + long(mesh.number_of_faces()));
    CHECK(area_at_rest(found) == Approx(area_at_rest(mesh)).epsilon(1e-9));
    for (Edge e : found.edges()) {
      if (found.is_border(e)) continue;
      const Halfedge h = found.halfedge(e);
      CHECK(std::abs(refined.cuts(found.face(h)) - refined.cuts(found.face(found.opposite(h)))) <= 1);
    }
    const auto uniform = *uniform_indices(found);
    for (Vertex v : mesh.vertices()) CHECK(uniform[v] == int(v.idx()));
    Mesh loop = mesh;
    loop_subdivide(loop, refined.depth());
    CHECK(loop.number_of_vertices() == refined.uniform_vertices());
    for (Vertex v : found.vertices()) CHECK(found.point(v) == loop.point(Vertex(unsigned(uniform[v]))));
  }
}

TEST_CASE(
    "local_refinement: attributes are those of the face that was cut, lines stay chains of their edges") {
  for (unsigned seed = 0; seed < 20; ++seed) {
    const Mesh mesh = lined_and_pressed(grid(6, 4));
    const LocalRefinement refined = cut_at_random(mesh, 3, seed);
    const Mesh found = refined.mesh();
    const auto texture = *find_map(found, attribute::texture);
    double area = 0, line_length = 0, line_length_given = 0;
    for (Face f : found.faces()) {
      const Halfedge h = found.halfedge(f);
      const auto a = texture[h], b = texture[found.next(h)], c = texture[found.prev(h)];
      const double doubled = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
      CHECK(doubled > 0);
      area += doubled / 2;
    }
    CHECK(area == Approx(1).epsilon(1e-12));
    const auto along = [](const Mesh& m) {
      double sum = 0;
      const auto line_edge = *find_map(m, attribute::line_edge);
      const auto rest = *find_map(m, attribute::rest_length);
      const auto line = *find_map(m, attribute::line);
      for (Edge e : m.edges()) {
        if (!line_edge[e]) continue;
        sum += rest[e];
        for (int end : {0, 1}) CHECK(line[m.vertex(e, unsigned(end))] == 7);
      }
      return sum;
    };
    line_length = along(found), line_length_given = along(mesh);
    REQUIRE(line_length_given > 0);
    CHECK(line_length == Approx(line_length_given).epsilon(1e-12));
  }
}

TEST_CASE("local_refinement: the ends of a middle are vertices of the level before") {
  const Mesh mesh = grid(3, 2);
  const LocalRefinement refined(mesh, 2);
  Mesh middle = mesh;
  midpoint_subdivide(middle, 2);
  for (std::size_t v = 0; v < refined.uniform_vertices(); ++v) {
    const auto [a, b] = refined.ends_of(v);
    const auto at = [&](std::size_t i) { return middle.point(Vertex(unsigned(i))); };
    CHECK(at(v) == CGAL::midpoint(at(a), at(b)));
  }
}
