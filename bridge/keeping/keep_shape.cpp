// SPDX-License-Identifier: GPL-3.0-or-later
#include <stdexcept>

#include "bridge/draping/standing_body.h"
#include "bridge/keeping/keep.h"
#include "physics/cloth/check_cloth.h"
#include "physics/rest/rigid_imbalance.h"

namespace furrow::bridge {

void require_still(const physics::World& world) {
  if (world.animated || !world.pins.empty() || !physics::at_rest(world.body_motion))
    throw std::invalid_argument("body or pins move; a shape is kept on what stands still");
}

physics::Certificate certify_kept(const physics::Cloth& cloth, const physics::World& world,
                                  const physics::PrestressOptions& options, bool count) {
  const std::optional<physics::PosedCollider> standing = standing_body(world);
  return physics::certify(cloth,
                          {.gravity = options.gravity,
                           .friction = options.friction,
                           .gap = options.gap,
                           .work = options.work,
                           .count = count},
                          standing ? &*standing : nullptr);
}

KeptShape keep_shape(physics::Cloth& cloth, const physics::World& world,
                     const physics::PrestressOptions& options, double largest_turn, bool count) {
  require_still(world);
  physics::check_cloth(cloth, "keep_shape");
  const std::optional<physics::PosedCollider> standing = standing_body(world);
  const physics::Collider* body = standing ? &*standing : nullptr;
  KeptShape shape;
  physics::Cloth kept = cloth;
  if (body) shape.pushed = physics::bring_out(kept.particles, *body, options.gap);
  physics::Cloth balanced = kept;
  const double turn = body ? 0 : physics::balance_rigidly(balanced, options.gravity);
  if (turn > 0 && turn <= largest_turn) kept = std::move(balanced), shape.turned = turn;
  shape.rest = physics::prestress(kept, options, body);
  shape.certificate = certify_kept(kept, world, options, count);
  cloth = std::move(kept);
  return shape;
}

}  // namespace furrow::bridge
