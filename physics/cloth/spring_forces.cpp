// SPDX-License-Identifier: MIT
#include "physics/cloth/spring_forces.h"

#include <cmath>

#include "physics/base/require.h"

namespace furrow::physics {
void check(const Spring& s, std::size_t n) {
  if (s.a < 0 || s.b < 0 || std::size_t(s.a) >= n || std::size_t(s.b) >= n)
    refuse("spring", "(", s.a, ", ", s.b, ") of ", n, " particles");
  if (s.a == s.b) refuse("spring", "joins particle ", s.a, " with itself");
  if (!(s.rest_length > 0) || !std::isfinite(s.rest_length))
    refuse("spring", "(", s.a, ", ", s.b, "): rest length ", s.rest_length, " is not > 0");
  if (!(s.stiffness >= 0) || !std::isfinite(s.stiffness))
    refuse("spring", "(", s.a, ", ", s.b, "): stiffness ", s.stiffness, " is not >= 0");
}

double energy(std::span<const Vec3> x, const Spring& s) {
  const double stretch = (x[s.b] - x[s.a]).norm() - s.rest_length;
  return 0.5 * s.stiffness * stretch * stretch;
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

void add_spring_stiffness_product(std::span<const Vec3> x, std::span<const Spring> springs,
                                  std::span<const Vec3> u, Stiffness stiffness, std::span<Vec3> product) {
  if (u.size() != x.size() || product.size() != x.size())
    refuse("add_spring_stiffness_product", x.size(), " positions, but arrays of ", u.size(), " and ",
           product.size());
  for (const Spring& s : springs) check(s, x.size());
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

}  // namespace furrow::physics
