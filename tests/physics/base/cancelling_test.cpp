// SPDX-License-Identifier: GPL-3.0-or-later
// Work that takes long asks whether it is cancelled: each piece is cancelled at every one of its first
// questions and at the last, and ends with Cancelled or with the best that it had.
#include <algorithm>
#include <catch2/catch.hpp>
#include <climits>
#include <functional>

#include "physics/base/cancel_scope.h"
#include "physics/base/progress.h"
#include "physics/body/compare_colliders.h"
#include "physics/body/distance_field.h"
#include "physics/body/exact_distance.h"
#include "physics/linear/stable_step.h"
#include "physics/pairs/edge_face_crossings.h"
#include "physics/pairs/untangle_contours.h"
#include "physics/pairs/untangle_layers.h"
#include "tests/physics/body/field_inputs.h"
#include "tests/physics/cloth/test_cloths.h"

using namespace furrow::physics;
using namespace furrow::tests;

namespace {

/// Adds a square sheet of 1 m, at y = height + slope x.
void add_sheet(Cloth& cloth, int cells, double height, double slope) {
  const int first = int(cloth.particles.size());
  for (int j = 0; j <= cells; ++j)
    for (int i = 0; i <= cells; ++i) {
      const double x = double(i) / cells - 0.5, z = double(j) / cells - 0.5;
      add_particle(cloth, {x, height + slope * x, z}, 0.01);
    }
  for (int j = 0; j < cells; ++j)
    for (int i = 0; i < cells; ++i) {
      const int a = first + j * (cells + 1) + i, b = a + 1, c = b + cells + 1, d = a + cells + 1;
      cloth.triangles.push_back({a, c, b});
      cloth.triangles.push_back({a, d, c});
    }
}

/// Two sheets that cross each other along a line, as one cloth; the first has 169 particles.
Cloth crossed() {
  Cloth cloth;
  add_sheet(cloth, 12, 0, 0);
  add_sheet(cloth, 11, 0.013, 0.31);
  return cloth;
}

/// How often the work asks, if it is cancelled at question `at`. `thrown`: whether it ended with Cancelled.
int questions(const std::function<void()>& work, int at, bool& thrown) {
  int asked = 0;
  const CancelScope scope([&] { return ++asked >= at; });
  thrown = false;
  try {
    work();
  } catch (const Cancelled&) {
    thrown = true;
  }
  return asked;
}

/// Requires that the work asks at least so often, and that it asks no more than `more` times once it is
/// cancelled.
void check_asks(const std::string& what, int least, const std::function<void()>& work, bool throws,
                int more = 0) {
  CAPTURE(what);
  bool thrown = false;
  const int all = questions(work, INT_MAX, thrown);
  CHECK_FALSE(thrown);
  CHECK(all >= least);
  for (const int at : {1, 2, 3, all / 2, all}) {
    if (at < 1 || at > all) continue;
    CAPTURE(at);
    CHECK(questions(work, at, thrown) <= at + more);
    CHECK(thrown == throws);
  }
}

}  // namespace

TEST_CASE("cancelling: what is asked of a body is broken off within its preparation", "[long]") {
  const TriangleMesh body = sphere(40, 0.3);
  check_asks(
      "ExactDistance", 10, [&] { ExactDistance exact(body); }, true);
  const ExactDistance exact(body);
  DistanceFieldOptions coarse;
  coarse.tolerance = 0.01;
  check_asks(
      "DistanceField", 5, [&] { DistanceField::build(exact, coarse); }, true);
  const DistanceField field = DistanceField::build(exact, coarse);
  CompareOptions points;
  points.points = 1000;
  check_asks(
      "compare_colliders", 10, [&] { compare_colliders(field, exact, body, points); }, true);
}

TEST_CASE("cancelling: the search for the longest step is broken off at each iteration") {
  Cloth cloth = sheet(12, 12, 0.05);
  add_springs_and_masses(cloth, 100, 1, 0.2);
  check_asks(
      "stable_step", 20, [&] { stable_step(cloth); }, true);
}

TEST_CASE("cancelling: cloth that is taken apart keeps the best that was found") {
  const Cloth start = crossed();
  const PairMesh mesh = pair_mesh(start, 0.001);
  const std::size_t before = edge_face_crossings(mesh, start.particles.x).size();
  REQUIRE(before > 0);
  ClothLayers layers;
  layers.turned = {0, 0};
  layers.of_vertex.assign(start.particles.size(), 1);
  std::fill_n(layers.of_vertex.begin(), 169, 0);
  std::vector<Vec3> x;
  const auto in_order = [&] {
    x = start.particles.x;
    untangle_layers(x, mesh, layers);
    CHECK(edge_face_crossings(mesh, x).size() <= before);
  };
  const auto by_contours = [&] {
    x = start.particles.x;
    untangle_contours(x, mesh, {});
    CHECK(edge_face_crossings(mesh, x).size() <= before);
  };
  check_asks("untangle_layers", 3, in_order, false);
  check_asks("untangle_contours", 3, by_contours, false, 1);  // a second try is broken off, too
  int asked = 0;
  const CancelScope scope([&] { return ++asked > 2; });
  x = start.particles.x;
  CHECK(untangle_layers(x, mesh, layers).rounds == 2);
}
