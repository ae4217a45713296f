// SPDX-License-Identifier: MIT
#include "physics/contact/rigid_contact.h"

#include <cmath>

namespace furrow::physics {

RigidContact::RigidContact(const Collider& body, const RigidMotion& motion, const ContactOptions& options,
                           int particles)
    : BodyContact(body, options, particles), motion_(motion) {
  check(motion);
  asks_in_world_ = false;
  begin_step(0, 0);
}

void RigidContact::begin_step(double from, double to) {
  from_ = BodyPlace(pose(motion_, from));
  to_ = BodyPlace(pose(motion_, to));
}

void RigidContact::respond(int i, const Vec3& before, double dt, Vec3& x, Vec3& v, ContactCounts& counts) {
  if (!before.allFinite() || !x.allFinite()) return;
  const Vec3 proposed = to_.to_body(x);
  if (is_clear(i, proposed)) return;
  ContactMemory& known = memory_[std::size_t(i)];
  const Vec3 start = from_.to_body(before);
  if (std::isnan(known.level)) {
    known = {start, collider_.at(start).value};
    ++counts.queries;
    if (is_clear(i, proposed)) return;
  }
  Vec3 y = proposed;
  const std::optional<Vec3> arrived = resolve(collider_, known, start, dt, y, counts);
  if (y != proposed) x = to_.to_world(y);
  if (arrived) v = (to_.to_world(*arrived) - before) / dt;
}

}  // namespace furrow::physics
