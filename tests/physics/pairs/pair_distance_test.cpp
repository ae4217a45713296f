// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <set>

#include "tests/physics/pairs/random_pairs.h"

using namespace furrow::physics;
using namespace furrow::tests;

namespace {

double length_of(bool edges, const Corners& x) { return std::sqrt(distance_of(edges, x).squared()); }

/// The least distance of sampled points, which is at most the mesh of samples above the true one.
double sampled_distance(bool edges, const Corners& x, int n) {
  double least = 1e9;
  for (int i = 0; i <= n; ++i)
    for (int j = 0; j <= (edges ? n : n - i); ++j) {
      const double s = double(i) / n, t = double(j) / n;
      const Vec3 a = edges ? Vec3((1 - s) * x[0] + s * x[1]) : x[0];
      const Vec3 b = edges ? Vec3((1 - t) * x[2] + t * x[3]) : Vec3((1 - s - t) * x[1] + s * x[2] + t * x[3]);
      least = std::min(least, (a - b).norm());
    }
  return least;
}

/// Which of its weights are 0 or 1: the region.
int region_of(const PairDistance& d) {
  int region = 0;
  for (const double w : d.weights)
    region = 3 * region + (std::abs(w) < 1e-12 ? 0 : std::abs(w) > 1 - 1e-12 ? 1 : 2);
  return region;
}

}  // namespace

TEST_CASE("pair_distance: in all seven and nine regions it is the least distance of sampled points",
          "[long]") {
  for (const bool edges : {false, true}) {
    std::set<int> regions;
    for (std::uint64_t seed = 1; seed <= 2000; ++seed) {
      const Corners x = random_corners(seed);
      const PairDistance d = distance_of(edges, x);
      regions.insert(region_of(d));
      const int n = 40;
      const double found = std::sqrt(d.squared()), sampled = sampled_distance(edges, x, n);
      CHECK(found <= sampled + 1e-12);
      CHECK(found >= sampled - 1.5 / n);
    }
    CHECK(regions.size() == (edges ? 9 : 7));
  }
}

TEST_CASE("pair_distance: weights sum to 0, keep to their ranges and give the way across") {
  for (const bool edges : {false, true})
    for (std::uint64_t seed = 1; seed <= 3000; ++seed) {
      const Corners x = random_corners(seed);
      const PairDistance d = distance_of(edges, x);
      double sum = 0, first = 0;
      Vec3 across = Vec3::Zero();
      for (std::size_t i = 0; i < 4; ++i) {
        sum += d.weights[i];
        across += d.weights[i] * x[i];
        const bool in_first = edges ? i < 2 : i < 1;
        if (in_first) first += d.weights[i];
        CHECK((in_first ? d.weights[i] : -d.weights[i]) >= -1e-15);
      }
      CHECK(std::abs(sum) < 1e-14);
      CHECK(first == Approx(1).epsilon(1e-14));
      CHECK((across - d.across).norm() < 1e-15);
    }
}

TEST_CASE(
    "pair_distance: its derivative is that of differences, and a pair neither pushes nor turns as a whole") {
  for (const bool edges : {false, true})
    for (std::uint64_t seed = 1; seed <= 1000; ++seed) {
      if (seed % 7 == 0) continue;  // short sides: the curvature is beyond such differences
      const Corners x = random_corners(seed);
      const PairDistance d = distance_of(edges, x);
      const double length = std::sqrt(d.squared());
      if (length < 1e-3) continue;
      Vec3 force = Vec3::Zero(), torque = Vec3::Zero();
      for (std::size_t i = 0; i < 4; ++i) {
        const Vec3 slope = d.weights[i] / length * d.across;
        force += slope;
        torque += x[i].cross(slope);
        for (int axis = 0; axis < 3; ++axis) {
          Corners up = x, down = x;
          up[i][axis] += 1e-7;
          down[i][axis] -= 1e-7;
          CHECK(slope[axis] == Approx((length_of(edges, up) - length_of(edges, down)) / 2e-7).margin(3e-4));
        }
      }
      CHECK(force.norm() < 1e-14);
      CHECK(torque.norm() < 1e-14);
    }
}

TEST_CASE(
    "pair_distance: primitives without length or area, and parallel edges, have the distance of their "
    "parts") {
  const Vec3 a(0, 0, 0), b(1, 0, 0), c(2, 0, 0), above(0.5, 0, 0.3);
  CHECK(std::sqrt(vertex_triangle_distance(above, a, b, c).squared()) == Approx(0.3));
  CHECK(std::sqrt(vertex_triangle_distance(above, a, a, a).squared()) == Approx(above.norm()));
  CHECK(std::sqrt(edge_edge_distance(a, b, above, above).squared()) == Approx(0.3));
  CHECK(std::sqrt(edge_edge_distance(a, a, above, above).squared()) == Approx(above.norm()));
  for (const double tilt : {0.0, 1e-12, 1e-9, 1e-7, 1e-5, 1e-3}) {
    const PairDistance d = edge_edge_distance(a, b, Vec3(0.25, 0, 0.1), Vec3(2, tilt, 0.1));
    CHECK(std::sqrt(d.squared()) == Approx(0.1).epsilon(1e-9));
  }
}
