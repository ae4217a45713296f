// SPDX-License-Identifier: MIT
#include "physics/rest/limited_memory.h"

#include <catch2/catch.hpp>

#include "tests/physics/cloth/test_cloths.h"

using namespace furrow::physics;
using namespace furrow::tests;

namespace {

using Vectors = std::vector<Vec3>;

double dot(const Vectors& a, const Vectors& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += a[i].dot(b[i]);
  return sum;
}

Vectors random(std::size_t n, Noise& noise) {
  Vectors v(n);
  for (Vec3& x : v) x = noise.vector();
  return v;
}

/// A chain of springs of stiffness 1 N/m between walls, and one of 3 N/m between each particle and its place.
Vectors times_hessian(const Vectors& x) {
  Vectors y(x.size());
  for (std::size_t i = 0; i < x.size(); ++i) {
    y[i] = 5 * x[i];
    if (i > 0) y[i] -= x[i - 1];
    if (i + 1 < x.size()) y[i] -= x[i + 1];
  }
  return y;
}

void halve(std::span<Vec3> f) {
  for (Vec3& v : f) v *= 0.5;
}

}  // namespace

TEST_CASE("limited_memory: the last step is what its forces ask for, the base where nothing is known") {
  Noise noise(3);
  LimitedMemory memory(halve, 4);
  const Vectors f = random(6, noise);
  Vectors x = f;
  memory.apply(x);
  for (std::size_t i = 0; i < f.size(); ++i) CHECK(x[i] == 0.5 * f[i]);
  for (int k = 0; k < 7; ++k) {
    const Vectors s = random(6, noise), y = times_hessian(s);
    REQUIRE(memory.add(s, y));
    x = y;
    memory.apply(x);
    for (std::size_t i = 0; i < s.size(); ++i) CHECK((x[i] - s[i]).norm() < 1e-13);
  }
  x = f;
  memory.apply(x);
  CHECK(dot(x, f) > 0);  // positive definite
  memory.clear();
  x = f;
  memory.apply(x);
  for (std::size_t i = 0; i < f.size(); ++i) CHECK(x[i] == 0.5 * f[i]);
}

TEST_CASE("limited_memory: with exact steps it solves a chain in as many as it has different stiffnesses") {
  Noise noise(4);
  const Vectors load = random(4, noise);
  LimitedMemory memory(halve, 12);
  Vectors x(load.size(), Vec3::Zero()), rest = load;
  int steps = 0;
  for (; dot(rest, rest) > 1e-20 && steps < 12; ++steps) {
    Vectors move = rest;
    memory.apply(move);
    const Vectors pull = times_hessian(move);
    const double share = dot(rest, move) / dot(move, pull);
    Vectors s = move, y = pull;
    for (std::size_t i = 0; i < x.size(); ++i) {
      s[i] *= share, y[i] *= share;
      x[i] += s[i], rest[i] -= y[i];
    }
    memory.add(s, y);
  }
  CHECK(steps <= 4);
}

TEST_CASE("limited_memory: a step along which forces grow is left out, other lengths are refused") {
  LimitedMemory memory(halve, 2);
  const Vectors s = {Vec3::UnitX(), Vec3::UnitY()};
  CHECK_FALSE(memory.add(s, {-Vec3::UnitX(), Vec3::Zero()}));
  CHECK_FALSE(memory.add(s, {Vec3::Zero(), Vec3::Zero()}));
  Vectors x = s;
  memory.apply(x);
  CHECK(x[0] == 0.5 * s[0]);
  CHECK(memory.add(s, s));
  CHECK_THROWS_WITH(memory.add(s, {Vec3::UnitX()}), Catch::Contains("2 particles"));
  CHECK_THROWS_WITH(memory.add({Vec3::UnitX()}, {Vec3::UnitX()}), Catch::Contains("1 particles"));
  CHECK_THROWS_WITH(LimitedMemory(halve, -1), Catch::Contains("pairs = -1"));
  CHECK_FALSE(LimitedMemory(halve, 0).add(s, s));
}
