// SPDX-License-Identifier: MIT
#pragma once
#include "physics/rest/settle.h"

namespace furrow::physics {

/// A rest of cloth whose bending has friction.
struct GivenWay {
  SettleReport settle;  ///< of the last rest; iterations, factorisations and followers of all together
  int rounds = 0;       ///< rests after each of which hinges or plates gave way
  double slip = 0;      ///< of one in the last of them [rad]
};

/// Adds friction to the bending of a cloth, hinges and plates, that bears `moment` a metre of crease [N]
/// before it gives way, and finds rest again while anything gives way by more than 2 mrad, 60 times at most.
/// The friction stands at the end of the cloth's hinges and energies. The rest depends on the way: here, all
/// of the weight at once from where the cloth lies. Throws std::invalid_argument as add_hinge_friction(),
/// add_plate_friction() and settle() do.
GivenWay settle_giving_way(Cloth& cloth, const Collider* body, double moment, const SettleOptions& options,
                           const SettleObserver& observer = {});

}  // namespace furrow::physics
