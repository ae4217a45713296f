// SPDX-License-Identifier: MIT
#include "physics/rest/give_way.h"

#include <algorithm>

#include "physics/rest/hinge_friction.h"
#include "physics/rest/plate_friction.h"

namespace furrow::physics {
namespace {

constexpr double least_slip = 2e-3;  // rad
constexpr int most_rounds = 60;

}  // namespace

GivenWay settle_giving_way(Cloth& cloth, const Collider* body, double moment, const SettleOptions& options,
                           const SettleObserver& observer) {
  const HingeFriction hinges = add_hinge_friction(cloth, {.moment = moment});
  const PlateFriction plates = add_plate_friction(cloth, {.moment = moment});
  GivenWay rest;
  do {
    const SettleReport before = rest.settle;
    rest.settle = settle(cloth, body, options, observer);
    const bool converged = rest.settle.converged;
    rest.settle.iterations += before.iterations;
    rest.settle.factorisations += before.factorisations;
    rest.settle.followers += before.followers;
    if (!converged) break;
    rest.slip = std::max(update_friction(cloth, hinges), update_friction(cloth, plates));
  } while (rest.slip > least_slip && ++rest.rounds < most_rounds);
  return rest;
}

}  // namespace furrow::physics
