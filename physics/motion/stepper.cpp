// SPDX-License-Identifier: MIT
#include "physics/motion/stepper.h"

#include <stdexcept>

#include "physics/motion/implicit_step.h"
#include "physics/motion/leapfrog_step.h"
#include "physics/motion/rk4_step.h"
#include "physics/motion/xpbd.h"

namespace furrow::physics {
namespace {

class Leapfrog : public Stepper {
 public:
  explicit Leapfrog(Motion& motion) : motion_(motion) {}
  void step(double dt) override { leapfrog_step(motion_, dt); }

 private:
  Motion& motion_;
};

}  // namespace

std::unique_ptr<Stepper> make_stepper(Motion& motion, const StepperOptions& options) {
  switch (options.integrator) {
    case Integrator::leapfrog:
      return std::make_unique<Leapfrog>(motion);
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
