// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/fold/line_press.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <stdexcept>

#include "geometry/mesh/press_map.h"
#include "geometry/mesh/property_names.h"
#include "geometry/mesh/sheet.h"
#include "tests/test_meshes.h"

using namespace furrow::geometry;

namespace {

/// Two lines across, at a third and at two thirds of the height.
Mesh two_lines() {
  Mesh mesh = equilateral_sheet(0.6, 0.6, 0.02);
  auto line = ensure_map(mesh, attribute::line);
  for (Vertex v : mesh.vertices())
    for (int i : {0, 1})
      if (std::abs(mesh.point(v).y() - 0.2 * (i + 1)) < 0.009) line[v] = i;
  return mesh;
}

}  // namespace

TEST_CASE("hinge_presses: of each line within its width, the greater where two meet, else 1") {
  const Mesh mesh = two_lines();
  CHECK(hinge_presses(mesh, {}, {}).empty());
  CHECK(hinge_presses(mesh, {1, 1}, {}).empty());
  const std::vector<double> apart = hinge_presses(mesh, {10, 3}, {0.06, 0.1}),
                            meeting = hinge_presses(mesh, {10, 3}, {0.06, 0.5});
  REQUIRE(apart.size() == mesh.num_edges());
  for (Edge e : mesh.edges()) {
    const auto reach = [&](double y) {
      return std::max(std::abs(mesh.point(mesh.vertex(e, 0)).y() - y),
                      std::abs(mesh.point(mesh.vertex(e, 1)).y() - y));
    };
    if (reach(0.2) < 0.03) CHECK((apart[e.idx()] == 10 && meeting[e.idx()] == 10));
    if (reach(0.4) < 0.05) CHECK((apart[e.idx()] == 3 && meeting[e.idx()] == 3));
    if (reach(0.2) > 0.08 && reach(0.4) > 0.1) CHECK(apart[e.idx()] == 1);
  }
}

TEST_CASE("hinge_presses: what an edge has of its own goes before that of lines") {
  Mesh mesh = two_lines();
  const std::vector<double> lines = hinge_presses(mesh, {10, 3}, {0.06, 0.1});
  auto own = ensure_map(mesh, attribute::press);
  CHECK(hinge_presses(mesh, {10, 3}, {0.06, 0.1}) == lines);  // unset
  const Edge first(5), second(6);
  own[first] = 7, own[second] = 1;
  std::vector<double> wanted = lines;
  wanted[first.idx()] = 7, wanted[second.idx()] = 1;
  CHECK(hinge_presses(mesh, {10, 3}, {0.06, 0.1}) == wanted);
  CHECK(hinge_presses(mesh, {}, {})[first.idx()] == 7);
  CHECK(presses_of_lines(mesh, {10, 3}, {0.06, 0.1}) == lines);
  own[second] = -1;
  CHECK_THROWS_WITH(hinge_presses(mesh, {}, {}), Catch::Contains("press -1"));
}

TEST_CASE("hinge_presses: it refuses what is less than 1") {
  const Mesh mesh = two_lines();
  CHECK_THROWS_WITH(hinge_presses(mesh, {1, 0.5}, {}), Catch::Contains("line 1 is 0.5"));
  CHECK_THROWS_AS(hinge_presses(mesh, {NAN}, {}), std::invalid_argument);
}
