// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/refine/subdivide.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <map>
#include <stdexcept>

#include "geometry/mesh/errors.h"
#include "geometry/mesh/face_point.h"
#include "geometry/mesh/measures.h"
#include "geometry/mesh/property_names.h"
#include "geometry/mesh/sheet.h"
#include "geometry/rest/rest_state.h"
#include "tests/test_meshes.h"
#include "tests/test_paths.h"

using namespace furrow::geometry;
using namespace furrow::tests;

namespace {

/// Texture u, v = x, y at every corner; colour and group by position.
Mesh dressed(Mesh mesh) {
  auto texture = ensure_map(mesh, attribute::texture);
  auto color = ensure_map(mesh, attribute::color);
  auto group = ensure_map(mesh, attribute::group);
  auto material = ensure_map(mesh, attribute::material);
  for (Vertex v : mesh.vertices()) color[v] = {mesh.point(v).x(), mesh.point(v).y(), 0.25, 1};
  for (Face f : mesh.faces()) {
    group[f] = mesh.point(mesh.target(mesh.halfedge(f))).x() < 0.5 ? 0 : 1;
    material[f] = static_cast<int>(f.idx());
    for (Halfedge h : mesh.halfedges_around_face(mesh.halfedge(f)))
      texture[h] = {mesh.point(mesh.target(h)).x(), mesh.point(mesh.target(h)).y()};
  }
  return mesh;
}
std::map<int, double> texture_area_by_material(const Mesh& mesh) {
  std::map<int, double> area;
  const auto texture = *find_map(mesh, attribute::texture);
  for (Face f : mesh.faces()) {
    const Halfedge h = mesh.halfedge(f);
    const auto a = texture[h], b = texture[mesh.next(h)], c = texture[mesh.prev(h)];
    const double doubled = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
    CHECK(doubled > 0);
    area[(*find_map(mesh, attribute::material))[f]] += doubled / 2;
  }
  return area;
}

/// The largest relative error of a rest length against the distance of the ends' rest positions.
double worst_rest(const Mesh& mesh) {
  const auto rest = *find_map(mesh, attribute::rest_length);
  const auto place = *find_map(mesh, attribute::rest_position);
  double worst = 0;
  for (Edge e : mesh.edges()) {
    const RestPosition a = place[mesh.vertex(e, 0)], b = place[mesh.vertex(e, 1)];
    const double length = std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
    worst = std::max(worst, std::isnan(rest[e]) ? 1 : std::abs(rest[e] / length - 1));
  }
  return worst;
}

/// Flat cloth, cut 1.3 times as wide as it lies and 0.9 times as long, on a wavy surface.
Mesh cut_larger() {
  Mesh mesh = jittered(6, 5, 0.2, 3);
  auto rest = ensure_map(mesh, attribute::rest_length);
  auto place = ensure_map(mesh, attribute::rest_position);
  for (Vertex v : mesh.vertices()) {
    const Point p = mesh.point(v);
    place[v] = {1.3 * p.x(), 0.9 * p.y(), 0};
    mesh.point(v) = Point(p.x(), p.y(), 0.1 * std::sin(9 * p.x()));
  }
  for (Edge e : mesh.edges()) {
    const RestPosition a = place[mesh.vertex(e, 0)], b = place[mesh.vertex(e, 1)];
    rest[e] = std::hypot(a[0] - b[0], a[1] - b[1]);
  }
  return mesh;
}

}  // namespace

TEST_CASE("subdivide: rest lengths are those of the pattern, cut finer, wherever the masks move the cloth") {
  for (const int steps : {1, 2, 3}) {
    Mesh loop = cut_larger(), middle = loop, sqrt3 = loop;
    loop_subdivide(loop, steps);
    midpoint_subdivide(middle, steps);
    sqrt3_subdivide(sqrt3, steps);
    INFO(steps);
    CHECK(worst_rest(loop) < 1e-12);
    CHECK(worst_rest(middle) < 1e-12);
    CHECK(worst_rest(sqrt3) < 1e-12);
    for (const Mesh* mesh : {&loop, &middle, &sqrt3})
      CHECK(rest_area(*mesh) == Approx(rest_area(cut_larger())).epsilon(1e-12));
  }
}

TEST_CASE("subdivide: where no rest length is set, none is made up") {
  for (const auto subdivide : {&loop_subdivide, &sqrt3_subdivide}) {
    Mesh none = grid(3, 3), unset = none, mixed = none;
    ensure_map(unset, attribute::rest_length);
    subdivide(none, 2);
    subdivide(unset, 2);
    CHECK_FALSE(find_map(none, attribute::rest_length).has_value());
    const auto rest = *find_map(unset, attribute::rest_length);
    for (Edge e : unset.edges()) CHECK(std::isnan(rest[e]));
    ensure_map(mixed, attribute::rest_length)[Edge(0)] = -1;
    const Mesh before = mixed;
    CHECK_THROWS_AS(subdivide(mixed, 1), ContentError);
    CHECK(mixed.number_of_faces() == before.number_of_faces());
  }
}

TEST_CASE("loop_subdivide: a triangle's own rest lengths are halved in its four parts") {
  Mesh mesh = grid(2, 2);
  auto own = ensure_map(mesh, attribute::triangle_rest_length);
  for (Halfedge h : halfedges_of(mesh, Face(3))) own[h] = 1 + double(h.idx());
  loop_subdivide(mesh, 1);
  const auto finer = *find_map(mesh, attribute::triangle_rest_length);
  std::map<double, int> count;
  for (Halfedge h : mesh.halfedges())
    if (!std::isnan(finer[h])) ++count[finer[h]];
  Mesh coarse = grid(2, 2);
  std::map<double, int> wanted;
  for (Halfedge h : halfedges_of(coarse, Face(3))) wanted[(1 + double(h.idx())) / 2] = 4;
  CHECK(count == wanted);
}

TEST_CASE("midpoint_subdivide: the surface stays, each face knows what it is a part of") {
  Mesh mesh = dressed(jittered(5, 5, 0.2, 9));
  lift(mesh, [](double x, double y) { return x * y; });
  mesh.add_vertex(Point(7, 8, 9));
  const Mesh before = mesh;
  const std::vector<Face> parents = midpoint_subdivide(mesh, 2);
  REQUIRE(parents.size() == mesh.number_of_faces());
  CHECK(mesh.number_of_faces() == 16 * before.number_of_faces());
  for (Vertex v : before.vertices()) CHECK(mesh.point(v) == before.point(v));
  for (Face f : mesh.faces()) {
    CHECK((*find_map(mesh, attribute::material))[f] == static_cast<int>(parents[f.idx()].idx()));
    const Vector n = area_normal_of(mesh, f), whole = area_normal_of(before, parents[f.idx()]);
    CHECK((16 * n - whole).squared_length() < 1e-28);
  }
  const auto texture = *find_map(mesh, attribute::texture);
  for (Halfedge h : mesh.halfedges())
    if (!mesh.is_border(h)) CHECK(texture[h][0] == Approx(mesh.point(mesh.target(h)).x()).margin(1e-15));
  CHECK_THROWS_AS(midpoint_subdivide(mesh, 7), std::invalid_argument);
}

TEST_CASE("loop_subdivide: counts, and known points of the octahedron") {
  Mesh mesh =
      mesh_of({{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}},
              {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}});
  loop_subdivide(mesh, 1);
  CHECK(mesh.number_of_vertices() == 18);
  CHECK(mesh.number_of_faces() == 32);
  // Valence 4: beta = (5/8 - (3/8 + 1/4 cos(90 deg))^2) / 4, so a corner shrinks by 1 - 4 beta = 3/8 + 9/64.
  CHECK(mesh.point(Vertex(0)).x() == Approx(1 - 5. / 8 + 9. / 64).epsilon(1e-14));
  for (std::size_t i = 6; i < 18; ++i) {  // 3/8 of two neighbours; what lies opposite cancels
    const Point p = mesh.point(Vertex(static_cast<Vertex::size_type>(i)));
    CHECK(std::abs(p.x()) + std::abs(p.y()) + std::abs(p.z()) == Approx(0.75).epsilon(1e-14));
  }
  const MeshInfo info = measure(mesh);
  CHECK(info.closed);
  CHECK(info.euler_characteristic == 2);
}

TEST_CASE("loop_subdivide: it agrees with the reference of the real skirt, vertex by nearest vertex",
          "[release]") {
  if (!have_shared()) {
    WARN("skipped: no shared data");
    return;
  }
  Mesh skirt = read_plain_obj(shared_dir() / "meshes/cloth/dc_skirt2011.obj");
  const Mesh reference = read_plain_obj(shared_dir() / "meshes/accuracy/dc_skirt2011_loop_x1.obj");
  loop_subdivide(skirt, 1);
  REQUIRE(skirt.number_of_vertices() == reference.number_of_vertices());
  REQUIRE(skirt.number_of_faces() == reference.number_of_faces());
  double farthest = 0;
  for (Vertex v : reference.vertices()) {
    double nearest = 1;
    for (Vertex w : skirt.vertices())
      nearest = std::min(nearest, CGAL::squared_distance(reference.point(v), skirt.point(w)));
    farthest = std::max(farthest, nearest);
  }
  CHECK(std::sqrt(farthest) < 1e-8);  // its file has nine decimals
}

TEST_CASE("loop_subdivide: it keeps a flat lattice flat and its border straight, and old indices") {
  Mesh mesh = grid(4, 3, 4, 3);
  const Mesh before = mesh;
  loop_subdivide(mesh, 2);
  CHECK(mesh.number_of_faces() == 16 * 24);
  for (Vertex v : mesh.vertices()) CHECK(mesh.point(v).z() == 0);
  CHECK(mesh.point(Vertex(6)) == before.point(Vertex(6)));  // six-valent inside: a fixed point
  CHECK(mesh.point(Vertex(2)).y() == 0);
}

TEST_CASE("subdivide: texture, colours, groups and materials survive both subdivisions") {
  const auto subdivide = GENERATE(&loop_subdivide, &sqrt3_subdivide);
  const int steps = GENERATE(1, 2, 3);
  const bool by_loop = subdivide == &loop_subdivide;
  const Mesh before = dressed(union_jack(4, 2, 2, 1));
  Mesh mesh = before;
  subdivide(mesh, steps);
  double total = 0;
  for (const auto& [material, area] : texture_area_by_material(mesh)) {
    total += area;
    if (by_loop) CHECK(area == Approx(2. / 16).epsilon(1e-12));
  }
  CHECK(total == Approx(2).epsilon(1e-12));  // the picture is still covered once
  const auto texture = *find_map(mesh, attribute::texture);
  for (Halfedge h : mesh.halfedges()) {
    if (mesh.is_border(h)) continue;
    // Colour and texture are both linear in the old positions: they must agree.
    const Color c = (*find_map(mesh, attribute::color))[mesh.target(h)];
    CHECK(texture[h][0] == Approx(c[0]).margin(1e-12));
    CHECK(texture[h][1] == Approx(c[1]).margin(1e-12));
    CHECK(c[2] == Approx(0.25));
    CHECK(c[3] == Approx(1));
  }
  for (Face f : mesh.faces()) {
    const Face from(static_cast<Face::size_type>((*find_map(mesh, attribute::material))[f]));
    CHECK((*find_map(mesh, attribute::group))[f] == (*find_map(before, attribute::group))[from]);
  }
}

TEST_CASE("subdivide: halves of diagonals, and what is parallel to them, are diagonals") {
  Mesh mesh = woven_sheet(0.3, 0.2, 0.1);
  const auto count = [](const Mesh& m) {
    std::size_t n = 0;
    for (Edge e : m.edges()) {
      const Vector d = m.point(m.vertex(e, 1)) - m.point(m.vertex(e, 0));
      const bool slanted = std::abs(d.x()) > 1e-6 && std::abs(d.y()) > 1e-6;
      CHECK((*find_map(m, attribute::diagonal))[e] == slanted);
      n += slanted;
    }
    return n;
  };
  CHECK(count(mesh) == 6);
  Mesh loop = mesh, sqrt3 = mesh;
  midpoint_subdivide(mesh, 1);
  CHECK(count(mesh) == 24);
  midpoint_subdivide(mesh, 1);
  CHECK(count(mesh) == 96);
  loop_subdivide(loop, 2);
  std::size_t marked = 0;
  for (Edge e : loop.edges()) marked += (*find_map(loop, attribute::diagonal))[e];
  CHECK(marked == 96);
  sqrt3_subdivide(sqrt3, 1);
  for (Edge e : sqrt3.edges()) CHECK_FALSE((*find_map(sqrt3, attribute::diagonal))[e]);
}

TEST_CASE("loop_subdivide: it carries a seam of the texture, whose two sides stay apart") {
  Mesh mesh = dressed(grid(2, 2));
  auto texture = *find_map(mesh, attribute::texture);
  for (Face f : mesh.faces())
    for (Halfedge h : mesh.halfedges_around_face(mesh.halfedge(f)))
      if ((*find_map(mesh, attribute::group))[f] == 1) texture[h][0] += 10;
  loop_subdivide(mesh, 2);
  for (Face f : mesh.faces())
    for (Halfedge h : mesh.halfedges_around_face(mesh.halfedge(f)))
      CHECK(((*find_map(mesh, attribute::texture))[h][0] > 5) ==
            ((*find_map(mesh, attribute::group))[f] == 1));
}

TEST_CASE("loop_subdivide: it carries lines and rest lengths, springs and masses become unset") {
  Mesh mesh = grid(4, 4);
  auto line = ensure_map(mesh, attribute::line);
  auto line_edge = ensure_map(mesh, attribute::line_edge);
  for (int i = 11; i <= 13; ++i) line[Vertex(static_cast<Vertex::size_type>(i))] = 2;
  for (unsigned i = 11; i < 13; ++i) line_edge[mesh.edge(mesh.halfedge(Vertex(i), Vertex(i + 1)))] = true;
  auto rest = ensure_map(mesh, attribute::rest_length);
  for (Edge e : mesh.edges()) rest[e] = 1;
  auto mass = ensure_map(mesh, attribute::mass);
  for (Vertex v : mesh.vertices()) mass[v] = 1;
  Mesh by_sqrt3 = mesh;
  loop_subdivide(mesh, 2);
  std::size_t vertices = 0, edges = 0;
  for (Vertex v : mesh.vertices()) vertices += (*find_map(mesh, attribute::line))[v] == 2;
  for (Edge e : mesh.edges()) {
    edges += (*find_map(mesh, attribute::line_edge))[e];
    CHECK((*find_map(mesh, attribute::rest_length))[e] == 0.25);
  }
  CHECK(vertices == 9);
  CHECK(edges == 8);
  CHECK(std::isnan((*find_map(mesh, attribute::mass))[Vertex(0)]));
  sqrt3_subdivide(by_sqrt3, 1);
  for (Edge e : by_sqrt3.edges()) CHECK_FALSE((*find_map(by_sqrt3, attribute::line_edge))[e]);
  CHECK((*find_map(by_sqrt3, attribute::line))[Vertex(12)] == 2);
}

TEST_CASE("sqrt3_subdivide: counts, topology, and a known point") {
  Mesh ball = icosphere(0);
  const double before = std::sqrt((ball.point(Vertex(0)) - CGAL::ORIGIN).squared_length());
  CHECK(before == Approx(1));
  sqrt3_subdivide(ball, 1);
  CHECK(ball.number_of_vertices() == 12 + 20);
  CHECK(ball.number_of_faces() == 60);
  // alpha_5 = (4 - 2 cos 72 deg) / 9; the five neighbours of an icosahedron's vertex have their mean at 1 /
  // sqrt 5 of it.
  const double alpha = (4 - 2 * std::cos(2 * 3.14159265358979323846 / 5)) / 9;
  const Point p = ball.point(Vertex(0));
  CHECK(std::sqrt((p - CGAL::ORIGIN).squared_length()) ==
        Approx(1 - alpha + alpha / std::sqrt(5)).epsilon(1e-14));
  CHECK(ball.degree(Vertex(0)) == 5);
  sqrt3_subdivide(ball, 2);
  CHECK(ball.number_of_faces() == 540);
  CHECK(measure(ball).euler_characteristic == 2);
  Mesh open = grid(3, 3);
  sqrt3_subdivide(open, 2);
  CHECK(measure(open).boundary_loops == 1);
  CHECK(measure(open).degenerate_faces == 0);
  for (Vertex v : open.vertices()) CHECK(open.point(v).z() == 0);
}

TEST_CASE("subdivide: subdivision bears lone vertices and single triangles, and refuses the rest") {
  for (const auto subdivide : {&loop_subdivide, &sqrt3_subdivide}) {
    Mesh mesh = single_triangle();
    const Vertex lone = mesh.add_vertex(Point(3, 3, 3));
    subdivide(mesh, 2);
    CHECK(mesh.point(lone) == Point(3, 3, 3));
    CHECK(mesh.is_isolated(lone));
    CHECK(mesh.is_valid());
    CHECK(measure(mesh).euler_characteristic == 1);
    Mesh none;
    subdivide(none, 1);
    CHECK(none.number_of_vertices() == 0);
    Mesh same = grid(2, 2);
    subdivide(same, 0);
    CHECK(same.number_of_faces() == 8);
    CHECK_THROWS_AS(subdivide(same, -1), std::invalid_argument);
    CHECK_THROWS_AS(subdivide(same, 7), std::invalid_argument);
    same.point(Vertex(0)) = Point(std::numeric_limits<double>::quiet_NaN(), 0, 0);
    CHECK_THROWS_AS(subdivide(same, 1), ContentError);
    Mesh quad;
    for (int i = 0; i < 4; ++i) quad.add_vertex(Point(i & 1, i >> 1, 0));
    quad.add_face(Vertex(0), Vertex(1), Vertex(3), Vertex(2));
    CHECK_THROWS_AS(subdivide(quad, 1), ContentError);
    CHECK(quad.number_of_faces() == 1);
  }
}
