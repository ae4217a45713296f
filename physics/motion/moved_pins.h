// SPDX-License-Identifier: MIT
#pragma once
#include <span>
#include <vector>

#include "physics/motion/simulate.h"
#include "physics/packed/packed_cloth.h"

namespace furrow::physics {

/// Where the particles of all groups are in the frames of their motions, one group after the other, if they
/// are at x at that time [m]. Throws std::invalid_argument if a motion is broken, or a particle is out of
/// range, not pinned or named twice.
std::vector<Vec3> homes_of(std::span<const MovedPins> pins, const Particles& particles, double time);

/// Leads the pins of a packed cloth.
class PinLeader {
 public:
  /// homes as of homes_of(); both are kept by reference.
  PinLeader(std::span<const MovedPins> pins, std::span<const Vec3> homes) : pins_(pins), homes_(homes) {}
  /// Finds the particles in a packed cloth, before all below.
  void attach(const PackedCloth& packed);
  std::span<const int> places() const { return places_; }
  /// Sets the velocities that lead to the places at the time `to` in dt.
  void begin_step(PackedCloth& packed, double to, double dt);
  /// Those of the motions themselves at a time [s], mean over that while before and after, one a place [m/s].
  std::vector<Vec3> velocities(double time, double over) const;
  /// Puts the pins there.
  void arrive(PackedCloth& packed) const;
  /// As if no step had begun: unpack() does nothing.
  void forget_step() { targets_.clear(); }
  /// Positions and velocities after a step; physics::unpack() leaves pinned particles out.
  void unpack(const PackedCloth& packed, Particles& particles) const;

 private:
  std::span<const MovedPins> pins_;
  std::span<const Vec3> homes_;
  std::vector<int> places_;    // in the packed cloth
  std::vector<Vec3> targets_;  // [m]
};

}  // namespace furrow::physics
