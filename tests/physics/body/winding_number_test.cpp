// SPDX-License-Identifier: GPL-3.0-or-later
#include "physics/body/winding_number.h"

#include <rapidcheck.h>

#include <catch2/catch.hpp>

#include "tests/physics/body/field_inputs.h"

namespace {

using namespace furrow::physics;
using furrow::tests::uniform;

double by_sum(const TriangleMesh& m, const Vec3& x) {
  double w = 0;
  for (const auto& [a, b, c] : m.triangles)
    w += winding_of_triangle(x, m.vertices[a], m.vertices[b], m.vertices[c]);
  return w;
}

Vec3 random_point(std::mt19937_64& random, double reach) {
  return {uniform(random, -reach, reach), uniform(random, -reach, reach), uniform(random, -reach, reach)};
}

}  // namespace

TEST_CASE("winding_number: the winding number of a closed body is 1 inside and 0 outside") {
  const TriangleMesh m = furrow::tests::sphere(24, 1);
  const TriangleBvh bvh(m);
  const WindingNumber w(bvh);
  std::mt19937_64 random(3);
  for (int i = 0; i < 1000; ++i) {
    const Vec3 x = random_point(random, 2);
    if (std::abs(x.norm() - 1) < 0.02) continue;
    REQUIRE(w.at(x) == Approx(x.norm() < 1 ? 1 : 0).margin(0.05));
    REQUIRE(by_sum(m, x) == Approx(x.norm() < 1 ? 1 : 0).margin(1e-12));
  }
}

TEST_CASE("winding_number: the fast winding number follows the exact sum on open and flipped bodies") {
  CHECK(rc::check([] {
    std::mt19937_64 random(*rc::gen::arbitrary<std::uint64_t>());
    TriangleMesh m = furrow::tests::sphere(10, 1);
    for (int i = 0; i < 20; ++i) {
      const std::size_t t = random() % m.triangles.size();
      if (i % 2)
        m.triangles.erase(m.triangles.begin() + static_cast<std::ptrdiff_t>(t));
      else
        std::swap(m.triangles[t][0], m.triangles[t][1]);
    }
    const TriangleBvh bvh(m);
    const WindingNumber w(bvh);
    for (int i = 0; i < 5; ++i) {
      const Vec3 x = random_point(random, 2);
      RC_ASSERT(std::abs(w.at(x) - by_sum(m, x)) < 0.06);
    }
  }));
}

TEST_CASE("winding_number: where two bodies overlap the winding number is 2") {
  TriangleMesh m = furrow::tests::sphere(20, 1);
  furrow::tests::append(m, furrow::tests::sphere(20, 1, {1, 0, 0}));
  const TriangleBvh bvh(m);
  const WindingNumber w(bvh);
  CHECK(w.at({0.5, 0, 0}) == Approx(2).margin(0.03));
  CHECK(w.at({-0.5, 0, 0}) == Approx(1).margin(0.03));
  CHECK(w.at({1.5, 0, 0}) == Approx(1).margin(0.03));
  CHECK(w.at({3, 0, 0}) == Approx(0).margin(0.03));
}

TEST_CASE("winding_number: half of the directions from the middle of an open half sphere hit it") {
  TriangleMesh m = furrow::tests::sphere(30, 1), half;
  half.vertices = m.vertices;
  for (const auto& [a, b, c] : m.triangles)
    if ((m.vertices[a] + m.vertices[b] + m.vertices[c])[2] > 0) half.triangles.push_back({a, b, c});
  const TriangleBvh bvh(half);
  CHECK(WindingNumber(bvh).at({0, 0, 0}) == Approx(0.5).margin(0.01));
}
TEST_CASE("winding_number: bodies in bodies add up beyond a whole turn, wound either way and at any size") {
  for (const double scale : {1.0, 1e-9, 1e8})
    for (const bool turned : {false, true}) {
      TriangleMesh m;
      for (const double radius : {1.0, 0.9, 0.8}) {
        const TriangleMesh ball = furrow::tests::sphere(12, radius * scale);
        const int first = int(m.vertices.size());
        m.vertices.insert(m.vertices.end(), ball.vertices.begin(), ball.vertices.end());
        for (const auto& [a, b, c] : ball.triangles)
          m.triangles.push_back({first + a, first + (turned ? c : b), first + (turned ? b : c)});
      }
      const TriangleBvh bvh(m);
      const WindingNumber w(bvh);
      std::mt19937_64 random(7);
      for (int i = 0; i < 50; ++i) {
        const Vec3 x = scale * random_point(random, 0.3);
        CHECK(w.at(x) == Approx(turned ? -3 : 3).margin(0.15));
      }
    }
}
