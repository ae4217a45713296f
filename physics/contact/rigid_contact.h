// SPDX-License-Identifier: MIT
#pragma once
#include "physics/body/posed_collider.h"
#include "physics/contact/contact.h"

namespace furrow::physics {

/// Contact with a rigid body that moves: all that BodyContact does happens in the body's frame, to a particle
/// that is there at its start as the body was then, and at its end as the body is then. So the field never
/// changes, what is remembered of it stays true, and friction, tunnelling and depth see the motion relative
/// to the body's surface. The particle's velocity is what it moved in the world.
class RigidContact : public BodyContact {
 public:
  /// body: in its own frame. Both must outlive this object. Throws std::invalid_argument as BodyContact and
  /// check(motion) do.
  RigidContact(const Collider& body, const RigidMotion& motion, const ContactOptions& options, int particles);
  void begin_step(double from, double to) override;
  void respond(int i, const Vec3& before, double dt, Vec3& x, Vec3& v, ContactCounts& counts) override;

 private:
  const RigidMotion& motion_;
  BodyPlace from_, to_;  ///< at the step's ends
};

}  // namespace furrow::physics
