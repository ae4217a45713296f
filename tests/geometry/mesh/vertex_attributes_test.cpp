// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/mesh/vertex_attributes.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "geometry/insert/insert_in_faces.h"
#include "geometry/mesh/errors.h"
#include "geometry/refine/subdivide.h"
#include "tests/test_meshes.h"

using namespace furrow::geometry;
using namespace furrow::tests;

namespace {

/// Three joints with weights that sum to 1 (not linear in the position), a mask, and a NaN at one vertex.
Mesh skinned() {
  Mesh mesh = jittered(8, 8, 0.2, 3);
  auto a = ensure_vertex_attribute(mesh, "weight_hip"), b = ensure_vertex_attribute(mesh, "weight_knee"),
       c = ensure_vertex_attribute(mesh, "weight_foot"), mask = ensure_vertex_attribute(mesh, "mask");
  for (Vertex v : mesh.vertices()) {
    const Point& p = mesh.point(v);
    a[v] = p.x() * p.x();
    b[v] = (1 - a[v]) * p.y();
    c[v] = 1 - a[v] - b[v];
    mask[v] = v.idx() == 0 ? unset_value : 3 * p.x() - p.y();
  }
  return mesh;
}

double weight_sum(const Mesh& mesh, Vertex v) {
  double sum = 0;
  for (const VertexAttribute& attribute : vertex_attributes(mesh))
    if (attribute.name.starts_with("weight_")) sum += attribute.values[v];
  return sum;
}

}  // namespace

TEST_CASE("vertex_attributes: they are found by name, in the order they were added") {
  const Mesh mesh = skinned();
  const auto list = vertex_attributes(mesh);
  REQUIRE(list.size() == 4);
  CHECK(list[1].name == "weight_knee");
  CHECK(list[3].name == "mask");
  CHECK(list[3].values[Vertex(5)] == 3 * mesh.point(Vertex(5)).x() - mesh.point(Vertex(5)).y());
}

TEST_CASE(
    "vertex_attributes: insertion and subdivision keep them exact on old vertices and interpolate them on "
    "new ones") {
  const Mesh before = skinned();
  Mesh inserted = before, looped = before, cut = before, third = before;
  std::vector<FacePoint> points;
  for (Face f : inserted.faces()) points.push_back({f, {0.2, 0.3, 0.5}});
  insert_in_faces(inserted, points);
  loop_subdivide(looped, 2);
  midpoint_subdivide(cut, 2);
  sqrt3_subdivide(third, 2);
  for (const Mesh* mesh : {&inserted, &looped, &cut, &third}) {
    const auto was = vertex_attributes(before), is = vertex_attributes(*mesh);
    REQUIRE(is.size() == was.size());
    std::size_t changed = 0, unset = 0;
    double worst = 0;
    for (Vertex v : mesh->vertices()) {
      worst = std::max(worst, std::abs(weight_sum(*mesh, v) - 1));
      unset += std::isnan(is[3].values[v]);
      if (v.idx() >= before.number_of_vertices()) continue;
      for (std::size_t k = 0; k < was.size(); ++k)
        changed += was[k].values[v] != is[k].values[v] && !std::isnan(was[k].values[v]);
    }
    CHECK(changed == 0);
    CHECK(worst < 1e-14);
    CHECK(unset >= 1);
    CHECK(unset < mesh->number_of_vertices() / 8);  // NaN spreads only to what lies beside it
  }
  // Linear values are interpolated linearly, where the surface stays.
  for (const Mesh* mesh : {&inserted, &cut}) {
    const auto mask = vertex_attributes(*mesh)[3].values;
    for (Vertex v : mesh->vertices())
      if (!std::isnan(mask[v]))
        CHECK(std::abs(mask[v] - 3 * mesh->point(v).x() + mesh->point(v).y()) < 1e-12);
  }
}

TEST_CASE("vertex_attributes: insertion notes where vertices lie at rest, and a moved mesh keeps the note") {
  Mesh mesh = skinned();
  const Mesh before = mesh;
  insert_in_faces(mesh, std::vector<FacePoint>{{Face(7), {0.2, 0.3, 0.5}}});
  auto rest = *find_map(mesh, attribute::rest_position);
  for (Vertex v : mesh.vertices())
    CHECK(rest[v] == RestPosition{mesh.point(v).x(), mesh.point(v).y(), mesh.point(v).z()});
  for (Vertex v : mesh.vertices()) mesh.point(v) = mesh.point(v) + Vector(0, 0, 5);
  insert_in_faces(mesh, std::vector<FacePoint>{{Face(20), {0.2, 0.3, 0.5}}});
  rest = *find_map(mesh, attribute::rest_position);  // the old handle is of the mesh before
  for (Vertex v : mesh.vertices()) {
    CHECK(std::abs(rest[v][2]) < 1e-15);
    CHECK(std::abs(rest[v][0] - mesh.point(v).x()) < 1e-15);
  }
}

TEST_CASE("vertex_attributes: the strongest skin weights are kept and sum to 1, the others keep their bits") {
  Mesh mesh = grid(1, 1);
  const std::array<std::array<double, 5>, 4> weights = {
      {{0.1, 0.2, 0.3, 0.25, 0.15}, {1, 0, 0, 0, 0}, {0, 0, 0, 0, 0}, {0.5, 0.5, 0.5, 0.5, 0}}};
  for (int j = 0; j < 5; ++j) {
    auto map = ensure_vertex_attribute(mesh, "weight_" + std::to_string(j));
    for (Vertex v : mesh.vertices()) map[v] = weights[v.idx()][j];
  }
  Mesh all = mesh;
  CHECK(normalize_skin_weights(all) == 1);  // the vertex whose sum is 2
  CHECK(vertex_attributes(all)[3].values[Vertex(3)] == 0.25);
  CHECK(normalize_skin_weights(mesh, 2) == 2);
  const auto list = vertex_attributes(mesh);
  CHECK(list[0].values[Vertex(0)] == 0);
  CHECK(list[2].values[Vertex(0)] == Approx(0.3 / 0.55));
  CHECK(list[3].values[Vertex(0)] == Approx(0.25 / 0.55));
  CHECK(list[0].values[Vertex(1)] == 1);
  CHECK(weight_sum(mesh, Vertex(2)) == 0);
  CHECK(list[1].values[Vertex(3)] == 0.5);  // of equal ones the first
  CHECK(list[2].values[Vertex(3)] == 0);
  CHECK_THROWS_AS(normalize_skin_weights(mesh, -1), std::invalid_argument);
  ensure_vertex_attribute(mesh, "weight_4")[Vertex(1)] = -0.5;
  CHECK_THROWS_AS(normalize_skin_weights(mesh, 1), ContentError);
  CHECK(list[0].values[Vertex(1)] == 1);
}

TEST_CASE("vertex_attributes: shape keys are told by their names, and moves that a mesh lacks are 0") {
  Mesh mesh = single_triangle();
  CHECK(shape_key_names(mesh).empty());
  const std::vector<Vector> moves = {{1, 0, 0}, {0, 2, 0}, {0, 0, -3}};
  set_shape_key(mesh, "A*B", moves);
  ensure_vertex_attribute(mesh, "key_z")[Vertex(0)] = 7;       // none of ours
  ensure_vertex_attribute(mesh, "key_Long_y")[Vertex(1)] = 4;  // along one axis alone
  ensure_vertex_attribute(mesh, "weight_hand");
  CHECK(shape_key_names(mesh) == std::vector<std::string>{"A*B", "Long"});
  CHECK(shape_key(mesh, "A*B") == moves);
  CHECK(shape_key(mesh, "Long") == std::vector<Vector>{{0, 0, 0}, {0, 4, 0}, {0, 0, 0}});
  CHECK(shape_key(mesh, "none") == std::vector<Vector>(3, Vector(0, 0, 0)));
  set_shape_key(mesh, "Long", moves);
  CHECK(shape_key(mesh, "Long") == moves);
  for (const char* bad : {"", "a b", "a\n"})
    CHECK_THROWS_AS(set_shape_key(mesh, bad, moves), std::invalid_argument);
  CHECK_THROWS_AS(set_shape_key(mesh, "C", {}), std::invalid_argument);
}
