// SPDX-License-Identifier: MIT
#include "physics/motion/simulate.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <memory>

#include "physics/base/progress.h"
#include "physics/base/require.h"
#include "physics/cloth/riders.h"
#include "physics/contact/animated_contact.h"
#include "physics/contact/rigid_contact.h"
#include "physics/motion/simulate_report.h"
#include "physics/motion/step_length.h"
#include "physics/motion/stepper.h"
#include "physics/motion/strain_watch.h"
#include "physics/motion/work_clock.h"

namespace furrow::physics {
namespace {

constexpr int divergence_steps = 16;      // steps between two looks for divergence
constexpr int steps_of_watch = 128;       // short ones, between two looks for long edges
constexpr int widening_steps = 64;        // between two changes of what pairs may do
constexpr int least_steps_of_cuts = 256;  // of a call, before its cuts are judged
constexpr double most_cut = 0.05;         // of all moves of particles

void require_positive(double value, const char* name) {
  if (!(value > 0) || !std::isfinite(value)) refuse("simulate", name, " = ", value, " is not > 0");
}

void check(const SimulateOptions& o) {
  if (o.self.on) require_positive(o.self.thickness, "self.thickness");
  require("simulate", "self.friction", o.self.friction, o.self.friction >= 0, ">= 0");
  require("simulate", "friction", o.friction, o.friction >= 0, ">= 0");
  require_positive(o.contact_gap, "contact_gap");
  require_positive(o.recovery_speed, "recovery_speed");
  if (!(o.seconds >= 0) || !std::isfinite(o.seconds))
    refuse("simulate", "seconds = ", o.seconds, " is not >= 0");
  if (o.stop_at && std::isnan(*o.stop_at)) refuse("simulate", "stop_at is not a number");
  if (o.dt) require_positive(*o.dt, "dt");
  if (!(o.dt_factor > 0 && o.dt_factor <= 1))
    refuse("simulate", "dt_factor = ", o.dt_factor, " is not in (0, 1]");
  if (o.step_rule == StepRule::forced && !o.dt) refuse("simulate", "a forced step needs dt");
  require_positive(o.dt_max, "dt_max");
  require_positive(o.limit_strain, "limit_strain");
  require_positive(o.speed_limit, "speed_limit");
  if (o.limit_steps < 1) refuse("simulate", "limit_steps = ", o.limit_steps, " is not >= 1");
  if (o.observe_steps < 1) refuse("simulate", "observe_steps = ", o.observe_steps, " is not >= 1");
}

bool has_diverged(const PackedCloth& cloth, double speed_limit) {
  const double most = speed_limit * speed_limit;
  for (std::size_t i = 0; i < cloth.v.size(); ++i) {
    const Vec4 &v = cloth.v[i], &x = cloth.x[i];
    if (!(v.x * v.x + v.y * v.y + v.z * v.z <= most) || !std::isfinite(x.x + x.y + x.z)) return true;
  }
  return false;
}

/// All that a call works with besides cloth, world and options.
class Simulation {
 public:
  Simulation(Cloth& cloth, const World& world, const SimulateOptions& options, SimulateState& state);
  void run(const Observer& observer, SimulateReport& report);
  /// Brings cloth and state up to date and fills the report but for the clocks.
  void finish(SimulateReport& report);

 private:
  void make_contact();
  void lead_pins();
  void recall();
  void remember();
  bool observe(const Observer& observer, const SimulateReport& report);
  bool make_step(double to);
  bool is_held_by_cuts();
  void go_back(const std::vector<Vec4>& v, const WorkCounts& work);

  Cloth& cloth_;
  const World& world_;
  const SimulateOptions& options_;
  SimulateState& state_;
  WorkClock clock_;
  ThreadPool pool_;
  ContactOptions contact_options_;
  int frames_before_ = 0;
  double frame_seconds_before_ = 0;
  std::unique_ptr<BodyContact> contact_;
  BodyAround body_;                    ///< for steps that solve contact; in place of contact_
  std::optional<PairResponse> pairs_;  ///< where steps do not solve it
  std::optional<PinLeader> leader_;
  std::optional<Motion> motion_;
  std::unique_ptr<Stepper> stepper_;
  std::optional<StepLength> length_;
  std::optional<StrainWatch> strain_;
  bool stepped_ = false;  // in this call
  bool blocked_ = false;
  Vec3 blocked_at_ = Vec3::Zero();
  double travel_;  // of an animated body until the last whole step [m]
};

Simulation::Simulation(Cloth& cloth, const World& world, const SimulateOptions& options, SimulateState& state)
    : cloth_(cloth),
      world_(world),
      options_(options),
      state_(state),
      clock_(options.times),
      pool_(options.threads),
      contact_options_{options.friction, options.contact_gap, options.recovery_speed},
      travel_(state.body_travel) {
  if (world.collider && world.animated) refuse("simulate", "a rigid and an animated body at once");
  check(world.wind);
  check(world.body_motion);
  check(state, cloth.particles.size());
  make_contact();
  lead_pins();
  if (options.self.on && !solves_contact(options.integrator)) pairs_.emplace(options.self);
  const Surroundings around{contact_.get(),
                            body_.any() ? &body_ : nullptr,
                            pairs_ ? &*pairs_ : nullptr,
                            leader_ ? &*leader_ : nullptr,
                            is_still(world.wind) || options.air_drag == 0 ? nullptr : &world.wind,
                            state.compensation.force.empty() ? nullptr : &state.compensation,
                            &clock_};
  motion_.emplace(cloth, Loads{options.gravity, options.air_drag, options.spring_damping}, pool_, around,
                  state.time);
  if (state.step > 0) motion_->work() = {};  // counted by the call that ended here
  motion_->work().energy = state.totals.energy;
  recall();
  stepper_ = make_stepper(*motion_, {options.integrator, options.xpbd, options.implicit, options.self});
  if (solves_contact(options.integrator)) stepper_->recall(state.steps);
  length_.emplace(cloth, options, state);
  strain_.emplace(cloth, motion_->cloth());
}

void Simulation::make_contact() {
  const int n = int(cloth_.particles.size());
  if (world_.animated) {
    frames_before_ = world_.animated->frames_built();
    frame_seconds_before_ = world_.animated->build_seconds();
    world_.animated->prepare(state_.time, state_.time);
  }
  if (solves_contact(options_.integrator)) {
    const bool moves = world_.collider && !is_identity(world_.body_motion);
    body_ = {world_.collider,      moves ? &world_.body_motion : nullptr,
             world_.animated,      options_.friction,
             options_.contact_gap, options_.recovery_speed};
  } else if (world_.animated) {
    contact_ = std::make_unique<AnimatedContact>(*world_.animated, contact_options_, n, state_.body_travel);
  } else if (world_.collider && !is_identity(world_.body_motion)) {
    contact_ = std::make_unique<RigidContact>(*world_.collider, world_.body_motion, contact_options_, n);
  } else if (world_.collider) {
    contact_ = std::make_unique<BodyContact>(*world_.collider, contact_options_, n);
  }
}

void Simulation::lead_pins() {
  if (world_.pins.empty() && state_.homes.empty()) return;
  std::vector<Vec3> homes = homes_of(world_.pins, cloth_.particles, state_.time);
  if (!state_.homes.empty() && state_.homes.size() != homes.size()) {
    refuse("simulate", "the state knows ", state_.homes.size(), " moved pins, but there are ", homes.size());
  }
  if (state_.homes.empty()) state_.homes = std::move(homes);
  leader_.emplace(world_.pins, state_.homes);
}

void Simulation::recall() {
  if (pairs_) pairs_->recall(state_.steps, motion_->cloth());
  if (state_.contact.empty() || !contact_) return;
  for (std::size_t i = 0; i < state_.contact.size(); ++i) {
    contact_->memory()[i] = state_.contact[std::size_t(motion_->cloth().particle[i])];
  }
}

void Simulation::remember() {
  state_.contact.resize(contact_ ? cloth_.particles.size() : 0);
  for (std::size_t i = 0; i < state_.contact.size(); ++i) {
    state_.contact[std::size_t(motion_->cloth().particle[i])] = contact_->memory()[i];
  }
  if (share_left(state_.compensation, state_.time) == 0) state_.compensation.force.clear();
  state_.steps = stepper_->memory();
  if (pairs_) {
    state_.steps.self = pairs_->memory(motion_->cloth());
    state_.totals.cut_moves += pairs_->cut_moves();
  }
  if (world_.animated) {
    state_.body_travel = travel_;
    state_.totals.frames_built += world_.animated->frames_built() - frames_before_;
    state_.totals.frame_seconds += world_.animated->build_seconds() - frame_seconds_before_;
  }
  const WorkCounts& work = motion_->work();
  state_.totals.force_evaluations += work.force_evaluations;
  state_.totals.spring_evaluations += work.spring_evaluations;
  state_.totals.triangle_evaluations += work.triangle_evaluations;
  state_.totals.hinge_evaluations += work.hinge_evaluations;
  state_.totals.linear_solves += work.linear_solves;
  state_.totals.factorisations += work.factorisations;
  state_.totals.iterations += work.iterations;
  state_.totals.open_steps += work.open_steps;
  state_.totals.energy = work.energy;
  state_.totals.collider_queries += work.contact.queries;
  state_.totals.truncated_moves += work.contact.truncations;
}

void Simulation::run(const Observer& observer, SimulateReport& report) {
  SimulateState& s = state_;
  report.dt = s.dt;
  bool observed = true;  // of the present state; before the first step there is nothing new
  while (s.steps_left > 0) {
    if (options_.stop_at && s.time >= *options_.stop_at) {
      report.outcome = Outcome::stopped_at;
      if (observer && !observed) observe(observer, report);
      return;
    }
    const bool last = s.steps_left == 1;
    const double to = last ? s.end : s.time + s.dt;
    report.dt = s.dt;
    s.totals.dt_smallest = std::min(s.totals.dt_smallest, s.dt);
    if (!make_step(to)) {
      report.outcome = blocked_ ? Outcome::blocked : Outcome::stopped_by_observer;
      return;
    }
    ++s.step;
    s.time = to;
    if (solves_contact(options_.integrator) || s.step % steps_of_watch == 0)
      s.totals.longest_edge = strain_->look(motion_->cloth(), s.time, s.totals.longest_edge);

    observed = observer && (s.step % options_.observe_steps == 0 || last);
    const bool checked = s.step % divergence_steps == 0 || observed || last;
    if (length_->due()) motion_->unpack(cloth_.particles);
    report.held_by_cuts = checked && is_held_by_cuts();
    if (report.held_by_cuts || (checked && has_diverged(motion_->cloth(), options_.speed_limit))) {
      report.outcome = Outcome::diverged;
      return;
    }
    length_->advance();
    if (observed && !observe(observer, report) && !last) {
      report.outcome = Outcome::stopped_by_observer;
      return;
    }
  }
}

/// false: the step was cancelled, or there is no room for it, and all is as it was before it.
bool Simulation::make_step(double to) {
  const WorkCounts work = motion_->work();
  const bool may_break = leader_ && (pairs_ || solves_contact(options_.integrator));
  const auto v = may_break ? motion_->cloth().v : decltype(motion_->cloth().v){};
  if (pairs_ && state_.step % widening_steps == 0) pairs_->widen(motion_->cloth());
  motion_->begin_step(state_.time, to);
  try {
    stepper_->step(state_.dt);
  } catch (const Cancelled&) {
    go_back(v, work);
    return false;
  } catch (const StepBlocked& here) {
    blocked_ = true;
    blocked_at_ = here.at;
    go_back(v, work);
    return false;
  }
  stepped_ = true;
  if (world_.animated && contact_) travel_ = static_cast<AnimatedContact&>(*contact_).travel();
  return true;
}

/// The guard against cloth through cloth would hide that a step is unstable: it cuts it everywhere.
bool Simulation::is_held_by_cuts() {
  if (!pairs_ || motion_->work().steps < least_steps_of_cuts) return false;
  const double moves = double(motion_->work().steps) * double(cloth_.particles.size());
  return double(pairs_->cut_moves()) > most_cut * moves;
}

/// To before a step. v: velocities of then; empty: they are as they were.
void Simulation::go_back(const std::vector<Vec4>& v, const WorkCounts& work) {
  if (!v.empty()) motion_->cloth().v = v;
  if (leader_ && !stepped_) leader_->forget_step();
  if (world_.animated) world_.animated->prepare(state_.time, state_.time);
  motion_->work() = state_.step > 0 ? work : WorkCounts{};  // the next call counts the beginning, too
}

bool Simulation::observe(const Observer& observer, const SimulateReport& report) {
  const WorkClock::Within output(clock_, WorkPart::output);
  motion_->unpack(cloth_.particles);
  place_riders(cloth_);
  return observer({state_.time, state_.step, report.dt, kinetic_energy(cloth_.particles)});
}

void Simulation::finish(SimulateReport& report) {
  motion_->unpack(cloth_.particles);
  place_riders(cloth_);
  remember();
  measure(cloth_, world_, state_, options_.gravity, contact_options_, report);
  report.self = pairs_ ? pairs_->state(motion_->cloth()) : stepper_->self_contact();
  report.blocked_at = blocked_at_;
  const WorkTimes times = clock_.times();
  for (std::size_t i = 0; i < work_parts; ++i) state_.totals.times[i] += times[i];
  report.times = state_.totals.times;
  report.dt_limit = length_->limit(state_.dt_limit);
  report.dt_limit_smallest = length_->limit(state_.totals.dt_limit_smallest);
}

}  // namespace

SimulateReport simulate(Cloth& cloth, const World& world, const SimulateOptions& options,
                        SimulateState* state, const Observer& observer) {
  const auto started = std::chrono::steady_clock::now();
  const double cpu_started = processor_seconds();
  check(options);
  SimulateState present = state ? *state : SimulateState{};
  SimulateReport report;
  std::optional<Simulation> simulation;
  try {
    simulation.emplace(cloth, world, options, present);
  } catch (const Cancelled&) {  // cloth and state are as they were
    report.outcome = Outcome::stopped_by_observer;
    report.dt_smallest = report.dt_limit_smallest = 0;
    report.time = present.time;
    report.steps = present.step;
    return report;
  }
  simulation->run(observer, report);
  simulation->finish(report);
  simulation.reset();
  report.cpu_seconds = present.totals.cpu_seconds += processor_seconds() - cpu_started;
  report.seconds = present.totals.seconds +=
      std::chrono::duration<double>(std::chrono::steady_clock::now() - started).count();
  if (state) *state = std::move(present);
  return report;
}

SimulateReport simulate(Cloth& cloth, const Collider* collider, const SimulateOptions& options,
                        const Observer& observer) {
  World world;
  world.collider = collider;
  return simulate(cloth, world, options, nullptr, observer);
}

}  // namespace furrow::physics
