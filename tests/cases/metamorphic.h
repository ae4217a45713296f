// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <cstdint>

#include "physics/body/collider.h"
#include "physics/motion/simulate.h"

namespace furrow::cases {

/// A cloth that is let go and comes to rest, and changes of it that must not move where it rests.
struct RestCase {
  physics::Cloth cloth;              ///< as it is let go
  physics::SimulateOptions options;  ///< integrator, gravity, damping ...; seconds: given up after them
  double size = 0;                   ///< to compare ways with [m]
  double still = 1e-6;               ///< at rest: no particle moves farther within 1/4 s [size]
  const physics::Collider* body = nullptr;
  // How it was changed:
  physics::Mat3 rotation = physics::Mat3::Identity();
  std::vector<int> place;        ///< of each particle, its new index; empty: its own
  double metre = 1, second = 1;  ///< in the case's own units
};

/// A rotation about an axis that lies askew, by 2 rad.
physics::Mat3 askew();
/// The order of n things shuffled: place[i] is where i goes. The same seed gives the same order.
std::vector<int> shuffled(int n, std::uint64_t seed);

/// Cloth and gravity turned. The first three throw std::invalid_argument if there is a body, which the caller
/// must change itself.
RestCase rotated(RestCase c, const physics::Mat3& rotation = askew());
/// Particles, springs, triangles and hinges in another order.
RestCase permuted(RestCase c, std::uint64_t seed = 1);
/// Everything in millimetres, grams and milliseconds.
RestCase in_small_units(RestCase c);
RestCase with_half_step(RestCase c);
/// Tenfold air drag and spring damping.
RestCase with_tenfold_damping(RestCase c);

struct Rest {
  std::vector<physics::Vec3> x;  ///< in the original frame, order and unit [m]
  bool at_rest = false;          ///< else: diverged, or its time was over
  double residual = 0;           ///< see residual_force() [-]
  int contacts = 0;              ///< particles at the body
  double seconds = 0;            ///< simulated [s]
  double cpu_seconds = 0;        ///< [s]
  double dt = 0;                 ///< of the last step [s]
};
/// Simulates until it is at rest, or its time is over.
Rest come_to_rest(const RestCase& c);

/// The largest distance of a particle's two places [m].
double farthest(const std::vector<physics::Vec3>& x, const std::vector<physics::Vec3>& y);

}  // namespace furrow::cases
