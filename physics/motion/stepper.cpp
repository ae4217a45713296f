// SPDX-License-Identifier: MIT
#include "physics/motion/stepper.h"

#include <stdexcept>

#include "physics/motion/euler_step.h"
#include "physics/motion/implicit_step.h"
#include "physics/motion/leapfrog_step.h"
#include "physics/motion/rk4_step.h"
#include "physics/motion/xpbd.h"

namespace furrow::physics {
namespace {

/// A step that keeps nothing.
class PlainStepper : public Stepper {
 public:
  using Step = void (*)(Motion&, double);
  PlainStepper(Motion& motion, Step plain_step) : motion_(motion), step_(plain_step) {}
  void step(double dt) override { step_(motion_, dt); }

 private:
  Motion& motion_;
  Step step_;
};

}  // namespace

std::unique_ptr<Stepper> make_stepper(Motion& motion, const StepperOptions& options) {
  switch (options.integrator) {
    case Integrator::leapfrog:
      return std::make_unique<PlainStepper>(motion, leapfrog_step);
    case Integrator::explicit_euler:
      return std::make_unique<PlainStepper>(motion, euler_step);
    case Integrator::rk4:
      return std::make_unique<Rk4>(motion);
    case Integrator::xpbd:
      return std::make_unique<Xpbd>(motion, options.xpbd);
    case Integrator::implicit:
    case Integrator::tr_bdf2:
      return std::make_unique<ImplicitStep>(motion, options.integrator, options.implicit, options.self);
  }
  throw std::invalid_argument("make_stepper: unknown integrator");
}

}  // namespace furrow::physics
