// SPDX-License-Identifier: MIT
#pragma once
#include <span>

#include "physics/cloth/cloth.h"

namespace furrow::physics {

struct ElasticBandOptions {
  double length = 0.9;    ///< of the band at rest over that of the loop as the cloth lies [-]; in (0, 2]
  double stiffness = 50;  ///< force in it at a strain of 1 [N]; >= 0
};

/// Sews an elastic band to a closed loop of particles, as a waistband or a cuff has: a spring between each
/// two that follow each other, stiffness / L_i. They become bending springs, sorted in; where there is one
/// already both act. Throws std::invalid_argument, nothing changed, for an option out of its range, fewer
/// than three particles, one out of range, or two neighbours at the same place. Cost: a sort.
void add_elastic_band(Cloth& cloth, std::span<const int> loop, const ElasticBandOptions& options = {});

}  // namespace furrow::physics
