// SPDX-License-Identifier: MIT
#include "physics/contact/animated_contact.h"

#include <cmath>

namespace furrow::physics {
namespace {

/// The body next to a place where the way of its surface is known.
struct Nearby : Collider {
  const AnimatedBody& body;
  AnimatedBody::Beside surface;
  Nearby(const AnimatedBody& b, const Vec3& x) : body(b), surface(b.beside(x)) {}
  SignedDistance at(const Vec3& x) const override { return body.at(x, surface); }
};

}  // namespace

AnimatedContact::AnimatedContact(AnimatedBody& body, const ContactOptions& options, int particles,
                                 double travel)
    : BodyContact(body, options, particles), body_(body), travel_(travel) {}

void AnimatedContact::begin_step(double from, double to) {
  body_.prepare(from, to);
  travel_ += body_.travel();
  clear_level_ = options_.gap + lipschitz * travel_;
}

void AnimatedContact::respond(int i, const Vec3& before, double dt, Vec3& x, Vec3& v, ContactCounts& counts) {
  if (!before.allFinite() || !x.allFinite() || is_clear(i, x)) return;
  const Nearby body(body_, x);
  const Vec3 start = before + body_.share() * body.surface.way;
  ContactMemory& known = memory_[std::size_t(i)];
  if (before == known.x && !std::isnan(known.level)) {
    // What the last step ended with; the surface has carried it along.
    known = {start, known.level - lipschitz * (travel_ - body_.travel())};
  } else {
    known = {start, body.at(start).value};
    ++counts.queries;
  }
  if (const auto arrived = resolve(body, known, start, dt, x, counts)) v = (*arrived - before) / dt;
  known.level += lipschitz * travel_;
}

}  // namespace furrow::physics
