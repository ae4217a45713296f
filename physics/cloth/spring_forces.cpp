// SPDX-License-Identifier: MIT
#include "physics/cloth/spring_forces.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

namespace furrow::physics {
namespace {

void check(std::span<const Spring> springs, std::size_t n, std::size_t others, const char* function) {
  if (others != n) {
    throw std::invalid_argument(std::string(function) + ": " + std::to_string(n) +
                                " positions, but arrays of " + std::to_string(others));
  }
  for (const Spring& s : springs) {
    if (s.a < 0 || s.b < 0 || std::size_t(s.a) >= n || std::size_t(s.b) >= n) {
      throw std::invalid_argument(std::string(function) + ": spring (" + std::to_string(s.a) + ", " +
                                  std::to_string(s.b) + ") of " + std::to_string(n) + " particles");
    }
  }
}

}  // namespace

double spring_energy(std::span<const Vec3> x, std::span<const Spring> springs) {
  check(springs, x.size(), x.size(), "spring_energy");
  double energy = 0;
  for (const Spring& s : springs) {
    const double stretch = (x[s.b] - x[s.a]).norm() - s.rest_length;
    energy += 0.5 * s.stiffness * stretch * stretch;
  }
  return energy;
}

double add_forces(std::span<const Vec3> x, const Spring& s, std::span<Vec3> force) {
  const Vec3 d = x[s.b] - x[s.a];
  const double l = d.norm(), stretch = l - s.rest_length;
  if (l != 0) {
    const Vec3 f = s.stiffness * (1 - s.rest_length / l) * d;
    force[s.a] += f;
    force[s.b] -= f;
  }
  return 0.5 * s.stiffness * stretch * stretch;
}

void add_spring_forces(std::span<const Vec3> x, std::span<const Spring> springs, std::span<Vec3> force) {
  check(springs, x.size(), force.size(), "add_spring_forces");
  for (const Spring& s : springs) add_forces(x, s, force);
}

void add_spring_stiffness_product(std::span<const Vec3> x, std::span<const Spring> springs,
                                  std::span<const Vec3> u, Stiffness stiffness, std::span<Vec3> product) {
  check(springs, x.size(), u.size(), "add_spring_stiffness_product");
  check({}, x.size(), product.size(), "add_spring_stiffness_product");
  for (const Spring& s : springs) {
    const Vec3 d = x[s.b] - x[s.a];
    const double l2 = d.squaredNorm();
    if (l2 == 0) continue;
    double transverse = s.stiffness * (1 - s.rest_length / std::sqrt(l2));
    if (transverse < 0) transverse *= 1 - stiffness.clamped;
    const Vec3 w = u[s.a] - u[s.b];
    const Vec3 f = transverse * w + ((s.stiffness - transverse) * d.dot(w) / l2) * d;
    product[s.a] += f;
    product[s.b] -= f;
  }
}

void stiffness_blocks(std::span<const Vec3> x, const Spring& s, Stiffness stiffness, Mat3* lower) {
  const Vec3 d = x[s.b] - x[s.a];
  const double l2 = d.squaredNorm();
  Mat3 block = Mat3::Zero();
  if (l2 > 0) {
    double transverse = s.stiffness * (1 - s.rest_length / std::sqrt(l2));
    if (transverse < 0) transverse *= 1 - stiffness.clamped;
    block = ((s.stiffness - transverse) / l2) * d * d.transpose();
    block.diagonal().array() += transverse;
  }
  lower[0] = lower[2] = block;
  lower[1] = -block;
}

void add_spring_stiffness(std::span<const Vec3> x, std::span<const Spring> springs, Stiffness stiffness,
                          const BlockSink& sink) {
  check(springs, x.size(), x.size(), "add_spring_stiffness");
  std::array<Mat3, lower_blocks(2)> lower;
  for (const Spring& s : springs) {
    stiffness_blocks(x, s, stiffness, lower.data());
    hand_out(std::array{s.a, s.b}, lower.data(), sink);
  }
}

}  // namespace furrow::physics
