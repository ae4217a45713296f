// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "physics/cloth/cloth.h"

namespace furrow::tests {

using physics::Cloth;
using physics::Spring;
using physics::Vec3;

/// Numbers in [-1, 1), the same in every run.
class Noise {
 public:
  explicit Noise(std::uint64_t seed) : state_(seed * 2 + 1) {}
  double operator()() {
    state_ = state_ * 6364136223846793005u + 1442695040888963407u;
    return double(state_ >> 11) * 0x1p-52 - 1;
  }
  Vec3 vector() {
    const double x = (*this)(), y = (*this)(), z = (*this)();
    return {x, y, z};
  }

 private:
  std::uint64_t state_;
};

inline void add_particle(Cloth& cloth, const Vec3& x, double mass, const Vec3& v = Vec3::Zero()) {
  cloth.particles.x.push_back(x);
  cloth.particles.v.push_back(v);
  cloth.particles.mass.push_back(mass);
  cloth.particles.inv_mass.push_back(mass > 0 ? 1 / mass : 0);
}

/// Springs of a mesh after method S1.1, at rest as it lies, stiffness k_std r / r_avg (S1.7), mass density *
/// area / 3.
inline void add_springs_and_masses(Cloth& cloth, double k_structural, double k_bending, double density) {
  std::map<std::pair<int, int>, std::vector<int>> opposite;
  const auto& x = cloth.particles.x;
  for (const auto& t : cloth.triangles) {
    for (int c = 0; c < 3; ++c) {
      opposite[std::minmax(t[c], t[(c + 1) % 3])].push_back(t[(c + 2) % 3]);
      cloth.particles.mass[t[c]] += density / 6 * (x[t[1]] - x[t[0]]).cross(x[t[2]] - x[t[0]]).norm();
    }
  }
  std::map<std::pair<int, int>, double> bending;
  const auto length = [&](const std::pair<int, int>& p) { return (x[p.second] - x[p.first]).norm(); };
  for (const auto& [edge, apexes] : opposite) {
    cloth.structural.push_back({edge.first, edge.second, length(edge), 0});
    if (apexes.size() != 2) continue;
    const std::pair<int, int> pair = std::minmax(apexes[0], apexes[1]);
    if (!opposite.count(pair)) bending[pair] = length(pair);
  }
  for (const auto& [pair, r] : bending) cloth.bending.push_back({pair.first, pair.second, r, 0});
  for (auto [springs, k] : {std::pair{&cloth.structural, k_structural}, {&cloth.bending, k_bending}}) {
    double sum = 0;
    for (const Spring& s : *springs) sum += s.rest_length;
    for (Spring& s : *springs) s.stiffness = k * s.rest_length * double(springs->size()) / sum;
  }
  for (std::size_t i = 0; i < x.size(); ++i) cloth.particles.inv_mass[i] = 1 / cloth.particles.mass[i];
}

/// columns x rows particles on the triangle lattice of the given edge, in the plane z = 0, hanging down from
/// y = 0; jitter: each moved by up to jitter * edge in the plane.
inline Cloth sheet(int columns, int rows, double edge, double jitter = 0, std::uint64_t seed = 1,
                   double k_structural = 1000, double k_bending = 10) {
  Cloth cloth;
  Noise noise(seed);
  for (int r = 0; r < rows; ++r) {
    for (int c = 0; c < columns; ++c) {
      const double dx = jitter * edge * noise(), dy = jitter * edge * noise();
      add_particle(cloth, {edge * (c + 0.5 * (r % 2)) + dx, -edge * std::sqrt(0.75) * r + dy, 0}, 0);
    }
  }
  for (int r = 0; r + 1 < rows; ++r) {
    for (int c = 0; c + 1 < columns; ++c) {
      const int a = r * columns + c, b = a + 1, d = a + columns, e = d + 1;
      if (r % 2) {
        cloth.triangles.push_back({a, d, e});
        cloth.triangles.push_back({a, e, b});
      } else {
        cloth.triangles.push_back({a, d, b});
        cloth.triangles.push_back({b, d, e});
      }
    }
  }
  add_springs_and_masses(cloth, k_structural, k_bending, 0.15);
  return cloth;
}

/// One mass on one spring from the origin, which is pinned.
inline Cloth pendulum(double mass, double stiffness, double rest_length, const Vec3& x,
                      const Vec3& v = Vec3::Zero()) {
  Cloth cloth;
  add_particle(cloth, Vec3::Zero(), 1);
  cloth.particles.inv_mass[0] = 0;
  add_particle(cloth, x, mass, v);
  cloth.structural.push_back({0, 1, rest_length, stiffness});
  return cloth;
}

}  // namespace furrow::tests
