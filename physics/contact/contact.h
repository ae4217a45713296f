// SPDX-License-Identifier: MIT
#pragma once
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "physics/body/collider.h"

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

/// Contact of particles with a body, after Fuhrmann, Sobottka, Gross 2003 (method S1.10): a particle that
/// a step brings closer than the gap is moved back along the field's gradient, then Coulomb friction shortens
/// its tangential motion relative to the body, then its velocity is what it moved; no bounce. This class: a
/// body at rest. RigidContact and AnimatedContact: bodies that move.
///
/// \details
///  - Depth already there before the step is no motion: only what the step adds is pushed back with friction
///    and velocity. The old depth is taken out at recovery_speed without touching the velocity.
///  - Up to 3 moves of at most 2 cm bring back a deep particle. A depth below 0.1 mm, which is all that
///    a resting particle sinks in a step, takes one move of depth/|g|, so that friction sees the whole normal
///    motion of small steps, too.
///  - A move (relative to the body) longer than max(psi, 0) + gap/2 is made in pieces of that length and ends
///    where one enters the body; from inside, a move is at most gap/2 (tunnelling).
///  - The field is taken to change by at most 2 m a metre; a particle that has not moved far enough since its
///    last query is not asked for.
class BodyContact {
 public:
  /// The collider must outlive this object. Throws std::invalid_argument if an option is out of its range.
  BodyContact(const Collider& collider, const ContactOptions& options, int particles);
  virtual ~BodyContact() = default;
  /// The body's motion in the next step [s].
  virtual void begin_step(double /*from*/, double /*to*/) {}
  /// Whether particle i at x (in the body's frame) cannot be in contact; then respond() does nothing.
  bool is_clear(int i, const Vec3& x) const {
    const ContactMemory& known = memory_[std::size_t(i)];
    const double clearance = known.level - clear_level_;
    return clearance > 0 && lipschitz * lipschitz * (x - known.x).squaredNorm() < clearance * clearance;
  }
  /// Whether is_clear() takes positions in the world.
  bool asks_in_world() const { return asks_in_world_; }
  /// Particle i moved from `before` to x in dt with velocity v: corrects x and v. Different i may be handled
  /// by several threads. Positions that are not finite are left alone.
  virtual void respond(int i, const Vec3& before, double dt, Vec3& x, Vec3& v, ContactCounts& counts);

  std::vector<ContactMemory>& memory() { return memory_; }  ///< one a particle

 protected:
  /// Corrects x in the body's frame. If it was pushed: where it came to before the recovery from old depth.
  std::optional<Vec3> resolve(const Collider& body, ContactMemory& known, const Vec3& before, double dt,
                              Vec3& x, ContactCounts& counts) const;

  static constexpr double lipschitz = 2;  // bound on the change of the field a metre
  const Collider& collider_;
  ContactOptions options_;
  double clear_level_;  ///< [m]
  bool asks_in_world_ = true;
  std::vector<ContactMemory> memory_;
};

/// Particles within `gap` (plus 1e-5 m) of the body.
int count_contacts(std::span<const Vec3> x, const Collider& collider, double gap);

}  // namespace furrow::physics
