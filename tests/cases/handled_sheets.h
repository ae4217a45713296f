// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <cstdint>

#include "physics/motion/simulate.h"

namespace furrow::cases {

/// What a sheet of cotton comes to in rough hands.
struct Handled {
  int vertices = 0;
  int most_crossings = 0;  ///< edges through faces at any step that was looked at
  int looked = 0;          ///< steps
  double torques[2] = {};  ///< of the towel's ends about its length, at the end [N m]
  physics::SimulateReport report;
};

struct Handling {
  physics::Integrator integrator = physics::Integrator::leapfrog;
  bool self_contact = true;
  int columns = 20;        ///< of the sheet's mesh
  int look = 50;           ///< at every so many steps
  double seconds = 1.2;    ///< [s]
  double dt_factor = 0.9;  ///< SimulateOptions::dt_factor
  double friction = 0.3;   ///< of cloth on cloth [-]
};

/// A sheet of 0.3 m that stands on a floor, crumpled by noise of the seed, and a lid that presses it flat
/// (case V12 of cloth on cloth).
Handled crush(std::uint64_t seed, const Handling& how);

/// A towel of 0.4 by 0.8 m whose ends are turned against each other within 2 s and then held, and come
/// nearer to each other meanwhile (case V11).
Handled wring(double turns, const Handling& how);

}  // namespace furrow::cases
