// SPDX-License-Identifier: GPL-3.0-or-later
#include "physics/body/corner_cones.h"

#include <Eigen/Geometry>
#include <catch2/catch.hpp>
#include <cmath>

#include "tests/physics/body/field_inputs.h"

using namespace furrow::physics;
using furrow::tests::uniform;

namespace {

/// A fan of n triangles around the last vertex; as a soup, each has a last vertex of its own.
TriangleMesh flat_fan(int n, bool soup) {
  TriangleMesh m;
  for (int i = 0; i < n; ++i) {
    const double angle = 2 * 3.14159265358979 * i / n;
    m.vertices.push_back({std::cos(angle), std::sin(angle), 0});
  }
  for (int i = 0; i < (soup ? n : 1); ++i) m.vertices.push_back({0, 0, 0.5});
  for (int i = 0; i < n; ++i) m.triangles.push_back({i, (i + 1) % n, soup ? n + i : n});
  return m;
}

std::array<Vec3, 3> corners_of(const TriangleMesh& m, int t) {
  const auto& [a, b, c] = m.triangles[std::size_t(t)];
  return {m.vertices[std::size_t(a)], m.vertices[std::size_t(b)], m.vertices[std::size_t(c)]};
}

}  // namespace

TEST_CASE("corner_cones: a crowd is a thousand triangles at a place, in a soup, too") {
  for (const bool soup : {false, true}) {
    CHECK(CrowdedCorners(flat_fan(999, soup)).empty());
    const TriangleMesh m = flat_fan(1000, soup);
    const CrowdedCorners crowded(m);
    REQUIRE_FALSE(crowded.empty());
    const auto of = crowded.of(7, corners_of(m, 7)), others = crowded.of(400, corners_of(m, 400));
    REQUIRE(of.size() == 1);
    CHECK(of[0].at.triangle == 7);
    CHECK(of[0].at.corner == 2);
    CHECK(common_corners(of, others).size() == 1);
    CHECK(common_corners(of, {}).empty());
  }
}

TEST_CASE("corner_cones: a cone holds its points and bounds their distance from below") {
  std::mt19937_64 random(1);
  const auto anywhere = [&] {
    return Vec3(uniform(random, -1, 1), uniform(random, -1, 1), uniform(random, -1, 1));
  };
  int behind = 0;
  for (int round = 0; round < 300; ++round) {
    const Vec3 apex = anywhere(), ahead = anywhere();
    std::vector<Vec3> points{apex};
    for (int i = 0; i < 9; ++i) points.push_back(apex + ahead + uniform(random, 0, 0.7) * anywhere());
    CornerCones cones;
    cones.set(2, fit_corner_cone(apex, points), {5, 1});
    const Vec3 x = 1.5 * anywhere();
    Float4 p[3];
    for (int k = 0; k < 3; ++k) p[k] = splat(static_cast<float>(x[k]));
    const ConeDistances found = cone_distances(cones, p, 4e-6f);
    CHECK(found.squared[0] == 0);  // not set: no bound
    CHECK_FALSE(found.behind[0] > 0);
    double nearest = 1e300;
    for (const Vec3& a : points)  // along the triangles' edges from the apex
      for (double s = 0; s <= 1; s += 0.05)
        nearest = std::min(nearest, (apex + s * (a - apex) - x).squaredNorm());
    CHECK(found.squared[2] <= nearest);
    if (found.behind[2] > 0) {
      ++behind;
      CHECK(nearest == Approx((apex - x).squaredNorm()).epsilon(1e-12));
    }
  }
  CHECK(behind > 50);
}

TEST_CASE("corner_cones: points all around have no cone") {
  const std::vector<Vec3> around{{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}};
  CHECK(fit_corner_cone(Vec3::Zero(), around).axis.isZero());
  CHECK(fit_corner_cone(Vec3::Zero(), std::vector<Vec3>{Vec3::Zero()}).axis.isZero());
}
