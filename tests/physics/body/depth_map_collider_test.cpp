// SPDX-License-Identifier: GPL-3.0-or-later
#include "physics/body/depth_map_collider.h"

#include <catch2/catch.hpp>
#include <limits>

#include "physics/body/collider.h"
#include "physics/body/exact_distance.h"
#include "tests/physics/body/field_inputs.h"

namespace {

using namespace furrow::physics;
using furrow::tests::uniform;

/// Around the axis y: rings of radius `small` around a circle of radius `large`.
TriangleMesh torus(double large, double small, int around = 96, int rings = 48) {
  TriangleMesh m;
  const double turn = 2 * 3.14159265358979323846;
  for (int i = 0; i < around; ++i)
    for (int k = 0; k < rings; ++k) {
      const double a = turn * i / around, b = turn * k / rings, r = large + small * std::cos(b);
      m.vertices.emplace_back(r * std::sin(a), small * std::sin(b), r * std::cos(a));
    }
  const auto at = [&](int i, int k) { return (i % around) * rings + k % rings; };
  for (int i = 0; i < around; ++i)
    for (int k = 0; k < rings; ++k) {
      m.triangles.push_back({at(i, k), at(i + 1, k), at(i + 1, k + 1)});
      m.triangles.push_back({at(i, k), at(i + 1, k + 1), at(i, k + 1)});
    }
  return m;
}

DepthMapOptions with(DepthMaps maps, int size = 512) {
  DepthMapOptions options;
  options.maps = maps;
  options.size = size;
  return options;
}

Vec3 random_vector(std::mt19937_64& random, double reach) {
  return {uniform(random, -reach, reach), uniform(random, -reach, reach), uniform(random, -reach, reach)};
}

struct Worst {
  int wrong_sides = 0;
  double value = 0, angle = 0;
};

/// At points up to 4 mm from the surface, where cloth is; sides are asked for beyond half a millimetre.
Worst worst_near(const Collider& collider, const ExactDistance& exact, const TriangleMesh& m) {
  std::mt19937_64 random(3);
  Worst worst;
  for (int i = 0; i < 5000; ++i) {
    const Vec3 on = furrow::tests::on_surface(m, random);
    const Vec3 x = on + uniform(random, -0.004, 0.004) * exact.at(on).gradient;
    const SignedDistance is = exact.at(x), said = collider.at(x);
    if (std::abs(is.value) > 5e-4) worst.wrong_sides += (said.value < 0) != (is.value < 0);
    worst.value = std::max(worst.value, std::abs(said.value - is.value));
    worst.angle = std::max(worst.angle, std::acos(std::min(1.0, said.gradient.dot(is.gradient))));
  }
  return worst;
}

bool same_bits(const Collider& a, const Collider& b, double reach) {
  std::mt19937_64 random(9);
  for (int i = 0; i < 5000; ++i) {
    const Vec3 x = random_vector(random, reach);
    const SignedDistance d = a.at(x), e = b.at(x);
    if (d.value != e.value || d.gradient != e.gradient) return false;
  }
  return true;
}

}  // namespace

TEST_CASE("depth_map_collider: near a ball it is the exact distance, with a smooth normal") {
  const TriangleMesh m = furrow::tests::sphere(40, 0.2, {0.3, 1, -0.1});
  const ExactDistance exact(m);
  const Worst three = worst_near(DepthMapCollider(m), exact, m),
              six = worst_near(DepthMapCollider(m, with(DepthMaps::six)), exact, m);
  CHECK(three.wrong_sides == 0);
  CHECK(three.value < 2.5e-3);
  CHECK(six.wrong_sides == 0);
  CHECK(six.value < 6e-4);
  CHECK(six.angle < 0.06);  // half the angle between two triangles
}

TEST_CASE("depth_map_collider: a ring is open along a line of sight through it") {
  const TriangleMesh m = torus(0.3, 0.08);
  const ExactDistance exact(m);
  REQUIRE(exact.at({0, 0, 0}).value == Approx(0.22).epsilon(0.01));
  CHECK(DepthMapCollider(m, with(DepthMaps::front_back)).at({0, 0, 0}).value < 0);
  const DepthMapCollider three(m);
  CHECK(three.at({0, 0, 0}).value == Approx(three.reach()));
  CHECK(worst_near(three, exact, m).wrong_sides > 100);  // the lower half of the inside is hidden from above
  const Worst six = worst_near(DepthMapCollider(m, with(DepthMaps::six)), exact, m);
  CHECK(six.wrong_sides < 5);
  CHECK(six.value < 8e-3);  // there, seen from above and below at a grazing angle
}

TEST_CASE("depth_map_collider: the sides of a box along the lines of sight are seen") {
  const Vec3 low(-0.1, 0, -0.05), high(0.1, 0.4, 0.05);
  const TriangleMesh m = furrow::tests::box(low, high);
  const DepthMapCollider collider(m);
  std::mt19937_64 random(4);
  for (int i = 0; i < 3000; ++i) {
    const Vec3 x = Vec3(0, 0.2, 0) + random_vector(random, 0.22);
    const Vec3 beyond = (low - x).cwiseMax(x - high);
    if (std::abs(beyond.maxCoeff()) < 1e-9) continue;
    INFO(x.transpose());
    CHECK((collider.at(x).value < 0) == (beyond.maxCoeff() < 0));
  }
}

TEST_CASE("depth_map_collider: sharp edges stay sharp") {
  const Vec3 low(-0.1, 0, -0.05), high(0.1, 0.4, 0.05);
  const TriangleMesh m = furrow::tests::box(low, high);
  const DepthMapCollider three(m), six(m, with(DepthMaps::six));
  std::mt19937_64 random(4);
  for (int i = 0; i < 1000; ++i) {
    const double u = uniform(random, 0.05, 0.95), v = uniform(random, 0.05, 0.95),
                 gap = uniform(random, -0.002, 0.01);
    const Vec3 front(low[0] + 0.2 * u, 0.4 * v, high[2] + gap), top(front[0], high[1] + gap, 0.1 * v - 0.05),
        side(high[0] + gap, front[1], top[2]);
    for (const Vec3& x : {front, top}) CHECK(three.at(x).value == Approx(gap).margin(1e-12));
    for (const Vec3& x : {front, top, side}) CHECK(six.at(x).value == Approx(gap).margin(1e-12));
    CHECK((six.at(side).gradient - Vec3(1, 0, 0)).norm() < 1e-12);
    if (gap > 0) CHECK(three.at(side).value == Approx(gap).margin(1e-12));  // a wall along the lines of sight
    if (gap > 0) CHECK((three.at(side).gradient - Vec3(1, 0, 0)).norm() < 1e-9);
  }
}

TEST_CASE("depth_map_collider: far values are at most the distance") {
  const TriangleMesh m = furrow::tests::sphere(40, 0.2);
  const ExactDistance exact(m);
  const DepthMapCollider collider(m);
  CHECK(collider.reach() >= 0.02);
  CHECK(collider.reach() < 0.02 + collider.texel());
  std::mt19937_64 random(6);
  for (int i = 0; i < 3000; ++i) {
    const Vec3 x = random_vector(random, 0.6);
    const double d = exact.at(x).value;
    if (d < 0.021) continue;
    const SignedDistance said = collider.at(x);
    INFO(x.transpose() << ", distance " << d);
    CHECK(said.value <= d + 1e-12);
    CHECK(said.value >= std::min(d, 0.012));  // what contact asks for is not nearer
    CHECK(said.gradient.dot(x) > 0);
  }
  const SignedDistance away = collider.at({0, 0, 3});
  CHECK(away.value == Approx(2.8));
  CHECK((away.gradient - Vec3(0, 0, 1)).norm() < 1e-12);
  CHECK(std::isnan(collider.at({0, std::numeric_limits<double>::quiet_NaN(), 0}).value));
}

TEST_CASE("depth_map_collider: points that lie in a body come out") {
  const TriangleMesh m = torus(0.3, 0.08);
  const ExactDistance exact(m);
  const DepthMapCollider collider(m);
  std::mt19937_64 random(2);
  std::vector<Vec3> x;
  std::vector<int> all;
  while (x.size() < 500) {
    const Vec3 p = random_vector(random, 0.4);
    if (exact.at(p).value > -1e-3 || exact.at(p).value < -0.02) continue;
    all.push_back(int(x.size()));
    x.push_back(p);
  }
  const PushOutReport report = push_out(x, all, collider, 0.003);
  CHECK(report.moved == 500);
  CHECK(report.still_inside == 0);
  for (const Vec3& p : x) CHECK(exact.at(p).value > 0.0025);
}

TEST_CASE("depth_map_collider: it has the same bits by rebuild, and with any number of threads") {
  TriangleMesh m = torus(0.3, 0.08);
  DepthMapCollider moved(m, with(DepthMaps::six, 200));
  TriangleMesh other = m;
  for (Vec3& x : other.vertices) x = Vec3(1.3 * x[0], x[1] + x[0] * x[0], 0.8 * x[2] + 0.1 * x[1]);
  DepthMapOptions threaded = with(DepthMaps::six, 200);
  threaded.threads = 4;
  const DepthMapCollider built(other, threaded);
  CHECK_FALSE(same_bits(moved, built, 0.4));
  moved.rebuild(other.vertices);
  CHECK(same_bits(moved, built, 0.4));
  moved.rebuild(m.vertices);
  CHECK(same_bits(moved, DepthMapCollider(m, with(DepthMaps::six, 200)), 0.4));
}

TEST_CASE("depth_map_collider: another up and front are a turn of the body") {
  const TriangleMesh m = torus(0.3, 0.08);
  const auto turned = [](const Vec3& x) { return Vec3(x[2], x[0], x[1]); };  // y, up, becomes z
  TriangleMesh other = m;
  for (Vec3& x : other.vertices) x = turned(x);
  DepthMapOptions options;
  options.up = 2;
  options.front = 0;
  const DepthMapCollider a(m), b(other, options);
  std::mt19937_64 random(8);
  for (int i = 0; i < 2000; ++i) {
    const Vec3 x = random_vector(random, 0.4);
    const SignedDistance d = a.at(x), e = b.at(turned(x));
    CHECK(d.value == Approx(e.value).margin(1e-12));
    CHECK((turned(d.gradient) - e.gradient).norm() < 1e-9);
  }
}

TEST_CASE("depth_map_collider: bad options and bodies are refused, and a refused rebuild changes nothing") {
  const TriangleMesh m = furrow::tests::sphere(8, 0.2);
  const auto refuse = [&](const char* name, auto change) {
    DepthMapOptions options;
    change(options);
    CHECK_THROWS_WITH(DepthMapCollider(m, options), Catch::Contains(name));
    CHECK_THROWS_AS(DepthMapCollider(m, options), std::invalid_argument);
  };
  refuse("size = 15", [](auto& o) { o.size = 15; });
  refuse("size = 4097", [](auto& o) { o.size = 4097; });
  refuse("up = 3", [](auto& o) { o.up = 3; });
  refuse("front = -1", [](auto& o) { o.front = -1; });
  refuse("front = 1", [](auto& o) { o.front = 1; });
  refuse("threads = 0", [](auto& o) { o.threads = 0; });
  CHECK_THROWS_AS(DepthMapCollider(TriangleMesh{}), std::invalid_argument);

  DepthMapCollider collider(m), untouched(m);
  std::vector<Vec3> x = m.vertices;
  x.pop_back();
  CHECK_THROWS_WITH(collider.rebuild(x), Catch::Contains("vertices instead of"));
  x.push_back({0, std::numeric_limits<double>::infinity(), 0});
  CHECK_THROWS_WITH(collider.rebuild(x), Catch::Contains("is not finite"));
  CHECK_THROWS_AS(collider.rebuild(std::vector<Vec3>(m.vertices.size(), Vec3(1, 2, 3))),
                  std::invalid_argument);
  CHECK(same_bits(collider, untouched, 0.3));
}
