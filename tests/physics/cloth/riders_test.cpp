// SPDX-License-Identifier: MIT
#include "physics/cloth/riders.h"

#include <Eigen/Geometry>
#include <catch2/catch.hpp>

#include "physics/cloth/join_cloths.h"
#include "physics/rest/settle.h"

using namespace furrow::physics;

namespace {

/// A triangle, and beside it three particles that ride on it.
Cloth triangle_with_riders() {
  Cloth cloth;
  Particles& p = cloth.particles;
  p.x = {{0, 0, 0}, {0.1, 0, 0}, {0, 0.1, 0}, {0.02, 0.03, 0.004}, {0.3, -0.1, 0.02}, {0.05, 0.05, 0}};
  p.v.assign(6, Vec3::Zero());
  p.mass = {1e-3, 1e-3, 1e-3, 0, 0, 0};
  p.inv_mass = {1e3, 1e3, 1e3, 0, 0, 0};
  cloth.triangles = {{0, 1, 2}};
  cloth.membrane = {{{0, 1, 2}, {std::sqrt(0.02), 0.1, 0.1}, 100, 100}};
  for (const int i : {3, 4, 5})
    cloth.riders.push_back(rider_at(p.x[i], i, {0, 1, 2}, {p.x[0], p.x[1], p.x[2]}, {0.5, 0.2, 0.3}));
  return cloth;
}

}  // namespace

TEST_CASE("riders: stay where they are until their triangle moves, and go with it as a rigid body") {
  const Cloth before = triangle_with_riders();
  Cloth cloth = before;
  place_riders(cloth);
  for (std::size_t i = 0; i < 6; ++i) CHECK((cloth.particles.x[i] - before.particles.x[i]).norm() < 1e-15);
  const Eigen::Isometry3d move =
      Eigen::Translation3d(0.3, -1, 2) * Eigen::AngleAxisd(2, Vec3(1, 2, -0.5).normalized());
  for (std::size_t i = 0; i < 3; ++i) {
    cloth.particles.x[i] = move * before.particles.x[i];
    cloth.particles.v[i] = {0, 0, double(i)};
  }
  place_riders(cloth);
  for (std::size_t i = 3; i < 6; ++i) {
    CHECK((cloth.particles.x[i] - move * before.particles.x[i]).norm() < 1e-14);
    CHECK(cloth.particles.v[i].z() == Approx(0.2 + 2 * 0.3));
  }
}

TEST_CASE("riders: a triangle without area leaves them where they are") {
  Cloth cloth = triangle_with_riders();
  cloth.particles.x[2] = cloth.particles.x[1];
  const Vec3 was = cloth.particles.x[4];
  place_riders(cloth);
  CHECK(cloth.particles.x[4] == was);
}

TEST_CASE("riders: cloths that are joined keep theirs") {
  const Cloth one = triangle_with_riders();
  const std::vector<Cloth> two{one, one};
  Cloth both = join_cloths(two);
  REQUIRE(both.riders.size() == 6);
  for (std::size_t i = 6; i < 9; ++i) both.particles.x[i] += Vec3(0, 1, 0);
  place_riders(both);
  for (std::size_t i = 0; i < 6; ++i) {
    CHECK((both.particles.x[i] - one.particles.x[i]).norm() < 1e-15);
    CHECK((both.particles.x[i + 6] - one.particles.x[i] - Vec3(0, 1, 0)).norm() < 1e-14);
  }
}

TEST_CASE("riders: a search for rest brings them along") {
  Cloth cloth = triangle_with_riders();
  cloth.particles.inv_mass[0] = 0;
  SettleOptions options;
  options.max_iterations = 50;
  settle(cloth, nullptr, options);
  CHECK((cloth.particles.x[1] - Vec3(0.1, 0, 0)).norm() > 0.01);  // it hangs
  const std::array<Vec3, 3> now{cloth.particles.x[0], cloth.particles.x[1], cloth.particles.x[2]};
  const Rider again = rider_at(cloth.particles.x[4], 4, {0, 1, 2}, now, cloth.riders[1].weights);
  CHECK((again.offset - cloth.riders[1].offset).norm() < 1e-12);
}
