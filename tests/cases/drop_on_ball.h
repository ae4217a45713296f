// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "physics/contact/contact.h"
#include "tests/cases/swing.h"

namespace furrow::cases {

/// A level hexagon of springs (half diagonal 0.25 m, 0.15 kg/m^2) whose centre lies over the top of a ball of
/// radius 0.2 m around the origin; it falls 1 cm and drapes. Gravity 9.81 m/s^2 along -y.
struct DropOptions {
  int rings = 10;                ///< of edges from the centre to a corner; >= 1
  double stiffness = 200;        ///< of each spring [N/m]
  double jitter = 0;             ///< interior vertices move by up to so many edges in x and z; in [0, 0.3]
  double friction = 0.3;         ///< [-]
  double spring_damping = 0.02;  ///< share of critical [-]
  double seconds = 0.3;          ///< [s]
};
struct Drop {
  Swing fall;
  physics::ContactOptions contact;
};
inline constexpr double ball_radius = 0.2;  // [m]
Drop drop_on_ball(const DropOptions& options = {});

struct DropRun {
  SwingRun end;
  double deepest = 0;       ///< of any vertex after any step, below the ball's surface over its radius [-]
  double largest_rise = 0;  ///< of the total energy in one step, over m g R [-]
  double gain = 0;          ///< of the total energy over its least before, over m g R [-]
  double off_axis = 0;      ///< of the centre of mass at the end, over R [-]
};
/// On one thread. Energy: kinetic, of all elements and of gravity, after each step.
DropRun run(const Drop& drop, const physics::StepperOptions& options, double dt);

}  // namespace furrow::cases
