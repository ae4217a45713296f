// SPDX-License-Identifier: MIT
#pragma once
#include "physics/body/moving_body.h"
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
  struct Frame {
    Mat3 rotation;
    Vec3 translation;
    Vec3 to_body(const Vec3& x) const { return rotation.transpose() * (x - translation); }
    Vec3 to_world(const Vec3& x) const { return rotation * x + translation; }
  };
  Frame frame_at(double time) const;

  const RigidMotion& motion_;
  Frame from_, to_;
};

}  // namespace furrow::physics
