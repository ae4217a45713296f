// SPDX-License-Identifier: MIT
#pragma once
#include <exception>
#include <memory>

#include "physics/motion/motion.h"
#include "physics/motion/simulate.h"

namespace furrow::physics {

/// An integrator at work on one motion, which must outlive it. It keeps room and symbolic work from step to
/// step, but nothing that a step's result depends on beside its memory(): a new stepper that recalls it goes
/// on with the same bits.
class Stepper {
 public:
  virtual ~Stepper() = default;
  /// One step of dt seconds. Throws std::invalid_argument, nothing changed, if dt is not > 0; Cancelled, with
  /// positions and velocities as they were, if it was cancelled on the way (cancel_scope.h), and StepBlocked.
  virtual void step(double dt) = 0;
  /// What a later stepper on the same cloth needs to go on with the same bits, by particle; taken up before
  /// the first step.
  virtual StepMemory memory() const { return {}; }
  virtual void recall(const StepMemory&) {}
  /// Contact of the cloth with itself as it is now.
  virtual SelfContactState self_contact() const { return {}; }
};

/// Thrown by a step for which there is no room: what is led would pull the cloth through itself.
struct StepBlocked : std::exception {
  explicit StepBlocked(const Vec3& where) : at(where) {}
  const char* what() const noexcept override { return "a step has no room between layers of cloth"; }
  Vec3 at;  ///< where [m]
};

struct StepperOptions {
  Integrator integrator = Integrator::leapfrog;
  XpbdOptions xpbd = {};
  ImplicitOptions implicit = {};
  SelfContactOptions self = {};
};

/// Throws std::invalid_argument if an option of that integrator is out of its range.
std::unique_ptr<Stepper> make_stepper(Motion& motion, const StepperOptions& options);

}  // namespace furrow::physics
