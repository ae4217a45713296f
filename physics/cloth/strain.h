// SPDX-License-Identifier: MIT
#pragma once
#include <span>

#include "physics/cloth/cloth.h"

namespace furrow::physics {

/// |l - L| / L over springs; all 0 without springs.
struct StrainStatistics {
  double max = 0, p99 = 0, mean = 0;  ///< [-]; p99: 99 % of the springs are strained at most so much
};
StrainStatistics strain_statistics(std::span<const Vec3> x, std::span<const Spring> springs);
/// Of structural springs and tension; without any of the membrane's edges, an inner one counting once a
/// triangle.
StrainStatistics strain_statistics(const Cloth& cloth);

/// Sum of 1/2 m v^2 [J] over the particles that are not pinned.
double kinetic_energy(const Particles& particles);

}  // namespace furrow::physics
