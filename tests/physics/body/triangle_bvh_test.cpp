// SPDX-License-Identifier: GPL-3.0-or-later
#include "physics/body/triangle_bvh.h"

#include <rapidcheck.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <catch2/catch.hpp>

#include "physics/body/surface_topology.h"
#include "physics/body/triangle_crossings.h"
#include "tests/physics/body/field_inputs.h"

namespace {

using namespace furrow::physics;
using furrow::tests::uniform;

TriangleMesh random_soup(std::mt19937_64& random, int count, double triangle_size) {
  TriangleMesh m;
  for (int t = 0; t < count; ++t) {
    const Vec3 centre(uniform(random, -1, 1), uniform(random, -1, 1), uniform(random, -1, 1));
    for (int k = 0; k < 3; ++k)
      m.vertices.push_back(centre + triangle_size * Vec3(uniform(random, -1, 1), uniform(random, -1, 1),
                                                         uniform(random, -1, 1)));
    if (t % 5 == 0) m.vertices.back() = m.vertices[3 * t] + 1e-9 * Vec3(1, 2, 3);  // a needle
    if (t % 7 == 0) m.vertices.back() = m.vertices[3 * t];                         // no area
    m.triangles.push_back({3 * t, 3 * t + 1, 3 * t + 2});
  }
  return m;
}

double by_brute_force(const TriangleMesh& m, const Vec3& x) {
  double best = 1e300;
  for (const auto& [a, b, c] : m.triangles) {
    const auto q = closest_on_triangle(x, m.vertices[a], m.vertices[b], m.vertices[c]);
    best = std::min(best, (x - q.point).squaredNorm());
  }
  return best;
}

}  // namespace

TEST_CASE("triangle_bvh: the closest point is the one of an exhaustive search") {
  CHECK(rc::check([] {
    std::mt19937_64 random(*rc::gen::arbitrary<std::uint64_t>());
    const int count = *rc::gen::inRange(1, 200);
    const TriangleMesh m = random_soup(random, count, std::pow(10.0, uniform(random, -4, 1)));
    const TriangleBvh bvh(m);
    for (int i = 0; i < 10; ++i) {
      const double far = std::pow(10.0, uniform(random, -2, 4));
      const Vec3 x(far * uniform(random, -1, 1), far * uniform(random, -1, 1), far * uniform(random, -1, 1));
      const double exact = std::sqrt(by_brute_force(m, x));
      const ClosestPoint q = bvh.closest(x), guessed = bvh.closest(x, static_cast<int>(random() % count));
      RC_ASSERT(std::abs(std::sqrt(q.squared_distance) - exact) <= 1e-12 * (far + exact));
      RC_ASSERT(std::abs((x - q.point).squaredNorm() - q.squared_distance) <= 1e-12 * q.squared_distance);
      RC_ASSERT(std::abs(std::sqrt(guessed.squared_distance) - exact) <= 1e-12 * (far + exact));
    }
  }));
}

namespace {

/// A cone of n needles from its rim to its apex, turned out of all axes, and its floor, a fan as well.
TriangleMesh cone_of_needles(int n) {
  TriangleMesh m;
  const Eigen::AngleAxisd turn(0.7, Vec3(1, 2, 3).normalized());
  for (int i = 0; i < n; ++i) {
    const double angle = 2 * 3.14159265358979 * i / n;
    m.vertices.push_back(turn * Vec3(0.3 * std::cos(angle), 0, 0.3 * std::sin(angle)));
  }
  m.vertices.push_back(turn * Vec3(0, 0.2, 0));
  m.vertices.push_back(turn * Vec3(0, 0, 0));
  for (int i = 0; i < n; ++i) {
    m.triangles.push_back({(i + 1) % n, i, n});
    m.triangles.push_back({i, (i + 1) % n, n + 1});
  }
  return m;
}

}  // namespace

TEST_CASE("triangle_bvh: fans of needles have boxes along them, and the search stays exact", "[long]") {
  const TriangleMesh m = cone_of_needles(2000);
  const TriangleBvh bvh(m);
  REQUIRE(bvh.has_oriented_boxes());
  REQUIRE(bvh.has_corner_cones());
  const TriangleBvh plain(furrow::tests::sphere(40, 0.8));
  REQUIRE_FALSE(plain.has_oriented_boxes());
  REQUIRE_FALSE(plain.has_corner_cones());
  std::mt19937_64 random(3);
  for (int i = 0; i < 600; ++i) {
    const double far = std::pow(10.0, uniform(random, -3, 2));
    const Vec3 from = i % 3 ? m.vertices[2000 + std::size_t(i) % 2] : Vec3::Zero();  // apex, floor's middle
    const Vec3 x = from + far * Vec3(uniform(random, -1, 1), uniform(random, -1, 1), uniform(random, -1, 1));
    const double exact = std::sqrt(by_brute_force(m, x));
    const ClosestPoint q = bvh.closest(x);
    REQUIRE(std::abs(std::sqrt(q.squared_distance) - exact) <= 1e-12 * (far + exact));
    const auto& [a, b, c] = bvh.corners(q.triangle);
    REQUIRE((closest_on_triangle(x, a, b, c).point - q.point).norm() <= 1e-9 * (far + exact));
  }
}

TEST_CASE(
    "triangle_bvh: triangles that meet at a corner and nowhere else are searched exactly, as a soup, too") {
  std::mt19937_64 random(5);
  TriangleMesh m;
  std::vector<char> dropped;
  for (int t = 0; t < 1500; ++t) {
    const Vec3 p(uniform(random, -1, 1), uniform(random, -1, 1), uniform(random, -1, 1));
    m.vertices.push_back({0.25, -0.5, 0.125});
    m.vertices.push_back(p);
    m.vertices.push_back(p +
                         0.3 * Vec3(uniform(random, -1, 1), uniform(random, -1, 1), uniform(random, -1, 1)));
    m.triangles.push_back({3 * t, 3 * t + 1, 3 * t + 2});
    dropped.push_back(t % 3 == 0);
  }
  TriangleBvh bvh(m);
  REQUIRE(bvh.has_corner_cones());
  bvh.drop(dropped);
  TriangleMesh kept{m.vertices, {}};
  for (std::size_t t = 0; t < dropped.size(); ++t)
    if (!dropped[t]) kept.triangles.push_back(m.triangles[t]);
  for (int i = 0; i < 500; ++i) {
    const double far = std::pow(10.0, uniform(random, -3, 1));
    const Vec3 x =
        m.vertices[0] + far * Vec3(uniform(random, -1, 1), uniform(random, -1, 1), uniform(random, -1, 1));
    const double exact = std::sqrt(by_brute_force(kept, x));
    const ClosestPoint q = bvh.closest(x);
    REQUIRE(std::abs(std::sqrt(q.squared_distance) - exact) <= 1e-12 * (far + exact));
    REQUIRE_FALSE(dropped[std::size_t(q.triangle)]);
  }
}

namespace {

/// Leaves that a search looks at on average, for places around a point.
double looked_at(const TriangleBvh& bvh, const Vec3& around, double far) {
  std::mt19937_64 random(4);
  std::int64_t leaves = 0;
  constexpr int searches = 1000;
  for (int i = 0; i < searches; ++i)
    bvh.closest(around + far * Vec3(uniform(random, -1, 1), uniform(random, -1, 1), uniform(random, -1, 1)),
                0, &leaves);
  return double(leaves) / searches;
}

}  // namespace

TEST_CASE("triangle_bvh: beside a fan of needles the search looks at few of them, however many there are",
          "[long]") {
  const TriangleMesh few = cone_of_needles(5000), many = cone_of_needles(40000);
  const TriangleBvh a(few), b(many);
  for (const double far : {0.4, 0.02}) {  // a third of the places around the apex have it as closest point
    const double floor[] = {looked_at(a, Vec3::Zero(), far), looked_at(b, Vec3::Zero(), far)};
    const double apex[] = {looked_at(a, few.vertices[5000], far), looked_at(b, many.vertices[40000], far)};
    CAPTURE(far, floor[0], floor[1], apex[0], apex[1]);
    CHECK(floor[0] < 60);
    CHECK(floor[1] < 250);  // of 20,000 leaves: those that are as near but for the rounding of float
    CHECK(apex[0] < 60);
    CHECK(apex[1] < 250);
  }
}

TEST_CASE("triangle_bvh: dropped triangles are not found, and one must stay") {
  const TriangleMesh m = furrow::tests::box({0, 0, 0}, {1, 1, 1});
  TriangleBvh bvh(m);
  std::vector<char> dropped(12, 1);
  dropped[2] = dropped[3] = 0;  // the face z = 1
  bvh.drop(dropped);
  CHECK(bvh.closest({0.5, 0.5, -1}).squared_distance == Approx(4));
  dropped[2] = dropped[3] = 1;
  CHECK_THROWS_AS(bvh.drop(dropped), std::invalid_argument);
  CHECK_THROWS_AS(bvh.drop(std::vector<char>(3, 0)), std::invalid_argument);
}

TEST_CASE("triangle_bvh: the feature of a closest point tells face, edge and corner") {
  const Vec3 a(0, 0, 0), b(1, 0, 0), c(0, 1, 0);
  CHECK(closest_on_triangle({0.2, 0.2, 3}, a, b, c).feature == Feature::face);
  CHECK(closest_on_triangle({0.5, -1, 3}, a, b, c).feature == Feature::edge01);
  CHECK(closest_on_triangle({1, 1, 3}, a, b, c).feature == Feature::edge12);
  CHECK(closest_on_triangle({-1, 0.5, 3}, a, b, c).feature == Feature::edge20);
  CHECK(closest_on_triangle({-1, -1, 3}, a, b, c).feature == Feature::corner0);
  CHECK(closest_on_triangle({3, 0, 3}, a, b, c).feature == Feature::corner1);
  CHECK(closest_on_triangle({0, 3, 3}, a, b, c).feature == Feature::corner2);
  CHECK((closest_on_triangle({0.4, 5, 0}, a, b, Vec3(0.5, 0, 0)).point - Vec3(0.4, 0, 0)).norm() < 1e-15);
}

TEST_CASE("triangle_bvh: crossed triangles are found, neighbours and flat faces are not taken for them") {
  const auto crossed_of = [](const TriangleMesh& m) {
    const auto crossed = crossed_triangles(TriangleBvh(m), surface_topology(m));
    return std::count(crossed.begin(), crossed.end(), 1);
  };
  TriangleMesh m = furrow::tests::box({0, 0, 0}, {1, 1, 1});
  CHECK(crossed_of(m) == 0);
  CHECK(crossed_of(furrow::tests::sphere(12, 1)) == 0);
  furrow::tests::append(m, furrow::tests::box({2, 0, 0}, {3, 1, 1}));
  CHECK(crossed_of(m) == 0);
  furrow::tests::append(m, furrow::tests::box({2.5, 0.25, 0.25}, {4, 0.75, 0.75}));  // through the face x = 3
  CHECK(crossed_of(m) == 2 + 8);
  TriangleMesh fold;  // two triangles on top of each other over an edge
  fold.vertices = {{0, 0, 0}, {1, 0, 0}, {0.3, 1, 0}, {0.4, 0.8, 0}};
  fold.triangles = {{0, 1, 2}, {1, 0, 3}};
  CHECK(crossed_of(fold) == 2);
}

TEST_CASE("triangle_bvh: the topology counts borders, irregular edges and merged vertices") {
  TriangleMesh m = furrow::tests::box({0, 0, 0}, {1, 1, 1});
  CHECK(surface_topology(m).closed);
  TriangleMesh soup;
  for (const auto& t : m.triangles)
    for (int v : t) soup.vertices.push_back(m.vertices[v]);
  for (int t = 0; t < 12; ++t) soup.triangles.push_back({3 * t, 3 * t + 1, 3 * t + 2});
  const SurfaceTopology welded = surface_topology(soup);
  CHECK(welded.vertices == 8);
  CHECK(welded.closed);
  CHECK(std::count(welded.sound.begin(), welded.sound.end(), 1) == 12);
  soup.triangles.pop_back();
  CHECK(surface_topology(soup).border_edges == 3);
  CHECK_FALSE(surface_topology(soup).closed);
  std::swap(m.triangles[0][1], m.triangles[0][2]);
  CHECK(surface_topology(m).irregular_edges == 3);
  CHECK_FALSE(surface_topology(m).closed);
  TriangleMesh pinched = furrow::tests::box({0, 0, 0}, {1, 1, 1});  // two boxes that share one corner
  furrow::tests::append(pinched, furrow::tests::box({1, 1, 1}, {2, 2, 2}));
  const SurfaceTopology s = surface_topology(pinched);
  CHECK(s.closed);
  CHECK(std::count(s.sound.begin(), s.sound.end(), 0) > 0);
}
