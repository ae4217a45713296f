// SPDX-License-Identifier: GPL-3.0-or-later
#include "physics/pairs/pair_bounds.h"

#include <catch2/catch.hpp>

#include "tests/physics/pairs/random_pairs.h"

using namespace furrow::physics;
using namespace furrow::tests;

namespace {

/// Of four pairs, as lanes.
Separation separation_of(bool edges, const std::array<Corners, 4>& x, const Vec3& origin) {
  std::array<Float4, 16> points;
  std::array<const Float4*, 16> at;
  for (std::size_t i = 0; i < 16; ++i) {
    points[i] = float_point(x[i / 4][i % 4], origin);
    at[i] = &points[i];
  }
  const FourPairs pairs = four_pairs(at);
  return edges ? edge_edge_separation(pairs) : vertex_triangle_separation(pairs);
}

/// Of a bound, by rounding: a little, and as the plane is turned by it the more the nearer the two are [m].
double lost(double distance) { return 1e-5 + 1e-7 / distance; }

}  // namespace

TEST_CASE("pair_bounds: never more than the distance, and next to it, on 200,000 random pairs", "[long]") {
  int loose = 0, close = 0;
  for (std::uint64_t seed = 1; seed <= 50000; ++seed)
    for (const bool edges : {false, true}) {
      std::array<Corners, 4> x;
      for (std::uint64_t lane = 0; lane < 4; ++lane) x[lane] = random_corners(4 * seed + lane);
      const Separation found = separation_of(edges, x, Vec3(0.1, -0.3, 0.2));
      for (std::size_t lane = 0; lane < 4; ++lane) {
        const double distance = std::sqrt(distance_of(edges, x[lane]).squared());
        const double bound = double(found.bound(lane));
        if (bound > distance) FAIL_CHECK("seed " << seed << ": " << bound << " of " << distance);
        loose += bound < distance - lost(distance);
        close += distance < 1e-3;
        const auto beyond = [&](double reach) { return found.beyond(splat(float(reach)))[lane] != 0; };
        if (beyond(1.0001 * distance + 1e-6)) FAIL_CHECK("seed " << seed << ": beyond its distance");
        loose += distance > 1e-3 && !beyond(0.99 * distance - lost(distance));
      }
    }
  CHECK(loose < 200);
  CHECK(close > 10000);
}

TEST_CASE("pair_bounds: parallel edges, edges and triangles without length, and coincident ones") {
  const Vec3 a(0.1, 0.2, 0.3), u(0.05, 0.01, 0.02), up(0, 0, 0.01);
  const std::array<Corners, 4> edges = {Corners{a, a + u, a + up, a + u + up},
                                        Corners{a, a, a + up, a + up + u}, Corners{a, a, a + up, a + up},
                                        Corners{a, a + u, a, a + u}};
  const Separation e = separation_of(true, edges, Vec3::Zero());
  for (std::size_t lane = 0; lane < 4; ++lane) {
    const double distance = std::sqrt(distance_of(true, edges[lane]).squared());
    CHECK(double(e.bound(lane)) <= distance);
    CHECK(double(e.bound(lane)) > distance - 1e-5);
  }
  const std::array<Corners, 4> faces = {Corners{a, a + up, a + up, a + up}, Corners{a, a + up, a + u, a + up},
                                        Corners{a, a, a + u, a + up}, Corners{a, a, a, a}};
  const Separation f = separation_of(false, faces, Vec3::Zero());
  for (std::size_t lane = 0; lane < 4; ++lane) {
    const double distance = std::sqrt(distance_of(false, faces[lane]).squared());
    CHECK(double(f.bound(lane)) <= distance);
    CHECK(double(f.bound(lane)) > distance - 1e-5);
  }
}
