// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "physics/contact/push_out.h"
#include "physics/motion/world.h"
#include "physics/rest/certificate.h"
#include "physics/rest/prestress.h"

namespace furrow::bridge {

struct KeptShape {
  physics::PrestressReport rest;
  physics::Certificate certificate;
  double turned = 0;              ///< about its pins into balance [rad]
  physics::PushOutReport pushed;  ///< of particles nearer to the body than the gap
};

/// Gives a pinned cloth the rest state with which it is in equilibrium as it lies, on the body where that
/// stands (physics/rest/prestress.h), and tells whether that equilibrium is stable
/// (physics/rest/certificate.h). Without a body, what hangs on a line of pins or on one pin is first turned
/// about it into balance, if by no more than largest_turn [rad] (physics/rest/rigid_imbalance.h); what is
/// nearer to a body than the gap is first brought out to it. Otherwise positions stay; velocities and
/// stiffnesses always do. Wind is no load here. Cost: a factorisation or two. Throws std::invalid_argument,
/// nothing changed, as require_still() and prestress() do.
KeptShape keep_shape(physics::Cloth& cloth, const physics::World& world,
                     const physics::PrestressOptions& options, double largest_turn = 0);

/// Throws std::invalid_argument if body or pins move.
void require_still(const physics::World& world);

}  // namespace furrow::bridge
