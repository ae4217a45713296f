// SPDX-License-Identifier: MIT
#pragma once
#include "physics/body/moving_body.h"
#include "physics/contact/contact.h"

namespace furrow::physics {

/// Contact with a body that changes its shape. A particle's start is carried along with the surface next to
/// it, then BodyContact's rules apply with the body as it is at the end of the step; so they see the motion
/// relative to the surface. The particle's velocity is what it moved in the world.
///
/// What is remembered of the field stays true for as long as no vertex may have moved too far: the levels in
/// memory() count from where the body was when travel() was 0, as if it came nearer at the bound of 2 m
/// a metre ever since.
class AnimatedContact : public BodyContact {
 public:
  /// The body must outlive this object. Throws std::invalid_argument as BodyContact does.
  AnimatedContact(AnimatedBody& body, const ContactOptions& options, int particles, double travel = 0);
  void begin_step(double from, double to) override;
  void respond(int i, const Vec3& before, double dt, Vec3& x, Vec3& v, ContactCounts& counts) override;
  /// Bound on how far the body's vertices have moved since the beginning [m].
  double travel() const { return travel_; }

 private:
  AnimatedBody& body_;
  double travel_;
};

}  // namespace furrow::physics
