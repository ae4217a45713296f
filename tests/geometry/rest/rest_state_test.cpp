// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/rest/rest_state.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <cstring>
#include <limits>
#include <stdexcept>
#include <vector>

#include "geometry/fold/displace_line.h"
#include "geometry/mesh/edge_metric.h"
#include "geometry/mesh/errors.h"
#include "geometry/mesh/property_names.h"
#include "geometry/rest/bending_springs.h"
#include "tests/test_meshes.h"

using namespace furrow::geometry;
using namespace furrow::tests;

namespace {

/// A sheet whose rest lengths are its lengths over 1.25, that is, strained by 25 %.
Mesh strained_sheet() {
  Mesh mesh = grid(6, 6);
  rebuild_bending_springs(mesh);
  auto rest = ensure_map(mesh, attribute::rest_length);
  auto bending = ensure_map(mesh, attribute::bending_rest_length);
  for (Edge e : mesh.edges()) {
    rest[e] = spatial_length(mesh, e) / 1.25;
    bending[e] /= 1.25;
  }
  return mesh;
}
bool same_bits(double a, double b) { return std::memcmp(&a, &b, sizeof a) == 0; }

}  // namespace

TEST_CASE("rest_state: the drawn rest state carries the strain over and leaves everything else its bits") {
  Mesh mesh = strained_sheet();
  const Mesh before = mesh;
  const RestSnapshot snapshot = take_rest_snapshot(mesh);
  const Vertex lifted(24);
  displace_line(mesh, std::vector{Displacement{lifted, {0, 0, 1}, 0.1}});
  const RestReport report = apply_rest_rule(mesh, snapshot, RestRule::drawn);
  CHECK(report.scaled_edges == 6);
  CHECK(report.scaled_bending_springs == 6);
  const auto rest = *find_map(mesh, attribute::rest_length), old = *find_map(before, attribute::rest_length);
  for (Edge e : mesh.edges()) {
    CHECK(spatial_length(mesh, e) / rest[e] == Approx(1.25).epsilon(1e-14));
    if (mesh.vertex(e, 0) != lifted && mesh.vertex(e, 1) != lifted)
      CHECK(same_bits(rest[e], old[e]));
    else
      CHECK(rest[e] > old[e]);
  }
  const auto springs = bending_springs(mesh), old_springs = bending_springs(before);
  REQUIRE(springs.size() == old_springs.size());
  for (std::size_t i = 0; i < springs.size(); ++i) {
    const double now = std::sqrt(CGAL::squared_distance(mesh.point(springs[i].a), mesh.point(springs[i].b)));
    CHECK(now / springs[i].rest_length == Approx(1.25).epsilon(1e-14));
    if (springs[i].a != lifted && springs[i].b != lifted)
      CHECK(same_bits(springs[i].rest_length, old_springs[i].rest_length));
  }
  CHECK(rest_area(mesh) > rest_area(before));
}

TEST_CASE("rest_state: the flat rest state changes nothing, neither does a line of height zero") {
  Mesh mesh = strained_sheet();
  const double area = rest_area(mesh);
  const RestSnapshot snapshot = take_rest_snapshot(mesh);
  CHECK(apply_rest_rule(mesh, snapshot, RestRule::drawn).scaled_edges == 0);
  mesh.point(Vertex(24)) = Point(0.5, 0.5, 0.3);
  CHECK(apply_rest_rule(mesh, snapshot, RestRule::flat).scaled_edges == 0);
  CHECK(rest_area(mesh) == area);
}

TEST_CASE("rest_state: a face's own rest lengths carry their strain over, stiffness keeps its bits") {
  Mesh mesh = strained_sheet();
  auto own = ensure_map(mesh, attribute::triangle_rest_length);
  auto stiffness = ensure_map(mesh, attribute::stiffness),
       hinge = ensure_map(mesh, attribute::hinge_stiffness);
  const Vertex lifted(24);
  for (Halfedge h : mesh.halfedges_around_target(mesh.halfedge(lifted)))
    own[h] = spatial_length(mesh, mesh.edge(h)) / 1.1;  // of one of the two faces of each edge
  for (Edge e : mesh.edges()) stiffness[e] = 1 + e.idx(), hinge[e] = 2 + e.idx();
  const RestSnapshot snapshot = take_rest_snapshot(mesh);
  mesh.point(lifted) += Vector(0, 0, 0.1);
  apply_rest_rule(mesh, snapshot, RestRule::drawn);
  for (Halfedge h : mesh.halfedges())
    if (mesh.target(h) == lifted)
      CHECK(spatial_length(mesh, mesh.edge(h)) / own[h] == Approx(1.1).epsilon(1e-14));
    else
      CHECK(std::isnan(own[h]));
  for (Edge e : mesh.edges()) {
    CHECK(stiffness[e] == 1 + e.idx());
    CHECK(hinge[e] == 2 + e.idx());
  }
}

TEST_CASE(
    "rest_state: rest lengths that nobody set become the length after, also where the length before was "
    "zero") {
  Mesh mesh = grid(3, 3);
  mesh.point(Vertex(5)) = mesh.point(Vertex(6));
  const RestSnapshot snapshot = take_rest_snapshot(mesh);
  mesh.point(Vertex(5)) = Point(0.3, 0.35, 0.2);
  apply_rest_rule(mesh, snapshot, RestRule::drawn);
  const auto rest = *find_map(mesh, attribute::rest_length);
  for (Edge e : mesh.edges())
    if (mesh.vertex(e, 0) == Vertex(5) || mesh.vertex(e, 1) == Vertex(5))
      CHECK(rest[e] == spatial_length(mesh, e));
    else
      CHECK(std::isnan(rest[e]));
}

TEST_CASE("rest_area: it sums Heron areas of the rest lengths") {
  Mesh mesh = grid(4, 3, 2, 1.5);
  CHECK(rest_area(mesh) == Approx(3).epsilon(1e-14));
  CHECK(rest_area(strained_sheet()) == Approx(1 / (1.25 * 1.25)).epsilon(1e-14));
  lift(mesh, [](double x, double) { return 0.75 * x; });  // a slope: longer by 5/4
  CHECK(rest_area(mesh) == Approx(3.75).epsilon(1e-14));
}

TEST_CASE("apply_rest_rule: it refuses a snapshot of another mesh, and positions that are not finite") {
  Mesh mesh = grid(2, 2);
  CHECK_THROWS_AS(apply_rest_rule(mesh, take_rest_snapshot(grid(3, 2)), RestRule::drawn),
                  std::invalid_argument);
  const RestSnapshot snapshot = take_rest_snapshot(mesh);
  mesh.point(Vertex(4)) = Point(0, std::numeric_limits<double>::infinity(), 0);
  CHECK_THROWS_AS(apply_rest_rule(mesh, snapshot, RestRule::drawn), ContentError);
  CHECK_FALSE(find_map(mesh, attribute::rest_length));
}
