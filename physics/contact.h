// SPDX-License-Identifier: MIT
#pragma once
#include <cstdint>
#include <span>

#include "physics/collider.h"

namespace furrow::physics {

struct ContactOptions {
  double friction = 0.3;        ///< Coulomb coefficient, static = kinetic [-]; >= 0
  double gap = 0.003;           ///< epsilon: cloth is held at this distance from the body [m]; > 0
  double recovery_speed = 0.1;  ///< how fast depth that was there before is taken out [m/s]; > 0
};

struct ContactCounts {
  std::int64_t queries = 0;      ///< of the collider
  std::int64_t truncations = 0;  ///< moves cut short so that they could not pass through the body
  ContactCounts& operator+=(const ContactCounts& other);
};

/// Contact of particles with a body at rest, after Fuhrmann, Sobottka, Gross 2003 (method S1.10): a particle
/// that a step brings closer than the gap is moved back along the field's gradient, then Coulomb friction
/// shortens its tangential motion, then its velocity is what it moved; no bounce.
///  - Depth already there before the step is no motion: only what the step adds is pushed back with friction
///  and
///    velocity. The old depth is taken out at recovery_speed without touching the velocity, so a garment that
///    starts inside the body is not shot out of it.
///  - Up to 3 moves of at most 2 cm bring back a deep particle. A depth below 0.1 mm, which is all that
///    a resting particle sinks in a step, takes one move of depth/|g|, so that friction sees the whole normal
///    motion of small steps, too.
///  - A move longer than max(psi, 0) + gap/2 is made in pieces of that length and ends where one enters the
///  body;
///    from inside, a move is at most gap/2 (tunnelling).
///  - The field is taken to change by at most 2 m a metre; a particle that has not moved far enough since its
///  last
///    query to be in contact is not asked for.
class BodyContact {
 public:
  /// The collider must outlive this object. Throws std::invalid_argument if an option is out of its range.
  BodyContact(const Collider& collider, const ContactOptions& options, int particles);

  /// Whether particle i at x cannot be in contact, for all that is known; then respond() would do nothing.
  bool is_clear(int i, const Vec3& x) const {
    const Known& known = known_[std::size_t(i)];
    const double clearance = known.level - options_.gap;
    return clearance > 0 && lipschitz * lipschitz * (x - known.x).squaredNorm() < clearance * clearance;
  }
  /// Particle i moved from `before` to x in dt with velocity v: corrects x and v. Particles are independent
  /// of each other, so different i may be handled by several threads. Positions that are not finite are left
  /// alone.
  void respond(int i, const Vec3& before, double dt, Vec3& x, Vec3& v, ContactCounts& counts);

 private:
  SignedDistance query(const Vec3& x, ContactCounts& counts) const;
  Vec3 advance(const Vec3& before, double level, const Vec3& x, ContactCounts& counts) const;
  double push_out(double target, SignedDistance& field, Vec3& x, ContactCounts& counts) const;
  void remember(int i, const Vec3& x, double level);

  static constexpr double lipschitz = 2;  // bound on the change of the field a metre
  const Collider& collider_;
  ContactOptions options_;
  struct Known {
    Vec3 x;        ///< where the field was asked last
    double level;  ///< its value there [m]; NaN = never asked
  };
  std::vector<Known> known_;
};

/// Particles within `gap` (plus 1e-5 m) of the body.
int count_contacts(std::span<const Vec3> x, const Collider& collider, double gap);

}  // namespace furrow::physics
