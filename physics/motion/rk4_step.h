// SPDX-License-Identifier: MIT
#pragma once
#include "physics/motion/stepper.h"

namespace furrow::physics {

/// The classical Runge-Kutta method of order four. Drag and the springs' damping are forces here, so that the
/// order holds with them; wind and what compensates are taken at the times of the stages, led pins go
/// straight during a step. Contact acts once, after the whole step: the step is carried out as a move with
/// the stages' mean velocity, which contact corrects, and a kick by the rest; so what rests on a body keeps
/// g dt/2 as with leapfrog, and with contact the order is one.
/// Stable without damping for dt < 2 sqrt(2) / omega_max, with it for dt < 2.785 / (rate of the fastest
/// decay), too (see fastest_decay()). An oscillator's amplitude shrinks by sqrt(1 - z^6/72 + z^8/576),
/// z = omega dt. Keeps momentum if nothing is pinned, touched or dragged. Four force evaluations.
/// Source: Hairer, Norsett, Wanner, Solving Ordinary Differential Equations I, II.1.
class Rk4 : public Stepper {
 public:
  explicit Rk4(Motion& motion);
  void step(double dt) override;

 private:
  void stage(double time, double weight, double ahead);
  void move(double dt);

  Motion& motion_;
  std::vector<double> dashpots_;
  std::vector<Vec4> x_, v_;  // at the beginning of the step
  std::vector<Vec4> sum_v_, sum_a_, air_;
};

}  // namespace furrow::physics
