// SPDX-License-Identifier: GPL-3.0-or-later
#include "physics/body/exact_distance.h"

#include <rapidcheck.h>

#include <catch2/catch.hpp>
#include <limits>
#include <numbers>

#include "tests/physics/body/field_inputs.h"
#include "tests/test_paths.h"

namespace {

using namespace furrow::physics;
using furrow::tests::uniform;

double box_distance(const Vec3& x, const Vec3& low, const Vec3& high) {
  const Vec3 beyond = (low - x).cwiseMax(x - high);
  return beyond.cwiseMax(0).norm() + std::min(0.0, beyond.maxCoeff());
}

void check_against(const char* mesh, const char* csv) {
  const auto meshes = furrow::tests::shared_dir() / "meshes";
  const ExactDistance exact(furrow::tests::read_obj(meshes / mesh));
  const auto rows = furrow::tests::read_distances(meshes / csv);
  REQUIRE(rows.size() == 2000);
  double largest = 0;
  for (const auto& row : rows) largest = std::max(largest, std::abs(exact.at(row.x).value - row.distance));
  CHECK(largest < 1e-9);
}

/// Share of points at which the sign is not that of `inside`, of those at least `away` from the surface.
template <class Inside>
double wrong_signs(const ExactDistance& exact, double reach, double away, Inside inside) {
  std::mt19937_64 random(5);
  int wrong = 0, seen = 0;
  while (seen < 2000) {
    const Vec3 x(uniform(random, -reach, reach), uniform(random, -reach, reach),
                 uniform(random, -reach, reach));
    const double d = exact.at(x).value;
    if (std::abs(d) < away) continue;
    ++seen;
    wrong += (d < 0) != inside(x);
  }
  return wrong / 2000.0;
}

}  // namespace

TEST_CASE("exact_distance: the exact distance of a box is the analytic one, value and gradient") {
  const Vec3 low(-0.3, -0.2, 0.1), high(0.5, 0.4, 0.6);
  const ExactDistance exact(furrow::tests::box(low, high));
  CHECK(exact.report().rule == SignRule::pseudonormal);
  CHECK(exact.report().signed_volume == Approx(0.8 * 0.6 * 0.5));
  CHECK(rc::check([&] {
    std::mt19937_64 random(*rc::gen::arbitrary<std::uint64_t>());
    const Vec3 x(uniform(random, -1, 1), uniform(random, -1, 1), uniform(random, -1, 1));
    const SignedDistance d = exact.at(x);
    RC_ASSERT(std::abs(d.value - box_distance(x, low, high)) < 1e-14);
    RC_ASSERT(std::abs(d.gradient.norm() - 1) < 1e-9);
    RC_ASSERT(std::abs(exact.at(x - d.value * d.gradient).value) < 1e-14);
  }));
}

TEST_CASE("exact_distance: the exact distance agrees with the reference samples of a body and a torus") {
  if (!furrow::tests::have_shared()) {
    WARN("skipped: no shared data");
    return;
  }
  check_against("pairs/mh_male/body.obj", "accuracy/mh_male_body_sdf.csv");
  check_against("closed/torus.obj", "accuracy/torus_sdf.csv");
}

TEST_CASE("exact_distance: a soup without shared vertices has the same sign") {
  const TriangleMesh m = furrow::tests::sphere(16, 1);
  TriangleMesh soup;
  for (const auto& t : m.triangles) {
    const int n = static_cast<int>(soup.vertices.size());
    for (int v : t) soup.vertices.push_back(m.vertices[v]);
    soup.triangles.push_back({n, n + 1, n + 2});
  }
  const ExactDistance exact(soup);
  CHECK(exact.report().rule == SignRule::pseudonormal);
  CHECK(wrong_signs(exact, 1.5, 0.02, [](const Vec3& x) { return x.norm() < 1; }) == 0);
}

TEST_CASE(
    "exact_distance: of two overlapping spheres inner walls stay walls only where they cross, no sign is "
    "wrong") {
  TriangleMesh m = furrow::tests::sphere(24, 1, {-0.5, 0, 0});
  furrow::tests::append(m, furrow::tests::sphere(24, 1, {0.5, 0.01, 0.02}));
  const ExactDistance exact(m);
  CHECK(exact.report().rule == SignRule::sides);
  CHECK(exact.report().closed);
  CHECK(exact.report().crossed_triangles > 0);
  CHECK(exact.report().dropped_triangles > 500);
  CHECK(exact.report().disagreement > 0.005);
  const auto inside = [](const Vec3& x) {
    return (x - Vec3(-0.5, 0, 0)).norm() < 1 || (x - Vec3(0.5, 0.01, 0.02)).norm() < 1;
  };
  CHECK(wrong_signs(exact, 1.8, 0.02, inside) == 0);
  CHECK(exact.at({0, 0, 0}).value < -0.6);  // the lens between the spheres is no wall any more
}

TEST_CASE("exact_distance: a body inside a body is an inner wall") {
  TriangleMesh m = furrow::tests::sphere(16, 1);
  furrow::tests::append(m, furrow::tests::box({-0.1, -0.1, -0.1}, {0.1, 0.1, 0.1}));
  const ExactDistance exact(m);
  CHECK(exact.report().dropped_triangles == 12);
  CHECK(exact.at({0, 0, 0}).value < -0.9);
}

TEST_CASE("exact_distance: a cavity with its faces turned inwards stays outside") {
  TriangleMesh m = furrow::tests::sphere(16, 1),
               hole = furrow::tests::box({-0.3, -0.3, -0.3}, {0.3, 0.3, 0.3});
  for (auto& t : hole.triangles) std::swap(t[0], t[1]);
  furrow::tests::append(m, hole);
  const ExactDistance exact(m);
  CHECK(exact.report().rule == SignRule::pseudonormal);
  CHECK(exact.at({0, 0, 0}).value == Approx(0.3));
  CHECK(exact.at({0.5, 0, 0}).value == Approx(-0.2));
}

TEST_CASE("exact_distance: flipped and missing triangles leave the sign right away from the surface") {
  TriangleMesh flipped = furrow::tests::sphere(24, 1), open = flipped;
  for (std::size_t t = 0; t < flipped.triangles.size(); t += 20)
    std::swap(flipped.triangles[t][0], flipped.triangles[t][1]);
  const auto inside = [](const Vec3& x) { return x.norm() < 1; };
  const ExactDistance of_flipped(flipped);
  CHECK(of_flipped.report().rule == SignRule::winding);
  CHECK(of_flipped.report().irregular_edges > 0);
  CHECK(wrong_signs(of_flipped, 1.3, 0.1, inside) < 0.01);
  std::erase_if(open.triangles, [i = 0](const auto&) mutable { return i++ % 50 == 0; });
  const ExactDistance of_open(open);
  CHECK(of_open.report().rule == SignRule::winding);
  CHECK(of_open.report().border_edges > 0);
  CHECK(wrong_signs(of_open, 1.3, 0.1, inside) == 0);
}

TEST_CASE("exact_distance: a sample with the help of a neighbour is the sample without") {
  TriangleMesh m = furrow::tests::sphere(12, 1);
  furrow::tests::append(m, furrow::tests::sphere(12, 0.7, {0.8, 0, 0}));
  for (bool open : {false, true}) {
    if (open) m.triangles.erase(m.triangles.begin() + 100);
    const ExactDistance exact(m);
    std::mt19937_64 random(9);
    Vec3 y(0, 0, 0);
    auto at_y = exact.sample(y);
    for (int i = 0; i < 3000; ++i) {
      const Vec3 x = y + 0.1 * Vec3(uniform(random, -1, 1), uniform(random, -1, 1), uniform(random, -1, 1));
      const auto helped = exact.sample(x, y, at_y);
      REQUIRE(std::abs(helped.value) == Approx(std::abs(exact.sample(x).value)).epsilon(1e-12));
      if (!open) REQUIRE((helped.value < 0) == (exact.sample(x).value < 0));
      y = x.norm() < 2 ? x : Vec3(0, 0, 0);
      at_y = exact.sample(y);
    }
  }
}

TEST_CASE("exact_distance: signs are compared at fewer places where each sums over thousands of triangles") {
  constexpr int rim = 4000;
  TriangleMesh cone;
  cone.vertices = {{0, 1, 0}, {0, -0.2, 0}};
  for (int i = 0; i < rim; ++i) {
    const double angle = 2 * std::numbers::pi * i / rim;
    cone.vertices.push_back({0.3 * std::cos(angle), 0, 0.3 * std::sin(angle)});
  }
  for (int i = 0; i < rim; ++i) {
    cone.triangles.push_back({0, 2 + (i + 1) % rim, 2 + i});
    cone.triangles.push_back({1, 2 + i, 2 + (i + 1) % rim});
  }
  const ExactDistance exact(cone);
  CHECK(exact.report().samples == 400);
  CHECK(exact.report().rule == SignRule::pseudonormal);
  CHECK(exact.at({0.1, 0.3, 0.05}).value < 0);
  CHECK(exact.at({0.1, 0.8, 0.05}).value > 0);
  CHECK(ExactDistance(furrow::tests::sphere(24, 1)).report().samples == 2000);
}

TEST_CASE("exact_distance: penetration counts and measures points inside") {
  const ExactDistance exact(furrow::tests::box({0, 0, 0}, {1, 1, 1}));
  const std::vector<Vec3> points{{0.5, 0.5, 0.1}, {0.5, 0.5, 2}, {0.9, 0.5, 0.5}, {0.5, 0.5, 0.3}};
  const Penetration p = penetration(exact, points);
  CHECK(p.inside == 3);
  CHECK(p.deepest == Approx(0.3));
  CHECK(penetration(exact, {}).inside == 0);
}

TEST_CASE("exact_distance: one triangle is a body without an inside, unusable bodies are refused") {
  TriangleMesh m;
  m.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  CHECK_THROWS_AS(ExactDistance(m), std::invalid_argument);
  m.triangles = {{0, 1, 2}};
  const ExactDistance one(m);
  CHECK(one.at({0.2, 0.2, 0.5}).value == Approx(0.5));
  CHECK(one.report().rule == SignRule::winding);
  m.triangles = {{0, 1, 3}};
  CHECK_THROWS_WITH(ExactDistance(m), Catch::Contains("vertex 3 of 3"));
  m.triangles = {{0, 1, 1}};
  CHECK_THROWS_WITH(ExactDistance(m), Catch::Contains("area"));
  m.triangles = {{0, 1, 2}};
  m.vertices[1][2] = std::numeric_limits<double>::quiet_NaN();
  CHECK_THROWS_WITH(ExactDistance(m), Catch::Contains("vertex 1 is not finite"));
}

namespace {

/// Two cones on one rim: `n` faces meet at either tip.
TriangleMesh double_cone(int n) {
  TriangleMesh m;
  m.vertices = {{0, 0.5, 0}, {0, -0.5, 0}};
  for (int i = 0; i < n; ++i) {
    const double angle = 2 * 3.14159265358979323846 * i / n;
    m.vertices.emplace_back(0.5 * std::cos(angle), 0, 0.5 * std::sin(angle));
  }
  for (int i = 0; i < n; ++i) {
    const int a = 2 + i, b = 2 + (i + 1) % n;
    m.triangles.push_back({0, b, a});
    m.triangles.push_back({1, a, b});
  }
  return m;
}

}  // namespace

TEST_CASE("exact_distance: thousands of faces at a vertex are sound, and what pierces them is still found") {
  const int n = 3000;
  TriangleMesh m = double_cone(n);
  const ExactDistance cone(m);
  CHECK(cone.report().closed);
  CHECK(cone.report().crossed_triangles == 0);
  CHECK(cone.report().rule == SignRule::pseudonormal);
  const double slope = 0.5 / std::sqrt(2);  // from the middle to the surface
  CHECK(cone.at({0, 0, 0}).value == Approx(-slope).epsilon(1e-5));
  CHECK(cone.at({0.4, 0.4, 0}).value == Approx(0.3 / std::sqrt(2)).epsilon(1e-5));
  const int first = int(m.vertices.size());
  for (const Vec3& p : {Vec3(0.2, 0.2, 0), Vec3(0.4, 0.4, 0), Vec3(0.4, 0.2, 0.1), Vec3(0.4, 0.2, -0.1)})
    m.vertices.push_back(p);
  const std::vector<std::array<int, 3>> faces = {{0, 1, 2}, {0, 3, 1}, {0, 2, 3}, {1, 3, 2}};
  for (const auto& [a, b, c] : faces) m.triangles.push_back({first + a, first + b, first + c});
  CHECK(ExactDistance(m).report().crossed_triangles > 2);
}
