// SPDX-License-Identifier: GPL-3.0-or-later
#include <Eigen/Dense>
#include <catch2/catch.hpp>

#include "physics/pins.h"
#include "physics/simulate.h"
#include "tests/physics/test_cloths.h"

using namespace furrow::physics;
using namespace furrow::tests;

namespace {

constexpr double gravity = 9.81;

/// A chain of 32 uneven springs between two pins 1 m apart; k after S1.7, masses lumped half and half.
Cloth irregular_chain() {
  std::vector<double> r;
  double sum = 0;
  for (int i = 1; i <= 32; ++i) sum += r.emplace_back(1 + 0.7 * std::sin(5.0 * i));
  Cloth cloth;
  for (int i = 0; i <= 32; ++i) add_particle(cloth, {i / 32.0, -0.02 * i * (32 - i) / 10, 0}, 1);
  std::fill(cloth.particles.mass.begin(), cloth.particles.mass.end(), 0);
  const double average = 1.5 / 32, k_std = 147.15 / average;
  for (int i = 0; i < 32; ++i) {
    const double rest = r[i] * 1.5 / sum;
    cloth.structural.push_back({i, i + 1, rest, k_std * rest / average});
    for (const int end : {i, i + 1}) cloth.particles.mass[end] += 0.981 / gravity * rest / 2;
  }
  for (int i = 0; i <= 32; ++i) cloth.particles.inv_mass[i] = 1 / cloth.particles.mass[i];
  pin(cloth.particles, std::vector<int>{0, 32});
  return cloth;
}

/// Nodes of the chain in balance, if its first spring carries the force (H, V): the rest follows node by
/// node.
std::vector<Eigen::Vector2d> shoot(const Cloth& chain, double H, double V) {
  std::vector<Eigen::Vector2d> nodes{{0, 0}};
  for (std::size_t i = 0; i < chain.structural.size(); ++i) {
    const Spring& s = chain.structural[i];
    const double tension = std::hypot(H, V), l = s.rest_length + tension / s.stiffness;
    nodes.push_back(nodes.back() + l / tension * Eigen::Vector2d(H, -V));
    V -= chain.particles.mass[i + 1] * gravity;
  }
  return nodes;
}

std::vector<Eigen::Vector2d> exact_chain(const Cloth& chain) {
  Eigen::Vector2d force(0.3, 0.7);
  const Eigen::Vector2d goal(1, 0);
  for (int round = 0; round < 50; ++round) {
    const Eigen::Vector2d miss = shoot(chain, force[0], force[1]).back() - goal;
    if (miss.norm() < 1e-12) return shoot(chain, force[0], force[1]);
    const double h = 1e-6;
    Eigen::Matrix2d jacobian;
    jacobian.col(0) =
        (shoot(chain, force[0] + h, force[1]).back() - shoot(chain, force[0] - h, force[1]).back()) / (2 * h);
    jacobian.col(1) =
        (shoot(chain, force[0], force[1] + h).back() - shoot(chain, force[0], force[1] - h).back()) / (2 * h);
    Eigen::Vector2d move = -jacobian.inverse() * miss;
    force += std::min(1.0, 0.2 / move.norm()) * move;
  }
  FAIL("the shooting did not converge");
  return {};
}

}  // namespace

TEST_CASE("a hanging chain of uneven springs comes to rest at the exact solution") {
  Cloth chain = irregular_chain();
  const std::vector<Eigen::Vector2d> exact = exact_chain(chain);
  SimulateOptions options;
  options.seconds = 8;
  options.air_drag = 6;
  options.spring_damping = 0.2;
  const SimulateReport report = simulate(chain, nullptr, options);
  CHECK(report.outcome == Outcome::finished);
  double worst = 0, lowest = 0;
  for (std::size_t i = 0; i < exact.size(); ++i) {
    const Vec3& x = chain.particles.x[i];
    worst = std::max(worst, (x - Vec3(exact[i].x(), exact[i].y(), 0)).norm());
    lowest = std::min(lowest, x.y());
  }
  CHECK(lowest < -0.45);
  CHECK(worst < 1e-5);
  CHECK(report.residual_force < 1e-4);
}
