// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/rest/fold_rest.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "geometry/mesh/edge_metric.h"
#include "geometry/mesh/property_names.h"
#include "geometry/rest/bending_springs.h"
#include "geometry/rest/rest_angles.h"
#include "geometry/rest/rest_metric.h"
#include "tests/test_meshes.h"

using namespace furrow::geometry;
using namespace furrow::tests;

namespace {

void prepare(Mesh& mesh) {
  ensure_rest_lengths(mesh);
  ensure_bending_springs(mesh);
  ensure_rest_angles(mesh);
}

std::vector<double> angles(const Mesh& mesh) {
  std::vector<double> result(mesh.num_edges());
  for (Edge e : mesh.edges()) result[e.idx()] = dihedral_angle(mesh, e);
  return result;
}

Edge edge_of(const Mesh& mesh, int a, int b) {
  return mesh.edge(
      mesh.halfedge(Vertex(static_cast<Vertex::size_type>(a)), Vertex(static_cast<Vertex::size_type>(b))));
}

}  // namespace

TEST_CASE("fold_rest: an edge over a crease keeps its triangles when the crease is raised") {
  // A square folded by 90 degrees about the diagonal 0-2, but cut by the other one, 1-3.
  Mesh mesh = mesh_of({{0, 0, 0}, {0.5, 0.5, 0.7}, {1, 1, 0}, {0.5, 0.5, -0.7}}, {{0, 1, 3}, {1, 2, 3}});
  auto rest = ensure_map(mesh, attribute::rest_length);
  for (Edge e : mesh.edges()) rest[e] = spatial_length(mesh, e);
  rest[edge_of(mesh, 1, 3)] = 1.4;  // laid flat about 0-2
  prepare(mesh);
  for (int i : {1, 3})
    mesh.point(Vertex(static_cast<Vertex::size_type>(i))) = {0.5, 0.5 - 0.1 * i, i == 1 ? 0.4 : -0.4};
  const RestSnapshot before = take_rest_snapshot(mesh);
  const std::vector<double> base = angles(mesh), set(mesh.num_edges(), 0.5);
  Point& raised = mesh.point(Vertex(1));
  raised = raised + Vector(0, 0, 0.1);
  Mesh chords = mesh;
  apply_rest_rule(chords, before, RestRule::drawn);
  const FoldRestReport report = apply_fold_rest(mesh, before, base, set, RestRule::drawn);
  CHECK(report.unfolded_edges >= 1);
  CHECK(report.invalid_faces == 0);
}

TEST_CASE("fold_rest: cloth that is strained but flat keeps its strain on a fold") {
  Mesh mesh = grid(8, 8, 0.4, 0.4);
  auto rest = ensure_map(mesh, attribute::rest_length);
  for (Edge e : mesh.edges()) rest[e] = 1.02 * spatial_length(mesh, e);  // pressed together by 2 %
  prepare(mesh);
  const RestSnapshot before = take_rest_snapshot(mesh);
  lift(mesh, [](double x, double) { return 0.02 * std::sin(12 * x); });
  const std::vector<double> base(mesh.num_edges(), 0), set(mesh.num_edges(), 0.5);
  apply_fold_rest(mesh, before, base, set, RestRule::drawn);
  for (Edge e : mesh.edges()) CHECK(rest[e] == Approx(1.02 * spatial_length(mesh, e)).epsilon(1e-9));
}

TEST_CASE("fold_rest: a face that breaks the triangle inequality takes the lengths of its shape") {
  Mesh mesh = grid(3, 3, 0.3, 0.3);
  prepare(mesh);
  auto rest = find_map(mesh, attribute::rest_length).value();
  const Edge broken = edge_of(mesh, 5, 6);
  rest[broken] = 0.25;  // longer than the two others of either face
  const RestSnapshot before = take_rest_snapshot(mesh);
  CHECK(invalid_rest_faces(mesh) == 2);
  mesh.point(Vertex(5)) = mesh.point(Vertex(5)) + Vector(0, 0, 0.02);
  const std::vector<double> base = angles(mesh), set(mesh.num_edges(), 0);
  const FoldRestReport report = apply_fold_rest(mesh, before, base, set, RestRule::drawn);
  CHECK(report.reshaped_faces >= 1);
  CHECK(report.invalid_faces == 0);
  CHECK(invalid_rest_faces(mesh) == 0);
  CHECK(rest[broken] == Approx(spatial_length(mesh, broken)).epsilon(1e-12));
}

TEST_CASE("fold_rest: of the angles, those of the base all count, and of the fold's the share set") {
  for (const double set : {0.0, 0.25, 1.0}) {
    Mesh mesh = grid(4, 4, 0.4, 0.4);
    prepare(mesh);
    const RestSnapshot before = take_rest_snapshot(mesh);
    lift(mesh, [](double x, double) { return 0.5 * x * x; });
    const std::vector<double> base = angles(mesh);
    lift(mesh, [](double x, double y) { return 0.3 * x * y; });
    const std::vector<double> now = angles(mesh);
    apply_fold_rest(mesh, before, base, std::vector<double>(mesh.num_edges(), set), RestRule::drawn);
    const auto rest = find_map(mesh, attribute::rest_angle).value();
    for (Edge e : mesh.edges()) {
      if (mesh.is_border(e)) continue;
      CHECK(rest[e] == Approx(base[e.idx()] + set * (now[e.idx()] - base[e.idx()])).margin(1e-12));
    }
  }
}

TEST_CASE("fold_rest: rule flat changes nothing, and copied turns all angles") {
  Mesh mesh = grid(3, 3, 0.3, 0.3);
  prepare(mesh);
  const RestSnapshot before = take_rest_snapshot(mesh);
  mesh.point(Vertex(5)) = mesh.point(Vertex(5)) + Vector(0, 0, 0.02);
  const std::vector<double> base(mesh.num_edges(), 0), set(mesh.num_edges(), 0);
  Mesh flat = mesh;
  apply_fold_rest(flat, before, base, set, RestRule::flat);
  const auto rest = find_map(flat, attribute::rest_length).value();
  CHECK(rest[edge_of(flat, 5, 6)] == Approx(0.1));
  apply_fold_rest(mesh, before, base, set, RestRule::copied);
  const auto turned = find_map(mesh, attribute::rest_angle).value();
  for (Edge e : mesh.edges())
    if (!mesh.is_border(e)) CHECK(turned[e] == Approx(dihedral_angle(mesh, e)).margin(1e-12));
}
