// SPDX-License-Identifier: GPL-3.0-or-later
#include "physics/pairs/pair_curvature.h"

#include <Eigen/Dense>
#include <catch2/catch.hpp>
#include <cmath>

#include "tests/physics/pairs/random_pairs.h"

using namespace furrow::physics;
using namespace furrow::tests;

namespace {

using Row = Eigen::Matrix<double, 12, 1>;

constexpr double near = 1e-4;  // m: how far apart pairs are brought

double gap_of(bool edges, const Corners& x) { return std::sqrt(distance_of(edges, x).squared()); }

/// Random corners whose primitives are brought near each other along the line between them.
Corners near_corners(bool edges, std::uint64_t seed) {
  Corners x = random_corners(seed);
  const Vec3 across = distance_of(edges, x).across;
  const Vec3 way = -(1 - near / across.norm()) * across;
  x[0] += way;
  if (edges) x[1] += way;
  return x;
}

/// -dx . d2(distance) . dx by differences.
double fall(bool edges, const Corners& x, const Row& way) {
  constexpr double step = 1e-5;
  Corners ahead = x, behind = x;
  for (int i = 0; i < 4; ++i) {
    ahead[std::size_t(i)] += step * way.segment<3>(3 * i);
    behind[std::size_t(i)] -= step * way.segment<3>(3 * i);
  }
  return -(gap_of(edges, ahead) + gap_of(edges, behind) - 2 * gap_of(edges, x)) / (step * step);
}

/// The row, or with tilt = -1 that of a slide against the tilt.
Row row_of(const PairCurvature& c, int k, const PairDistance& d, double tilt = 1) {
  const Vec3 normal = tilt * d.across.normalized();
  Row row;
  for (std::size_t i = 0; i < 4; ++i) row.segment<3>(3 * Eigen::Index(i)) = c.row(k, i, d.weights, normal);
  return row;
}

double half_of_squares(const PairCurvature& c, const PairDistance& d, const Row& way) {
  double sum = 0;
  for (int k = 0; k < c.rows; ++k) sum += 0.5 * std::pow(row_of(c, k, d).dot(way), 2);
  return sum;
}

bool is_inside(const PairDistance& d) {
  return std::all_of(d.weights.begin(), d.weights.end(), [](double w) { return std::abs(w) > 0.05; });
}

Row random_way(Noise& noise) {
  Row way;
  for (int i = 0; i < 4; ++i) way.segment<3>(3 * i) = noise.vector();
  return way / way.norm();
}

}  // namespace

TEST_CASE("pair_curvature: no distance falls faster to second order than its rows say") {
  for (const bool edges : {false, true}) {
    int inside = 0;
    double most = 0;
    for (std::uint64_t seed = 1; seed <= 3000; ++seed) {
      if (seed % 3 == 0 || seed % 7 == 0) continue;  // flat, or short sides
      const Corners x = near_corners(edges, seed);
      const PairDistance d = distance_of(edges, x);
      if (!is_inside(d)) continue;
      const PairCurvature c = pair_curvature(edges, x, d.weights);
      if (c.rows != 2) continue;
      ++inside;
      Noise noise(seed + 10000);
      for (int k = 0; k < 20; ++k) {
        const Row way = random_way(noise);
        const double scale = c.slide[0].squaredNorm() + c.slide[1].squaredNorm();
        const double found = fall(edges, x, way), bound = half_of_squares(c, d, way);
        CHECK(found <= bound + 1e-2 * scale);
        most = std::max(most, found / bound);
      }
    }
    CHECK(inside > 100);
    CHECK(most > 0.9);
  }
}

TEST_CASE("pair_curvature: where slide and tilt are as the rows have them, it is the second derivative") {
  for (const bool edges : {false, true}) {
    int inside = 0;
    for (std::uint64_t seed = 1; seed <= 3000; ++seed) {
      if (seed % 3 == 0 || seed % 7 == 0) continue;
      const Corners x = near_corners(edges, seed);
      const PairDistance d = distance_of(edges, x);
      const PairCurvature c = pair_curvature(edges, x, d.weights);
      if (!is_inside(d) || c.rows != 2) continue;
      ++inside;
      Eigen::Matrix<double, 12, 2> against;
      for (int k = 0; k < 2; ++k) against.col(k) = row_of(c, k, d, -1);
      Row way = row_of(c, 0, d);
      way -= against * (against.transpose() * against).ldlt().solve(against.transpose() * way);
      way.normalize();
      const double bound = half_of_squares(c, d, way);
      CHECK(fall(edges, x, way) == Approx(bound).epsilon(0.02).margin(1e-3));
    }
    CHECK(inside > 100);
  }
}

TEST_CASE("pair_curvature: at an edge or a corner it has one row or none, and for parallel edges none") {
  const Vec3 a(0, 0, 0), b(1, 0, 0), c(0, 1, 0);
  const auto rows = [](bool edges, const Corners& x) {
    return pair_curvature(edges, x, distance_of(edges, x).weights).rows;
  };
  CHECK(rows(false, {Vec3(0.2, 0.2, 0.01), a, b, c}) == 2);
  CHECK(rows(false, {Vec3(0.5, -0.01, 0), a, b, c}) == 1);
  CHECK(rows(false, {Vec3(-0.01, -0.01, 0), a, b, c}) == 0);
  CHECK(rows(true, {a, b, Vec3(0.5, -1, 0.01), Vec3(0.5, 1, 0.01)}) == 2);
  CHECK(rows(true, {a, b, Vec3(0.5, 0.01, 0.01), Vec3(0.5, 1, 0.01)}) == 1);
  CHECK(rows(true, {a, b, Vec3(0.2, -0.005, 0.01), Vec3(0.7, 0.005, 0.01)}) == 0);
  CHECK(rows(true, {a, b, Vec3(1.01, 0, 0), Vec3(2, 1, 0)}) == 0);
}
