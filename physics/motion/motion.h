// SPDX-License-Identifier: MIT
#pragma once
#include "physics/base/thread_pool.h"
#include "physics/contact/contact.h"
#include "physics/motion/compensation.h"
#include "physics/motion/moved_pins.h"
#include "physics/motion/pair_response.h"
#include "physics/motion/step_contact.h"
#include "physics/motion/wind.h"
#include "physics/motion/work_clock.h"
#include "physics/packed/damping_sweep.h"
#include "physics/packed/packed_cloth.h"

namespace furrow::physics {

struct Loads {                ///< what acts on a cloth besides its elements
  Vec3 gravity{0, -9.81, 0};  ///< [m/s^2]
  double air_drag = 0;        ///< c of dv/dt = -c v [1/s]; >= 0
  double spring_damping = 0;  ///< share of critical damping: springs, tension, edges of membrane [-]; >= 0
};

struct Surroundings {  ///< what else acts; each may be null, and must outlive the motion
  BodyContact* contact = nullptr;
  const BodyAround* body = nullptr;  ///< for steps that solve contact with the rest, in place of `contact`
  PairResponse* pairs = nullptr;     ///< contact of the cloth with itself
  PinLeader* pins = nullptr;
  const Wind* wind = nullptr;
  const Compensation* compensation = nullptr;
  WorkClock* clock = nullptr;
};

struct WorkCounts {  // iterations: of Newton's method, or sweeps over all springs; tension counts as springs
  std::int64_t steps = 0, force_evaluations = 0, linear_solves = 0, factorisations = 0, iterations = 0;
  std::int64_t spring_evaluations = 0, triangle_evaluations = 0, hinge_evaluations = 0;
  std::int64_t open_steps = 0;  // implicit ones whose search did not end
  EnergyBalance energy;         // of implicit steps
  ContactCounts contact;
};

/// A cloth in motion and the phases of a step. What has inv_mass 0 moves only as Surroundings::pins leads it.
class Motion {
 public:
  /// The pool must outlive the motion. The elements' forces are those of the cloth's positions. Throws
  /// std::invalid_argument as pack() does, or if a load is out of its range.
  Motion(const Cloth& cloth, const Loads& loads, ThreadPool& pool, const Surroundings& around = {},
         double time = 0);

  /// Before the phases of a step from one time to another [s]: needed if the surroundings depend on time.
  void begin_step(double from, double to);
  /// v decays over `seconds` by the springs' damping, forward or in the reverse order (see DampingSweep).
  void damp_forward(double seconds);
  void damp_reverse(double seconds);
  /// v - w decays by exp(-air_drag seconds), w the air's velocity (0 without wind), before or after
  /// v += seconds (force / m + gravity).
  void drag_and_kick(double seconds);
  void kick_and_drag(double seconds);
  /// x += seconds v, then the answers to it of the body and of the cloth itself. Throws StepBlocked.
  void drift(double seconds);
  /// Of all elements, and what compensates at the step's end or another time [s]; or the latter alone.
  void update_forces() { update_forces(to_); }
  void update_forces(double time);
  void update_compensation(double time);

  const PackedCloth& cloth() const { return cloth_; }
  void unpack(Particles& particles) const;  ///< positions and velocities
  WorkCounts& work() { return work_; }
  PackedCloth& cloth() { return cloth_; }  ///< this and all below: for steps of more than these phases
  const Loads& loads() const { return loads_; }
  const Wind* wind() const { return around_.wind; }
  /// Places of particles that are led.
  std::span<const int> led() const { return around_.pins ? around_.pins->places() : std::span<const int>{}; }
  /// PinLeader::velocities() at the step's end, over a share of it.
  std::vector<Vec3> led_velocities(double share) const {
    return around_.pins ? around_.pins->velocities(to_, share * (to_ - from_)) : std::vector<Vec3>{};
  }
  const BodyAround* body() const { return around_.body; }
  bool compensates() const { return around_.compensation != nullptr; }
  /// Puts led pins where they are at the step's end.
  void arrive();
  ThreadPool& pool() { return pool_; }
  WorkClock& clock() { return around_.clock ? *around_.clock : no_clock_; }
  double from() const { return from_; }
  double to() const { return to_; }

 private:
  const DampingSweep& damping(double seconds);
  void compensate(double time);
  void keep_apart(const std::vector<Vec4>& before, double seconds);
  void meet_body(const std::vector<int>& places, const std::vector<Vec4>& before, double seconds);

  PackedCloth cloth_;
  Loads loads_;
  ThreadPool& pool_;
  Surroundings around_;
  double from_, to_;
  DampingSweep damping_;
  double damping_seconds_ = -1;
  WorkCounts work_;
  WorkClock no_clock_{false};
};

}  // namespace furrow::physics
