// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/mesh/struts.h"

#include <CGAL/boost/graph/Euler_operations.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "geometry/fold/wrinkle.h"
#include "geometry/refine/subdivide.h"
#include "geometry/rest/rest_state.h"
#include "tests/test_meshes.h"

using namespace furrow::geometry;
using namespace furrow::tests;

namespace {

const std::vector<Strut> two{{Vertex(7), Vertex(40), 0.5, 3}, {Vertex(2), Vertex(48), 0.7, 0}};

bool same(const Strut& s, const Strut& t) {
  return s.a == t.a && s.b == t.b && s.rest_length == t.rest_length && s.stiffness == t.stiffness;
}

}  // namespace

TEST_CASE(
    "struts: they come back sorted, those of one pair in their order, and copies of the mesh have them") {
  Mesh mesh = grid(6, 6);
  CHECK(struts(mesh).empty());
  std::vector<Strut> list = two;
  list.push_back({Vertex(2), Vertex(48), 0.1, 9});
  set_struts(mesh, list);
  const Mesh copy = mesh;
  for (const Mesh& m : {mesh, copy}) {
    const auto got = struts(m);
    REQUIRE(got.size() == 3);
    CHECK(same(got[0], list[1]));
    CHECK(same(got[1], list[2]));
    CHECK(same(got[2], list[0]));
  }
  set_struts(mesh, {});
  CHECK(struts(mesh).empty());
  CHECK(struts(copy).size() == 3);
}

TEST_CASE("struts: those that make no sense are refused, and the old ones stay") {
  Mesh mesh = grid(6, 6);
  set_struts(mesh, two);
  const double inf = std::numeric_limits<double>::infinity();
  for (const Strut& bad : std::vector<Strut>{{Vertex(3), Vertex(49), 1, 1},
                                             {Vertex(), Vertex(4), 1, 1},
                                             {Vertex(3), Vertex(3), 1, 1},
                                             {Vertex(5), Vertex(3), 1, 1},
                                             {Vertex(3), Vertex(5), 0, 1},
                                             {Vertex(3), Vertex(5), NAN, 1},
                                             {Vertex(3), Vertex(5), inf, 1},
                                             {Vertex(3), Vertex(5), 1, -1},
                                             {Vertex(3), Vertex(5), 1, NAN}})
    CHECK_THROWS_AS(set_struts(mesh, std::vector{bad}), std::invalid_argument);
  CHECK(struts(mesh).size() == 2);
}

TEST_CASE(
    "struts: they stay with their vertices when lines are inserted, and displacement carries their strain") {
  Mesh mesh = grid(6, 6);
  set_struts(mesh, two);
  Stroke stroke;
  stroke.points = {{0.1, 0.12, 0}, {0.9, 0.8, 0}};
  stroke.height = 0;
  wrinkle(mesh, std::span(&stroke, 1));
  REQUIRE(struts(mesh).size() == 2);
  CHECK(same(struts(mesh)[0], two[1]));
  CHECK(same(struts(mesh)[1], two[0]));

  const double before = std::sqrt(CGAL::squared_distance(mesh.point(Vertex(7)), mesh.point(Vertex(40))));
  for (const RestRule rule : {RestRule::flat, RestRule::drawn, RestRule::copied}) {
    Mesh moved = mesh;
    const RestSnapshot snapshot = take_rest_snapshot(moved);
    moved.point(Vertex(7)) += Vector(0, 0, 0.3);
    const RestReport report = apply_rest_rule(moved, snapshot, rule);
    const double after = std::sqrt(CGAL::squared_distance(moved.point(Vertex(7)), moved.point(Vertex(40))));
    CHECK(report.scaled_struts == (rule == RestRule::flat ? 0u : 1u));
    CHECK(same(struts(moved)[0], two[1]));
    CHECK(struts(moved)[1].rest_length ==
          Approx(rule == RestRule::flat ? 0.5 : 0.5 * after / before).epsilon(1e-14));
    CHECK(struts(moved)[1].stiffness == 3);
  }
}

TEST_CASE("struts: they are the links of a mesh without faces, whose other vertices are loose") {
  Mesh chain;
  for (int i = 0; i < 4; ++i) chain.add_vertex({double(i), 0, 0});
  CHECK(is_chain(chain));
  CHECK(loose_vertices(chain) == std::vector<char>{1, 1, 1, 1});
  set_struts(chain, std::vector<Strut>{{Vertex(0), Vertex(2), 1, 5}});
  CHECK(loose_vertices(chain) == std::vector<char>{0, 1, 0, 1});
  Mesh cloth = grid(6, 6);
  const Vertex alone = cloth.add_vertex({9, 9, 9});
  set_struts(cloth, std::vector<Strut>{{Vertex(0), alone, 1, 5}});
  CHECK_FALSE(is_chain(cloth));
  const std::vector<char> loose = loose_vertices(cloth);
  CHECK(loose[alone] == 1);
  CHECK(std::count(loose.begin(), loose.end(), 1) == 1);
}

TEST_CASE("struts: subdivision drops struts, a vertex that is removed takes its own along") {
  Mesh fine = grid(6, 6);
  set_struts(fine, two);
  loop_subdivide(fine, 1);
  CHECK(struts(fine).empty());
  Mesh mesh = grid(6, 6);
  set_struts(mesh, two);
  CGAL::Euler::remove_center_vertex(mesh.halfedge(Vertex(40)), mesh);
  REQUIRE(struts(mesh).size() == 1);
  CHECK(same(struts(mesh)[0], two[1]));
}
