// SPDX-License-Identifier: MIT
#include "physics/simulate.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <ctime>
#include <limits>
#include <memory>
#include <sstream>
#include <stdexcept>

#include "physics/euler_step.h"
#include "physics/leapfrog_step.h"
#include "physics/residual_force.h"
#include "physics/stable_step.h"

namespace furrow::physics {
namespace {

constexpr int divergence_steps = 16;  // steps between two looks for divergence
constexpr int strain_steps = 200;     // steps between two looks at the strain

template <typename... Parts>
[[noreturn]] void refuse(const Parts&... parts) {
  std::ostringstream text;
  text << "simulate: ";
  (text << ... << parts);
  throw std::invalid_argument(text.str());
}

void require_positive(double value, const char* name) {
  if (!(value > 0) || !std::isfinite(value)) refuse(name, " = ", value, " is not > 0");
}

void check(const SimulateOptions& o) {
  if (!(o.seconds >= 0) || !std::isfinite(o.seconds)) refuse("seconds = ", o.seconds, " is not >= 0");
  if (o.dt) require_positive(*o.dt, "dt");
  if (!(o.dt_factor > 0 && o.dt_factor <= 1)) refuse("dt_factor = ", o.dt_factor, " is not in (0, 1]");
  if (o.step_rule == StepRule::forced && !o.dt) refuse("a forced step needs dt");
  require_positive(o.dt_max, "dt_max");
  require_positive(o.limit_strain, "limit_strain");
  require_positive(o.speed_limit, "speed_limit");
  if (o.limit_steps < 1) refuse("limit_steps = ", o.limit_steps, " is not >= 1");
  if (o.observe_steps < 1) refuse("observe_steps = ", o.observe_steps, " is not >= 1");
}

double cpu_time() {
  std::timespec t{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
  return double(t.tv_sec) + 1e-9 * double(t.tv_nsec);
}

/// The step's length: re-estimates the limit as the cloth strains and divides the time left into equal steps.
class StepLength {
 public:
  StepLength(const Cloth& cloth, const SimulateOptions& options, SimulateReport& report)
      : cloth_(cloth), options_(options), report_(report) {
    report.dt_limit_smallest = std::numeric_limits<double>::infinity();
    estimate();
    if (options.dt && options.step_rule == StepRule::limited && *options.dt > report.dt_limit) {
      refuse("dt = ", *options.dt, " s is above the stability limit of ", report.dt_limit, " s");
    }
    divide(options.seconds);
  }

  double dt() const { return dt_; }
  std::int64_t steps_left() const { return steps_left_; }
  bool due(std::int64_t step) const {
    return step % strain_steps == 0 || step - estimated_at_ >= options_.limit_steps;
  }

  /// After a step; the cloth must hold its state if due(step).
  void advance(std::int64_t step) {
    --steps_left_;
    if (!due(step) || steps_left_ == 0 || options_.step_rule == StepRule::forced) return;
    const double strain = strain_statistics(cloth_.particles.x, cloth_.structural).max;
    if (step - estimated_at_ < options_.limit_steps && !(strain > strain_ + options_.limit_strain)) return;
    if (!std::isfinite(strain)) return;  // diverged: seen elsewhere
    estimate();
    estimated_at_ = step;
    divide(double(steps_left_) * dt_);
  }

 private:
  void estimate() {
    const StepLimit limit = stable_step(cloth_);
    strain_ = strain_statistics(cloth_.particles.x, cloth_.structural).max;
    report_.dt_limit = limit.dt_limit;
    report_.dt_limit_smallest = std::min(report_.dt_limit_smallest, limit.dt_limit);
    ++report_.limit_estimates;
  }

  void divide(double rest) {
    double longest = std::min(options_.dt_factor * report_.dt_limit, options_.dt_max);
    if (options_.dt)
      longest =
          options_.step_rule == StepRule::forced ? *options_.dt : std::min(*options_.dt, report_.dt_limit);
    // A hair above, so that 2 s / 0.1 ms is 20000 steps and not 20001.
    steps_left_ = std::int64_t(std::ceil(rest / longest * (1 - 1e-12)));
    dt_ = steps_left_ > 0 ? rest / double(steps_left_) : 0;
  }

  const Cloth& cloth_;
  const SimulateOptions& options_;
  SimulateReport& report_;
  double strain_ = 0, dt_ = 0;
  std::int64_t steps_left_ = 0, estimated_at_ = 0;
};

bool has_diverged(const PackedCloth& cloth, double speed_limit) {
  const double most = speed_limit * speed_limit;
  for (std::size_t i = 0; i < cloth.v.size(); ++i) {
    const Vec4 &v = cloth.v[i], &x = cloth.x[i];
    if (!(v.x * v.x + v.y * v.y + v.z * v.z <= most) || !std::isfinite(x.x + x.y + x.z)) return true;
  }
  return false;
}

/// The steps, one phase after another; fills steps, time, dt and outcome.
void run(Cloth& cloth, Motion& motion, StepLength& length, const SimulateOptions& options,
         const Observer& observer, SimulateReport& report) {
  const auto step = options.integrator == Integrator::leapfrog ? leapfrog_step : euler_step;
  report.dt = report.dt_smallest = length.dt();
  while (length.steps_left() > 0) {
    report.dt = length.dt();
    report.dt_smallest = std::min(report.dt_smallest, report.dt);
    step(motion, report.dt);
    ++report.steps;
    report.time = length.steps_left() == 1 ? options.seconds : report.time + report.dt;

    const bool last = length.steps_left() == 1,
               observed = observer && (report.steps % options.observe_steps == 0 || last);
    const bool checked = report.steps % divergence_steps == 0 || observed || last;
    if (observed || length.due(report.steps)) unpack(motion.cloth(), cloth.particles);
    if (checked && has_diverged(motion.cloth(), options.speed_limit)) {
      report.outcome = Outcome::diverged;
      return;
    }
    if (observed && !observer({report.time, report.steps, report.dt, kinetic_energy(cloth.particles)}) &&
        !last) {
      report.outcome = Outcome::stopped_by_observer;
      return;
    }
    length.advance(report.steps);
  }
}

void measure(const Cloth& cloth, const Collider* collider, const SimulateOptions& options,
             const WorkCounts& work, SimulateReport& report) {
  report.strain = strain_statistics(cloth.particles.x, cloth.structural);
  report.kinetic_energy = kinetic_energy(cloth.particles);
  report.residual_force =
      residual_force(cloth, options.gravity, collider, options.friction, options.contact_gap);
  if (collider) report.contacts = count_contacts(cloth.particles.x, *collider, options.contact_gap);
  report.force_evaluations = work.force_evaluations;
  report.collider_queries = work.contact.queries;
  report.truncated_moves = work.contact.truncations;
}

}  // namespace

SimulateReport simulate(Cloth& cloth, const Collider* collider, const SimulateOptions& options,
                        const Observer& observer) {
  const auto started = std::chrono::steady_clock::now();
  const double cpu_started = cpu_time();
  check(options);
  ThreadPool pool(options.threads);
  std::unique_ptr<BodyContact> contact;
  if (collider) {
    const ContactOptions contact_options{options.friction, options.contact_gap, options.recovery_speed};
    contact = std::make_unique<BodyContact>(*collider, contact_options, int(cloth.particles.size()));
  }
  Motion motion(cloth, {options.gravity, options.air_drag, options.spring_damping}, pool, contact.get());
  SimulateReport report;
  StepLength length(cloth, options, report);
  run(cloth, motion, length, options, observer, report);
  unpack(motion.cloth(), cloth.particles);
  measure(cloth, collider, options, motion.work(), report);
  report.cpu_seconds = cpu_time() - cpu_started;
  report.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - started).count();
  return report;
}

}  // namespace furrow::physics
