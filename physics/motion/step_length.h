// SPDX-License-Identifier: MIT
#pragma once
#include "physics/motion/simulate.h"

namespace furrow::physics {

/// The plan of a simulation's steps in its state: re-estimates the stability limit as the cloth strains and
/// divides the time left into equal steps.
class StepLength {
 public:
  /// Plans, or takes up the state's plan; all three must outlive this object. Throws std::invalid_argument if
  /// options.dt is above the limit under StepRule::limited.
  StepLength(const Cloth& cloth, const SimulateOptions& options, SimulateState& state);
  /// Whether the strain is looked at after state.step steps; then the cloth must hold its positions.
  bool due() const;
  /// After a step, which state.step counts already.
  void advance();
  /// The limit of the integrator [s] where leapfrog's without damping is `leapfrog`; infinity if it has none.
  double limit(double leapfrog) const;

 private:
  void estimate();
  void divide(double rest);
  double longest() const;

  const Cloth& cloth_;
  const SimulateOptions& options_;
  SimulateState& state_;
  double fastest_decay_ = 0;  // of damping and drag, if they bound the step [1/s]
};

}  // namespace furrow::physics
