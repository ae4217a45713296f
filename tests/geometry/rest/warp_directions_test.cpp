// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/rest/warp_directions.h"

#include <CGAL/Aff_transformation_3.h>

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "geometry/mesh/edge_metric.h"
#include "geometry/mesh/errors.h"
#include "geometry/mesh/vertex_attributes.h"
#include "geometry/refine/subdivide.h"
#include "geometry/rest/rest_metric.h"
#include "geometry/rest/rest_state.h"
#include "geometry/rest/spread_warp.h"
#include "tests/test_meshes.h"

using namespace furrow::geometry;
using namespace furrow::tests;

namespace {

constexpr double right_angle = std::numbers::pi / 2;

/// The angle between two axes [rad], in [0, pi/2].
double between(const Vector& a, const Vector& b) {
  const double c = std::abs(a * b) / std::sqrt(a.squared_length() * b.squared_length());
  return std::acos(std::min(1.0, c));
}

/// The largest angle of the warp to an axis projected on each face [rad], and of warp and weft to a right
/// angle; a face without one counts as 2.
double farthest_from(const Mesh& mesh, const Vector& axis) {
  double most = 0;
  for (Face f : mesh.faces()) {
    const Threading t = threading_of(mesh, f);
    if (t.warp == Vector(0, 0, 0)) return 2;
    const Vector across = CGAL::cross_product(t.warp, t.weft);
    const Vector normal = across / std::sqrt(across.squared_length());
    most = std::max(most, right_angle - between(t.warp, t.weft));
    most = std::max(most, between(t.warp, axis - (axis * normal) * normal));
  }
  return most;
}

/// A quarter of a tube around y, of radius 1.
Mesh bow(int n) {
  Mesh mesh = grid(n, n);
  double width = 0;
  for (Vertex v : mesh.vertices()) width = std::max(width, mesh.point(v).x());
  for (Vertex v : mesh.vertices()) {
    const Point p = mesh.point(v);
    const double a = right_angle * p.x() / width;
    mesh.point(v) = Point(std::sin(a), p.y(), std::cos(a));
  }
  return mesh;
}

void lay_texture(Mesh& mesh, double angle) {
  auto map = ensure_map(mesh, attribute::texture);
  const double c = std::cos(angle), s = std::sin(angle);
  for (Halfedge h : mesh.halfedges()) {
    const Point& p = mesh.point(mesh.target(h));
    if (!mesh.is_border(h)) map[h] = {c * p.x() + s * p.y(), -s * p.x() + c * p.y()};
  }
}

}  // namespace

TEST_CASE("set_warp_along: an axis is projected on each face, and refinement carries it") {
  Mesh mesh = bow(4);
  CHECK(set_warp_along(mesh, {0, 3, 0}).known == mesh.number_of_faces());
  CHECK(farthest_from(mesh, {0, 1, 0}) < 1e-7);
  for (int step = 0; step < 2; ++step) {
    loop_subdivide(mesh, 1);
    CHECK(farthest_from(mesh, {0, 1, 0}) < 0.02);
  }
  // Where the cloth knows how it was made, threads turn with it: Loop's rules round the corners off.
  Mesh fine = bow(16);
  set_warp_along(fine, {0, 1, 0});
  ensure_rest_positions(fine);
  loop_subdivide(fine, 1);
  CHECK(count_warp(fine).known == fine.number_of_faces());
  const Threading middle = threading_of(fine, Face(Mesh::size_type(fine.number_of_faces() / 2)));
  CHECK(between(middle.warp, {0, 1, 0}) < 0.05);
  Mesh flat = grid(3, 3);
  const WarpCount none = set_warp_along(flat, {0, 0, 1});
  CHECK(none.known == 0);
  CHECK(count_warp(flat).known == 0);
  CHECK_THROWS_AS(set_warp_along(flat, {0, 0, 0}), std::invalid_argument);
}

TEST_CASE("set_warp_by_texture: the warp runs as v grows, also where the texture is mirrored") {
  Mesh mesh = grid(4, 3);
  CHECK_THROWS_AS(set_warp_by_texture(mesh, TextureAxis::v), ContentError);
  lay_texture(mesh, 0.3);
  const Vector v(-std::sin(0.3), std::cos(0.3), 0), u(std::cos(0.3), std::sin(0.3), 0);
  const WarpCount count = set_warp_by_texture(mesh, TextureAxis::v);
  CHECK(count.known == mesh.number_of_faces());
  CHECK(count.skewed == 0);
  CHECK(farthest_from(mesh, v) < 1e-7);
  auto map = *find_map(mesh, attribute::texture);
  for (Halfedge h : mesh.halfedges()) map[h][0] *= -1;
  set_warp_by_texture(mesh, TextureAxis::v);
  CHECK(farthest_from(mesh, v) < 1e-7);
  set_warp_by_texture(mesh, TextureAxis::u);
  CHECK(farthest_from(mesh, u) < 1e-7);
  for (Halfedge h : mesh.halfedges()) map[h][0] += 0.5 * map[h][1];
  CHECK(set_warp_by_texture(mesh, TextureAxis::v).skewed == mesh.number_of_faces());
  loop_subdivide(mesh, 1);
  CHECK(count_warp(mesh).known == mesh.number_of_faces());
}

TEST_CASE("spread_warp: one stroke on a flat garment gives one direction everywhere") {
  Mesh mesh = jittered(6, 5, 0.2, 3);
  const Vector along(1, 0.4, 0);
  const WarpHint hint{Face(7), along};
  CHECK(set_warp_by_hints(mesh, std::span(&hint, 1)).known == 1);
  CHECK(spread_warp(mesh).known == mesh.number_of_faces());
  CHECK(farthest_from(mesh, along) < 1e-7);
}

TEST_CASE("spread_warp: a direction goes around a bend as the unrolled cloth has it") {
  Mesh mesh = bow(6);  // developable: a helix stays one
  const Threading first = [&] {
    set_warp_along(mesh, {0, 1, 0});
    return threading_of(mesh, Face(0));
  }();
  const WarpHint hint{Face(0), 0.8 * first.warp + 0.6 * first.weft};
  set_warp_by_hints(mesh, std::span(&hint, 1));
  spread_warp(mesh);
  for (Face f : mesh.faces())
    CHECK(between(threading_of(mesh, f).warp, {0, 1, 0}) == Approx(std::acos(0.8)).margin(1e-6));
}

TEST_CASE("spread_warp: parts without any direction stay without") {
  Mesh mesh = grid(2, 2);
  const std::size_t first = mesh.number_of_faces();
  const Vertex a = mesh.add_vertex(Point(9, 0, 0)), b = mesh.add_vertex(Point(10, 0, 0)),
               c = mesh.add_vertex(Point(9, 1, 0));
  mesh.add_face(a, b, c);
  const WarpHint hint{Face(0), {0, 1, 0}};
  set_warp_by_hints(mesh, std::span(&hint, 1));
  const WarpCount count = spread_warp(mesh);
  CHECK(count.known == first);
  CHECK(count.faces == first + 1);
  CHECK_THROWS_AS(known_warp_angle(mesh, mesh.halfedge(Face(Mesh::size_type(first))), rest_lengths(mesh)),
                  ContentError);
}

TEST_CASE("warp_angle: it is that of the cloth at rest, whatever its pose") {
  Mesh mesh = jittered(4, 4, 0.2, 8);
  ensure_rest_positions(mesh);
  ensure_rest_lengths(mesh);
  set_warp_along(mesh, {0.6, 0.8, 0});
  std::vector<double> flat;
  const std::vector<double> rest = rest_lengths(mesh);
  for (Face f : mesh.faces()) {
    const Halfedge h = mesh.halfedge(f);
    const Vector e = mesh.point(mesh.target(h)) - mesh.point(mesh.source(h));
    flat.push_back(warp_angle(mesh, h, rest));
    const double wanted = std::atan2(0.8, 0.6) - std::atan2(e.y(), e.x());
    CHECK(std::cos(flat.back() - wanted) == Approx(1).epsilon(1e-12));
  }
  for (Vertex v : mesh.vertices()) {
    const Point p = mesh.point(v);
    mesh.point(v) = Point(0.3 * p.y(), 2 * p.x() + p.y(), p.x() * p.x());
  }
  for (Face f : mesh.faces())
    CHECK(warp_angle(mesh, mesh.halfedge(f), rest_lengths(mesh)) == Approx(flat[f.idx()]).margin(1e-12));
}
