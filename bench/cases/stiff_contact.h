// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <stdexcept>

#include "physics/collider.h"

namespace furrow::cases {

/// A body that settle() sees its contact with as factor^2 times as stiff (physics/anchored_contact.h), while
/// the surface at `gap` stays where it is: distances from there and gradients are `factor` times as large.
/// The depth at which the push becomes linear is factor times smaller. The larger the factor, the nearer to a
/// contact that bears no depth at all, as leapfrog's is. Not for leapfrog itself.
class StiffContact : public physics::Collider {
 public:
  /// The body must outlive it. gap: that of settle() [m]; factor: > 0 [-].
  StiffContact(const physics::Collider& body, double gap, double factor)
      : body_(body), gap_(gap), factor_(factor) {
    if (!(factor > 0)) throw std::invalid_argument("StiffContact: factor must be > 0");
  }
  physics::SignedDistance at(const physics::Vec3& x) const override {
    const physics::SignedDistance d = body_.at(x);
    return {gap_ + factor_ * (d.value - gap_), factor_ * d.gradient};
  }

 private:
  const physics::Collider& body_;
  double gap_, factor_;
};

}  // namespace furrow::cases
