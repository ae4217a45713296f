// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/figure/hem_folds.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <vector>

#include "tests/test_meshes.h"

using namespace furrow::geometry;

namespace {

/// A tube whose radius waves n times around, but for its upper border.
Mesh waving(int n, double amplitude, double squash = 1) {
  Mesh mesh = furrow::tests::cylinder(0.2, 0.3, 240, 3);
  for (Vertex v : mesh.vertices()) {
    const Point p = mesh.point(v);
    const double angle = std::atan2(p.z(), p.x());
    const double factor = 1 + (p.y() < 0.29 ? amplitude / 0.2 * std::cos(n * angle) : 0);
    mesh.point(v) = {factor * p.x() + 0.4, p.y(), squash * factor * p.z() - 0.3};
  }
  return mesh;
}

}  // namespace

TEST_CASE("count_peaks: those that stand out, once around, wherever the sequence starts") {
  std::vector<double> values{0, 3, 2.5, 2.8, 0.5, 2, 0, 1, 0};
  for (std::size_t turn = 0; turn < values.size(); ++turn) {
    CHECK(count_peaks(values, 0.9) == 3);
    CHECK(count_peaks(values, 0.2) == 4);
    CHECK(count_peaks(values, 1.2) == 2);
    CHECK(count_peaks(values, 4) == 0);
    std::rotate(values.begin(), values.begin() + 1, values.end());
  }
  CHECK(count_peaks(std::vector<double>{}, 1) == 0);
  CHECK(count_peaks(std::vector<double>{5, 5}, 1) == 0);
  CHECK_THROWS_AS(count_peaks(values, 0), std::invalid_argument);
  values[0] = NAN;
  CHECK_THROWS_AS(count_peaks(values, 1), std::invalid_argument);
}

TEST_CASE("count_folds: the waves of a hem, from 2 mm on") {
  for (int n : {3, 7, 10}) {
    const Mesh mesh = waving(n, 0.004);
    const auto loops = border_loops(mesh);
    const std::size_t hem = find_border_loop(loops, "bottom"), waist = find_border_loop(loops, "top");
    CHECK(count_folds(mesh, loops[hem]) == n);
    CHECK(count_folds(mesh, loops[waist]) == 0);
    CHECK(count_folds(mesh, loops[hem], 0.009) == 0);
  }
  const Mesh oval = waving(0, 0, 0.8);
  CHECK(count_folds(oval, border_loops(oval)[0]) == 2);
}
