// SPDX-License-Identifier: MIT
#pragma once
#include <cstdint>
#include <functional>
#include <optional>

#include "physics/motion/integrator.h"
#include "physics/motion/simulate_report.h"
#include "physics/motion/simulate_state.h"
#include "physics/motion/world.h"

namespace furrow::physics {

enum class StepRule {
  limited,  ///< dt never exceeds the stability limit; a larger `dt` is refused
  forced    ///< `dt` is used as it is
};

struct SimulateOptions {
  double seconds = 2;             ///< the end, counted from the state's time 0 [s]; >= 0
  std::optional<double> stop_at;  ///< pause after the first step that reaches this time; the plan stays [s]
  /// Step [s]; > 0; none: dt_factor times the stability limit, or of what is stable at any step the default.
  std::optional<double> dt;
  double dt_factor = 0.9;  ///< [-]; in (0, 1]
  double dt_max = 0.005;   ///< longest step chosen without `dt` [s]; > 0
  StepRule step_rule = StepRule::limited;
  int limit_steps = 2000;        ///< steps after which the limit is estimated anew; >= 1
  double limit_strain = 0.02;    ///< and sooner when the largest strain grew by this [-]; > 0
  Vec3 gravity{0, -9.81, 0};     ///< [m/s^2]
  double air_drag = 2;           ///< [1/s]; >= 0
  double spring_damping = 0.02;  ///< share of critical of each spring [-]; >= 0
  double friction = 0.3;         ///< Coulomb coefficient between cloth and body [-]; >= 0
  double contact_gap = 0.003;    ///< distance at which cloth rests on the body [m]; > 0
  double recovery_speed = 0.1;   ///< how fast vertices that start too deep are taken out [m/s]; > 0
  Integrator integrator = Integrator::leapfrog;
  BackwardEulerOptions backward_euler;
  XpbdOptions xpbd;
  int threads = 1;            ///< >= 1; the result is the same for any number
  int observe_steps = 100;    ///< steps between two calls of the observer; >= 1
  double speed_limit = 1000;  ///< a faster particle means that the motion diverged [m/s]; > 0
};

struct SimulateProgress {
  double time;  ///< [s]
  std::int64_t step;
  double dt;              ///< of the last step [s]
  double kinetic_energy;  ///< [J]
};
/// Called every observe_steps steps and at the end; the cloth holds the state of that time. false: stop here.
using Observer = std::function<bool(const SimulateProgress&)>;

/// Moves the cloth to the time options.seconds under springs, gravity, air, damping and contact. Steps have
/// equal length between two estimates of the limit, and the end is hit exactly. A state that is not finite or
/// faster than speed_limit ends the run with Outcome::diverged and is left as it is (checked every 16 steps).
/// Same input, same bits, for any number of threads.
///
/// Without `state` a call begins at time 0. With it a call continues from the state's time, and does nothing
/// if that is options.seconds already; see SimulateState. If the end or the longest step is not the state's,
/// the rest is divided anew; other options may change at a stop, too.
/// Throws std::invalid_argument, cloth and state untouched, if an option is out of its range, dt is above the
/// limit under StepRule::limited, the cloth's arrays are broken, or world or state do not fit the cloth.
SimulateReport simulate(Cloth& cloth, const World& world, const SimulateOptions& options,
                        SimulateState* state = nullptr, const Observer& observer = {});

/// With a body at rest, or none, and nothing else around.
SimulateReport simulate(Cloth& cloth, const Collider* collider, const SimulateOptions& options,
                        const Observer& observer = {});

}  // namespace furrow::physics
