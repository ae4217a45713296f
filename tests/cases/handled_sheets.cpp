// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/cases/handled_sheets.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <numbers>
#include <random>

#include "physics/cloth/element_forces.h"
#include "physics/cloth/pins.h"
#include "physics/pairs/edge_face_crossings.h"
#include "tests/cases/flat_meshes.h"

namespace furrow::cases {
namespace {

using namespace physics;

constexpr double thickness = 1e-3, turning = 2;  // m, s

Cloth cotton(double width, double height, int columns, std::uint64_t seed) {
  Cloth cloth =
      triangular_sheet(width, height, columns, equilateral_rows(width, height, columns), 0.12, 0.2, seed);
  cloth.structural.clear();
  add_flat_membrane(cloth, 450);
  add_flat_hinges(cloth, 1e-5);
  return cloth;
}

/// Two boxes, one over the other, of which the upper one comes down; in frames close enough that one box
/// never is where the other one is in the next.
BodyFrames press(double from, double to, double until) {
  TriangleMesh mesh;
  for (const double low : {-0.1, 0.0})
    for (int i = 0; i < 8; ++i)
      mesh.vertices.push_back({i & 1 ? 0.3 : -0.3, low + (i & 2 ? 0.1 : 0), i & 4 ? 0.3 : -0.3});
  constexpr int quads[6][4] = {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4},
                               {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};
  for (const int first : {0, 8})
    for (const auto& q : quads) {
      mesh.triangles.push_back({first + q[0], first + q[1], first + q[2]});
      mesh.triangles.push_back({first + q[0], first + q[2], first + q[3]});
    }
  constexpr int steps = 20;
  BodyFrames frames{mesh.triangles, {}, {}};
  for (int i = 0; i <= steps; ++i) frames.times.push_back(until * i / steps);
  frames.vertices = [=](int i) {
    std::vector<Vec3> x = mesh.vertices;
    for (std::size_t k = 8; k < x.size(); ++k) x[k].y() += from + (to - from) * i / steps;
    return x;
  };
  return frames;
}

SimulateOptions options_of(const Handling& how) {
  SimulateOptions o;
  o.integrator = how.integrator;
  o.seconds = how.seconds;
  o.self.on = how.self_contact;
  o.self.thickness = thickness;
  o.self.friction = how.friction;
  o.dt_factor = how.dt_factor;
  o.observe_steps = how.look;
  return o;
}

Handled run(Cloth& cloth, const World& world, const SimulateOptions& options) {
  Handled found;
  found.vertices = int(cloth.particles.size());
  const PairMesh mesh = pair_mesh(cloth, thickness);
  found.report = simulate(cloth, world, options, nullptr, [&](const SimulateProgress&) {
    ++found.looked;
    found.most_crossings =
        std::max(found.most_crossings, int(edge_face_crossings(mesh, cloth.particles.x).size()));
    return true;
  });
  return found;
}

}  // namespace

Handled crush(std::uint64_t seed, const Handling& how) {
  Cloth cloth = cotton(0.3, 0.3, how.columns, seed);
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> noise(-0.5, 0.5);
  for (Vec3& x : cloth.particles.x) x = Vec3(x.x() - 0.15, x.y() + 0.01, 4e-3 * noise(random));
  for (Vec3& v : cloth.particles.v) v.z() = 0.5 * noise(random);
  AnimatedBody body(press(0.33, 0.02, 1.0));
  World world;
  world.animated = &body;
  return run(cloth, world, options_of(how));
}

Handled wring(double turns, const Handling& how) {
  constexpr double width = 0.4, length = 0.8, shorter = 0.3;
  Cloth cloth = cotton(width, length, how.columns, 1);
  std::vector<int> ends[2], all;
  for (std::size_t i = 0; i < cloth.particles.size(); ++i) {
    Vec3& x = cloth.particles.x[i];
    x.x() -= width / 2;
    for (const int end : {0, 1})
      if (std::abs(x.y() - end * length) < 1e-9) ends[end].push_back(int(i)), all.push_back(int(i));
  }
  pin(cloth.particles, all);
  World world;
  for (const int end : {0, 1}) {
    const double sign = end == 0 ? 1 : -1;
    RigidMotion motion;
    motion.pivot = Vec3(0, end * length, 0);
    motion.keyframes = {
        {0}, {turning, Vec3(0, sign * shorter / 2, 0), Vec3(0, sign * std::numbers::pi * turns, 0)}};
    world.pins.push_back({ends[end], motion});
  }
  SimulateOptions options = options_of(how);
  options.gravity = Vec3::Zero();
  Handled found = run(cloth, world, options);
  std::vector<Vec3> force(cloth.particles.size(), Vec3::Zero());
  ThreadPool pool(1);
  ElementForces elements(cloth);
  elements(cloth.particles.x, force, pool);
  for (const int end : {0, 1})
    for (const int i : ends[end])
      found.torques[end] += cloth.particles.x[std::size_t(i)].cross(force[std::size_t(i)]).y();
  return found;
}

}  // namespace furrow::cases
