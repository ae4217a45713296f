// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <Eigen/Dense>
#include <numeric>
#include <stdexcept>

#include "physics/cloth/pins.h"
#include "tests/physics/cloth/test_cloths.h"

namespace furrow::tests {

inline constexpr double chain_gravity = 9.81;                                  // [m/s^2]
inline constexpr double chain_span = 1, chain_length = 1.5;                    // [m]
inline constexpr double chain_weight = 0.981, chain_axial_stiffness = 147.15;  // [N/m], EA [N]

/// Springs between two pins on one level; rest lengths vary by +- unevenness of their mean; k after S1.7, EA
/// for the mean one; masses lumped half and half.
inline Cloth hanging_chain(int springs = 32, double unevenness = 0.7) {
  std::vector<double> r;
  for (int i = 1; i <= springs; ++i) r.push_back(1 + unevenness * std::sin(5.0 * i));
  const double sum = std::accumulate(r.begin(), r.end(), 0.0), average = chain_length / springs;
  Cloth cloth;
  for (int i = 0; i <= springs; ++i) {
    const double t = double(i) / springs;
    add_particle(cloth, {chain_span * t, -2 * t * (1 - t), 0}, 1);
  }
  std::fill(cloth.particles.mass.begin(), cloth.particles.mass.end(), 0);
  for (int i = 0; i < springs; ++i) {
    const double rest = r[i] * chain_length / sum;
    cloth.structural.push_back({i, i + 1, rest, chain_axial_stiffness / average * rest / average});
    for (const int end : {i, i + 1}) cloth.particles.mass[end] += chain_weight / chain_gravity * rest / 2;
  }
  for (int i = 0; i <= springs; ++i) cloth.particles.inv_mass[i] = 1 / cloth.particles.mass[i];
  physics::pin(cloth.particles, std::vector<int>{0, springs});
  return cloth;
}

/// Nodes of the chain in balance, if its first spring carries the force (H, V): the rest follows node by
/// node.
inline std::vector<Eigen::Vector2d> shoot(const Cloth& chain, double H, double V) {
  std::vector<Eigen::Vector2d> nodes{{0, 0}};
  for (std::size_t i = 0; i < chain.structural.size(); ++i) {
    const Spring& s = chain.structural[i];
    const double tension = std::hypot(H, V), l = s.rest_length + tension / s.stiffness;
    nodes.push_back(nodes.back() + l / tension * Eigen::Vector2d(H, -V));
    V -= chain.particles.mass[i + 1] * chain_gravity;
  }
  return nodes;
}

inline std::vector<Eigen::Vector2d> exact_chain(const Cloth& chain) {
  Eigen::Vector2d force(0.3, 0.7);
  for (int round = 0; round < 50; ++round) {
    const auto miss = [&](double H, double V) -> Eigen::Vector2d {
      return shoot(chain, H, V).back() - Eigen::Vector2d(chain_span, 0);
    };
    const Eigen::Vector2d now = miss(force[0], force[1]);
    if (now.norm() < 1e-12) return shoot(chain, force[0], force[1]);
    const double h = 1e-6;
    Eigen::Matrix2d jacobian;
    jacobian.col(0) = (miss(force[0] + h, force[1]) - miss(force[0] - h, force[1])) / (2 * h);
    jacobian.col(1) = (miss(force[0], force[1] + h) - miss(force[0], force[1] - h)) / (2 * h);
    const Eigen::Vector2d move = -jacobian.inverse() * now;
    force += std::min(1.0, 0.2 / move.norm()) * move;
  }
  throw std::runtime_error("the shooting did not converge");
}

}  // namespace furrow::tests
