// SPDX-License-Identifier: MIT
#pragma once
#include "physics/base/thread_pool.h"
#include "physics/packed/packed_cloth.h"

namespace furrow::physics {

/// Viscous damping along springs (and dashpots of PackedCloth, by damping_k) over a fixed time, one spring
/// after the other. Of each spring the relative velocity along it decays exactly, by exp(-gamma t), gamma = 2
/// zeta sqrt(k m) / m with the reduced mass m = 1/(1/m_a + 1/m_b) (zeta = 1: critical for the two ends
/// alone). Each such update keeps momentum and angular momentum and never adds energy. A forward sweep before
/// the kick and the reversed sweep after the last kick of a step are adjoint to each other, so a symmetric
/// step stays symmetric and of order two; damping that enters as a force at the old velocity would drop the
/// step to order one.
class DampingSweep {
 public:
  DampingSweep() = default;
  /// zeta: share of critical [-], >= 0; seconds: the time of one sweep (half a step).
  DampingSweep(const PackedCloth& packed, double zeta, double seconds);

  /// Order of the sweep: blocks in their groups (blocks are independent: one thread each), then the rest.
  void forward(PackedCloth& packed, ThreadPool& pool) const;
  /// The exact reverse of the order of `forward`.
  void reverse(PackedCloth& packed, ThreadPool& pool) const;

 private:
  std::vector<double> decay_a_, decay_b_;  // impulse per relative velocity along the spring, over each mass
};

}  // namespace furrow::physics
