// SPDX-License-Identifier: GPL-3.0-or-later
#include "physics/pairs/untangle_contours.h"

#include <catch2/catch.hpp>
#include <functional>

#include "physics/pairs/edge_face_crossings.h"
#include "physics/pairs/tangle_contours.h"
#include "tests/physics/cloth/test_cloths.h"

using namespace furrow::physics;
using namespace furrow::tests;

namespace {

constexpr double pi = 3.14159265358979323846;

/// A surface over a grid, (columns + 1) x (rows + 1), or `columns` around.
Cloth gridded(int columns, int rows, bool around, const std::function<Vec3(double, double)>& at) {
  Cloth cloth;
  const int across = around ? columns : columns + 1;
  for (int j = 0; j <= rows; ++j)
    for (int i = 0; i < across; ++i) add_particle(cloth, at(double(i) / columns, double(j) / rows), 0.01);
  for (int j = 0; j < rows; ++j)
    for (int i = 0; i < columns; ++i) {
      const int a = j * across + i, b = j * across + (i + 1) % across, c = b + across, d = a + across;
      cloth.triangles.push_back({a, b, c});
      cloth.triangles.push_back({a, c, d});
    }
  return cloth;
}

/// A strip of 0.3 m x 0.62 m that is folded over onto itself: its upper half lies 20 mm over the lower one,
/// less `bulge` in the middle.
Cloth folded(double bulge) {
  constexpr double half = 0.3, r = 0.01;
  return gridded(18, 40, false, [&](double u, double v) -> Vec3 {
    // no edge in the plane of another
    const double s = (v + 0.06 * v * (1 - v)) * (2 * half + pi * r), y = 0.3 * u + 0.02 * v;
    if (s < half) return {s, y, 0};
    if (s < half + pi * r) return {half + r * std::sin((s - half) / r), y, r - r * std::cos((s - half) / r)};
    const double x = 2 * half + pi * r - s, r2 = (x - 0.15) * (x - 0.15) + (y - 0.15) * (y - 0.15);
    return {x, y, 2 * r - bulge * std::exp(-r2 / 0.004)};
  });
}

/// A sleeve of 60 mm radius and 0.6 m, and noise of a length of some 0.1 m.
Cloth noisy_sleeve(double amplitude, std::uint64_t seed) {
  Cloth cloth = gridded(24, 36, true, [](double u, double v) -> Vec3 {
    return {0.06 * std::cos(2 * pi * u), 0.06 * std::sin(2 * pi * u), 0.6 * v};
  });
  Noise noise(seed);
  std::vector<std::array<Vec3, 3>> waves;
  for (int i = 0; i < 8; ++i) waves.push_back({noise.vector(), 60 * noise.vector(), pi * noise.vector()});
  for (Vec3& x : cloth.particles.x) {
    Vec3 by = Vec3::Zero();
    for (const auto& [way, wave, phase] : waves) by += std::sin(wave.dot(x) + phase.x()) * way;
    x += amplitude / 2 * by;
  }
  return cloth;
}

/// Two crossed sheets of 1 m in one cloth: no end is near where they cross.
Cloth crossed_sheets() {
  Cloth cloth = gridded(20, 21, false, [](double u, double v) -> Vec3 {
    return {u - 0.5, 0.1 * (v - 0.5), v - 0.5};
  });
  const Cloth other = gridded(20, 19, false, [](double u, double v) -> Vec3 {
    return {0.01, u - 0.5, v - 0.5};
  });
  const int first = int(cloth.particles.size());
  for (const Vec3& x : other.particles.x) add_particle(cloth, x, 0.01);
  for (const auto& t : other.triangles) cloth.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
  return cloth;
}

std::vector<TangleContour> contours_of(const PairMesh& mesh, std::span<const Vec3> x) {
  return tangle_contours(mesh, x, edge_face_crossings(mesh, x), triangles_of_edges(mesh));
}

}  // namespace

TEST_CASE("tangle_contours: a bulge through a layer is one closed line, and its shortening is its gradient") {
  Cloth cloth = folded(0.03);
  const PairMesh mesh = pair_mesh(folded(0), 0.001);
  std::vector<Vec3>& x = cloth.particles.x;
  const std::vector<TangleContour> contours = contours_of(mesh, x);
  REQUIRE(contours.size() == 1);
  const double r = std::sqrt(0.004 * std::log(1.5));
  CHECK(contours[0].length == Approx(2 * pi * r).epsilon(0.02));
  CHECK((contours[0].middle() - Vec3(0.15, 0.15, 0)).norm() < 5e-3);
  constexpr int lower = 19 * 19;
  const Vec3 way(3e-7, 2e-7, 1e-6);
  double predicted = 0;
  for (const ContourCrossing& c : contours[0].crossings)
    predicted -= (mesh.edges[std::size_t(c.crossing.edge)][0] < lower ? 1 : -1) * way.dot(c.shortening);
  for (std::size_t i = 0; i < x.size(); ++i) x[i] += int(i) < lower ? way : Vec3(-way);
  CHECK(contours_of(mesh, x)[0].length - contours[0].length == Approx(predicted).epsilon(1e-3));
}

TEST_CASE("untangle_contours: a bulge goes back through its own garment") {
  Cloth cloth = folded(0.03);
  const PairMesh mesh = pair_mesh(folded(0), 0.001);
  const ContourReport report = untangle_contours(cloth.particles.x, mesh);
  CHECK(report.at_start > 40);
  CHECK(report.left == 0);
  CHECK(report.lines.empty());
  CHECK(report.rounds < 20);
  CHECK(edge_face_crossings(mesh, cloth.particles.x).empty());
  CHECK(report.farthest < mesh.mean_edge);
}

TEST_CASE("untangle_contours: a sleeve comes apart that noise of 40 mm has crossed", "[long]") {
  for (const std::uint64_t seed : {1, 2, 3, 4, 5, 6}) {
    Cloth cloth = noisy_sleeve(0.04, seed);
    const PairMesh mesh = pair_mesh(noisy_sleeve(0, seed), 0.001);
    const ContourReport report = untangle_contours(cloth.particles.x, mesh);
    INFO("seed " << seed << ", " << report.rounds << " rounds");
    CHECK(report.at_start > 250);
    CHECK(report.left == 0);
    CHECK(report.farthest <= 3 * mesh.mean_edge);
    CHECK(edge_face_crossings(mesh, cloth.particles.x).empty());
  }
}

TEST_CASE("untangle_contours: what cannot be taken apart is told, and not worse") {
  Cloth cloth = crossed_sheets();
  const PairMesh mesh = pair_mesh(cloth, 0.001);
  const ContourReport report = untangle_contours(cloth.particles.x, mesh);
  CHECK(report.left > 0);
  CHECK(report.left <= report.at_start);
  CHECK(report.rounds < 400);
  CHECK(int(edge_face_crossings(mesh, cloth.particles.x).size()) == report.left);
  REQUIRE(!report.lines.empty());
  int crossings = 0;
  for (const CrossingLine& l : report.lines) crossings += l.crossings;
  CHECK(crossings == report.left);
  CHECK(report.lines[0].length == Approx(0.7).epsilon(0.2));
  CHECK(report.lines[0].middle.norm() < 0.2);
}

TEST_CASE(
    "untangle_contours: what is held stays, what does not cross does not move, bad options are refused") {
  Cloth held = folded(0.03), apart = folded(0);
  for (double& w : held.particles.inv_mass) w = 0;
  std::vector<Vec3> before = held.particles.x;
  const ContourReport report = untangle_contours(held.particles.x, pair_mesh(held, 0.001));
  CHECK(report.left == report.at_start);
  CHECK(held.particles.x == before);
  before = apart.particles.x;
  const PairMesh mesh = pair_mesh(apart, 0.001);
  CHECK(untangle_contours(apart.particles.x, mesh).rounds == 0);
  CHECK(apart.particles.x == before);
  for (const ContourOptions& bad : {ContourOptions{.longest_move = 0}, ContourOptions{.farthest = 0},
                                    ContourOptions{.most_rounds = -1}, ContourOptions{.patience = 0}})
    CHECK_THROWS_AS(untangle_contours(apart.particles.x, mesh, bad), std::invalid_argument);
  before.pop_back();
  CHECK_THROWS_AS(untangle_contours(before, mesh), std::invalid_argument);
}
