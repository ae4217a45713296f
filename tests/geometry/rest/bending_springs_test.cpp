// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/rest/bending_springs.h"

#include <CGAL/boost/graph/Euler_operations.h>
#include <rapidcheck.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <stdexcept>
#include <vector>

#include "geometry/mesh/edge_metric.h"
#include "geometry/mesh/property_names.h"
#include "tests/test_meshes.h"

using namespace furrow::geometry;
using namespace furrow::tests;

namespace {

std::vector<BendingSpring> rebuilt(Mesh mesh) {
  rebuild_bending_springs(mesh);
  return bending_springs(mesh);
}
std::size_t interior_edges(const Mesh& mesh) {
  return static_cast<std::size_t>(
      std::count_if(mesh.edges().begin(), mesh.edges().end(), [&](Edge e) { return !mesh.is_border(e); }));
}
std::size_t hinges_with_spring(const std::vector<BendingSpring>& springs) {
  std::size_t n = 0;
  for (const BendingSpring& s : springs) n += static_cast<std::size_t>(s.count);
  return n;
}
bool same_connectivity(const std::vector<BendingSpring>& s, const std::vector<BendingSpring>& t) {
  return std::equal(s.begin(), s.end(), t.begin(), t.end(),
                    [](const BendingSpring& x, const BendingSpring& y) {
                      return x.a == y.a && x.b == y.b && x.across == y.across && x.count == y.count;
                    });
}
/// Splits or flips at random where that is allowed; returns the faces concerned.
std::vector<Face> change_somewhere(Mesh& mesh) {
  if (*rc::gen::inRange(0, 2) == 0) {
    const Face f(*rc::gen::inRange<Face::size_type>(0, mesh.number_of_faces()));
    const Halfedge h = CGAL::Euler::add_center_vertex(mesh.halfedge(f), mesh);
    mesh.point(mesh.target(h)) = Point(0.3, 0.4, 0.5);
    std::vector<Face> faces;
    for (Face g : mesh.faces_around_target(h)) faces.push_back(g);
    return faces;
  }
  const Edge e(*rc::gen::inRange<Edge::size_type>(0, mesh.number_of_edges()));
  if (mesh.is_border(e)) return {};
  const Halfedge h = mesh.halfedge(e), o = mesh.opposite(h);
  const Vertex c = mesh.target(mesh.next(h)), d = mesh.target(mesh.next(o));
  if (c == d || mesh.halfedge(c, d).is_valid()) return {};
  CGAL::Euler::flip_edge(h, mesh);
  return {mesh.face(h), mesh.face(o)};
}

/// Interior edges whose two opposite vertices are joined already, or are one vertex: they get no spring.
std::size_t count_hinges_without_spring(const Mesh& mesh) {
  std::size_t n = 0;
  for (Edge e : mesh.edges()) {
    if (mesh.is_border(e)) continue;
    const Halfedge h = mesh.halfedge(e);
    const Vertex a = mesh.target(mesh.next(h)), b = mesh.target(mesh.next(mesh.opposite(h)));
    n += a == b || mesh.halfedge(a, b).is_valid();
  }
  return n;
}

}  // namespace

TEST_CASE("bending_springs: there is one for each interior edge, except where an edge or another spring is") {
  CHECK(rebuilt(single_triangle()).empty());
  const Mesh plain = grid(5, 4);
  CHECK(rebuilt(plain).size() == interior_edges(plain));
  const Mesh ball = icosphere(2);  // valences 5 and 6 only: no pair twice
  CHECK(rebuilt(ball).size() == ball.number_of_edges());
  const Mesh tetrahedron =
      mesh_of({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}});
  CHECK(rebuilt(tetrahedron).empty());
  CHECK(count_hinges_without_spring(tetrahedron) == 6);
  const auto octahedron = rebuilt(
      mesh_of({{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}},
              {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}}));
  REQUIRE(octahedron.size() == 3);  // its diagonals, each asked for by four edges
  for (const BendingSpring& s : octahedron) {
    CHECK(s.count == 4);
    CHECK(s.rest_length == Approx(2));
  }
  const auto box =
      rebuilt(cube());  // 6 face diagonals not in the mesh; 12 cube edges span face or space diagonals
  CHECK(hinges_with_spring(box) + count_hinges_without_spring(cube()) == cube().number_of_edges());
}

TEST_CASE(
    "bending_springs: around a vertex of valence four two edges share a spring, held by the lower edge") {
  Mesh mesh = mesh_of({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0.5, 0.5, 0}},
                      {{0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}});
  const auto springs = rebuilt(mesh);
  REQUIRE(springs.size() == 2);
  CHECK(springs[0].a == Vertex(0));
  CHECK(springs[0].b == Vertex(2));
  CHECK(springs[0].count == 2);
  CHECK(springs[0].rest_length == Approx(std::sqrt(2)));
  CHECK(springs[0].across == mesh.edge(mesh.halfedge(Vertex(1), Vertex(4))));
  CHECK(springs[1].across == mesh.edge(mesh.halfedge(Vertex(0), Vertex(4))));
  rebuild_bending_springs(mesh);
  const Edge other = mesh.edge(mesh.halfedge(Vertex(3), Vertex(4)));
  CHECK(std::isnan((*find_map(mesh, attribute::bending_rest_length))[other]));
  CHECK((*find_map(mesh, attribute::bending_count))[other] == 0);
}

TEST_CASE(
    "bending_springs: no bending spring joins two vertices that an edge joins, none is there twice, they are "
    "sorted") {
  for (const Mesh& mesh :
       {union_jack(6, 5), jittered(6, 5, 0.3, 1), cylinder(1, 1, 3, 4), torus_lattice(3, 4)}) {
    const auto springs = rebuilt(mesh);
    CHECK(hinges_with_spring(springs) + count_hinges_without_spring(mesh) == interior_edges(mesh));
    for (std::size_t i = 0; i < springs.size(); ++i) {
      CHECK(springs[i].a < springs[i].b);
      CHECK_FALSE(mesh.halfedge(springs[i].a, springs[i].b).is_valid());
      if (i > 0) CHECK(std::pair(springs[i - 1].a, springs[i - 1].b) < std::pair(springs[i].a, springs[i].b));
    }
  }
}

TEST_CASE("bending_springs: a local rebuild after random splits and flips equals the whole one") {
  CHECK(rc::check("local = whole", [] {
    Mesh mesh = *rc::gen::element(0, 1) == 0 ? union_jack(4, 4) : grid(4, 3);
    rebuild_bending_springs(mesh);
    const int rounds = *rc::gen::inRange(1, 5);
    for (int round = 0; round < rounds; ++round) {
      std::vector<Face> changed;
      const int changes = *rc::gen::inRange(1, 6);
      for (int i = 0; i < changes; ++i)
        for (Face f : change_somewhere(mesh)) changed.push_back(f);
      rebuild_bending_springs(mesh, changed);
    }
    const auto local = bending_springs(mesh), whole = rebuilt(mesh);
    RC_ASSERT(same_connectivity(local, whole));
    for (std::size_t i = 0; i < local.size(); ++i) RC_ASSERT(local[i].rest_length == whole[i].rest_length);
  }));
}

TEST_CASE("bending_springs: a local rebuild leaves rest lengths and stiffness elsewhere, a whole one none") {
  Mesh mesh = grid(8, 8);
  rebuild_bending_springs(mesh);
  auto rest = *find_map(mesh, attribute::bending_rest_length),
       stiffness = ensure_map(mesh, attribute::bending_stiffness);
  for (Edge e : mesh.edges()) rest[e] *= 3, stiffness[e] = rest[e] + 1;
  const auto before = bending_springs(mesh);
  const Edge e = mesh.edge(mesh.halfedge(Vertex(40), Vertex(41)));
  const Halfedge h = mesh.halfedge(e);
  CGAL::Euler::flip_edge(h, mesh);
  const std::vector<Face> changed = {mesh.face(h), mesh.face(mesh.opposite(h))};
  rebuild_bending_springs(mesh, changed);
  std::size_t anew = 0;
  for (const BendingSpring& s : bending_springs(mesh)) {
    const auto old =
        std::find_if(before.begin(), before.end(), [&](const auto& t) { return t.across == s.across; });
    const double distance = std::sqrt(CGAL::squared_distance(mesh.point(s.a), mesh.point(s.b)));
    if (old->rest_length == s.rest_length) {
      CHECK((stiffness[s.across] == s.rest_length + 1 || old->count != s.count));
      continue;
    }
    ++anew;
    CHECK(std::isnan(stiffness[s.across]));
    CHECK(s.rest_length == distance);
  }
  CHECK(anew == 5);  // the flipped edge and the four around it
  CHECK_THROWS_AS(rebuild_bending_springs(mesh, std::vector{Face(9999)}), std::invalid_argument);
  rebuild_bending_springs(mesh);
  for (Edge s : mesh.edges()) CHECK(std::isnan(stiffness[s]));
}

TEST_CASE("bending_springs: what a file sets of springs without counting them is kept") {
  Mesh mesh = jittered(4, 4, 0.2, 7), plain = mesh;
  auto stiffness = ensure_map(mesh, attribute::bending_stiffness);
  auto rest = ensure_map(mesh, attribute::bending_rest_length);
  rebuild_bending_springs(plain);
  const auto springs = bending_springs(plain);
  REQUIRE(springs.size() > 4);
  stiffness[springs[1].across] = 12.5;
  rest[springs[2].across] = 0.75;
  ensure_bending_springs(mesh);
  const auto kept = bending_springs(mesh);
  CHECK(same_connectivity(kept, springs));
  for (std::size_t i = 0; i < springs.size(); ++i) {
    CHECK(kept[i].rest_length == (i == 2 ? 0.75 : springs[i].rest_length));
    const double own = (*find_map(mesh, attribute::bending_stiffness))[kept[i].across];
    CHECK((i == 1 ? own == 12.5 : std::isnan(own)));
  }
}

TEST_CASE("bending_springs: a stiffness set on an edge that shares a spring goes to the spring") {
  Mesh mesh = union_jack(4, 4);  // valence four: two edges for one spring
  rebuild_bending_springs(mesh);
  const auto springs = bending_springs(mesh);
  const auto shared =
      std::find_if(springs.begin(), springs.end(), [](const auto& s) { return s.count == 2; });
  REQUIRE(shared != springs.end());
  Mesh stated = union_jack(4, 4);
  auto stiffness = ensure_map(stated, attribute::bending_stiffness);
  for (Edge e : stated.edges()) {
    if (stated.is_border(e) || e == shared->across) continue;
    const Halfedge h = stated.halfedge(e);
    const Vertex a = stated.target(stated.next(h)), b = stated.target(stated.next(stated.opposite(h)));
    if (std::minmax(a, b) == std::minmax(shared->a, shared->b)) stiffness[e] = 3;
  }
  ensure_bending_springs(stated);
  CHECK((*find_map(stated, attribute::bending_stiffness))[shared->across] == 3);
}
