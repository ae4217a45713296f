// SPDX-License-Identifier: MIT
#pragma once
#include "physics/contact/contact.h"
#include "physics/motion/simulate.h"

namespace furrow::physics {

/// Fills all but outcome, dt and its limits from the state, and from cloth and world as they are at its time
/// (an animated body prepared for it). Cost: one force evaluation, two queries a particle.
void measure(const Cloth& cloth, const World& world, const SimulateState& state, const Vec3& gravity,
             const ContactOptions& contact, SimulateReport& report);

}  // namespace furrow::physics
