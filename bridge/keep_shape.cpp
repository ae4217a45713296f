// SPDX-License-Identifier: GPL-3.0-or-later
#include "bridge/keep_shape.h"

#include <optional>
#include <stdexcept>

#include "physics/body/posed_collider.h"
#include "physics/rest/rigid_imbalance.h"

namespace furrow::bridge {

void require_still(const physics::World& world) {
  if (world.animated || !world.pins.empty() || !physics::at_rest(world.body_motion))
    throw std::invalid_argument("body or pins move; a shape is kept on what stands still");
}

physics::PushOutReport bring_out(physics::Cloth& cloth, const physics::World& world, double gap) {
  if (!world.collider) return {};
  const physics::PosedCollider body(*world.collider, physics::pose(world.body_motion, 0));
  std::vector<int> free;
  for (std::size_t i = 0; i < cloth.particles.size(); ++i)
    if (cloth.particles.inv_mass[i] > 0) free.push_back(int(i));
  return physics::push_out(cloth.particles.x, free, body, gap);
}

KeptShape keep_shape(physics::Cloth& cloth, const physics::World& world,
                     const physics::PrestressOptions& options, double largest_turn) {
  require_still(world);
  KeptShape shape;
  shape.pushed = bring_out(cloth, world, options.gap);
  physics::Cloth balanced = cloth;
  const double turn = world.collider ? 0 : physics::balance_rigidly(balanced, options.gravity);
  if (turn > 0 && turn <= largest_turn) cloth = std::move(balanced), shape.turned = turn;
  std::optional<physics::PosedCollider> posed;
  if (world.collider) posed.emplace(*world.collider, physics::pose(world.body_motion, 0));
  const physics::Collider* body = posed ? &*posed : nullptr;
  shape.rest = physics::prestress(cloth, options, body);
  shape.certificate = physics::certify(cloth, {options.gravity, options.friction, options.gap}, body);
  return shape;
}

}  // namespace furrow::bridge
