// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>

#include "physics/body/depth_map_collider.h"
#include "physics/body/exact_distance.h"
#include "physics/motion/simulate.h"
#include "tests/physics/body/test_bodies.h"
#include "tests/physics/cloth/test_cloths.h"

using namespace furrow::physics;
using namespace furrow::tests;

TEST_CASE("depth_map_collider: cloth that falls on a ball of depth maps lies at the gap, nothing inside",
          "[long]") {
  const TriangleMesh ball = sphere_mesh(0.1, 64, 32);
  const ExactDistance exact(ball);
  DepthMapOptions maps;
  maps.maps = GENERATE(DepthMaps::front_back_top, DepthMaps::six);
  const DepthMapCollider collider(ball, maps);
  Cloth cloth = sheet(17, 17, 0.02, 0.1, 3);
  Vec3 centre = Vec3::Zero();
  for (const Vec3& x : cloth.particles.x) centre += x / double(cloth.particles.size());
  for (Vec3& x : cloth.particles.x) x = Vec3(x.x() - centre.x(), 0.11, centre.y() - x.y());
  World world;
  world.collider = &collider;
  SimulateOptions options;
  options.seconds = 0.4;
  options.friction = 0.6;
  options.observe_steps = 50;
  double deepest = 0;
  const SimulateReport report = simulate(cloth, world, options, nullptr, [&](const SimulateProgress&) {
    deepest = std::max(deepest, penetration(exact, cloth.particles.x).deepest);
    return true;
  });
  CHECK(report.outcome == Outcome::finished);
  CHECK(report.contacts > 10);
  CHECK(deepest == 0);
  double nearest = 1;
  for (const Vec3& x : cloth.particles.x) nearest = std::min(nearest, exact.at(x).value);
  CHECK(nearest > 0.002);
  CHECK(nearest < 0.0031);
}
