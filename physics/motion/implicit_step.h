// SPDX-License-Identifier: MIT
#pragma once
#include <memory>
#include <optional>

#include "physics/motion/energy_balance.h"
#include "physics/motion/step_contact.h"
#include "physics/motion/step_search.h"
#include "physics/motion/stepper.h"

namespace furrow::physics {

/// Implicit steps whose stages are minima of an energy (step_search.h): elements, contact and friction of a
/// body, drag and inertia in one solve, so that stiff cloth on a body takes steps of a sixtieth of a second.
///  - Integrator::implicit: backward Euler. Order one; takes energy out of what trembles within some steps.
///  - Integrator::tr_bdf2: a trapezoidal stage to gamma dt, gamma = 2 - sqrt 2, then a BDF2 stage to the end
///    (Bank et al. 1985). Order two, stable for any dt; a step whose stages do not end in twelve iterations,
///    and the first one, are those of backward Euler.
/// A step that does not end in twelve iterations is made in halves, down to 1/32; what is still open then is
/// counted (WorkCounts::open_steps). Backward Euler may leave a few particles that still move. With contact
/// of the cloth with itself, pairs that touch are a part of the energy, with friction, and neither a guess
/// nor a move passes through cloth. What is led goes as far as cloth lets it, and farther as that goes out of
/// its way, in eight rounds; where it has no room in 1/32 of a step, it throws StepBlocked. Drag is implicit;
/// dashpots of springs do not act: their share is far below what the steps themselves take out. Cost of an
/// iteration: assembly and a sparse Cholesky factorisation (O(n^1.5) of n vertices of a sheet); two to three
/// iterations a stage in calm motion. Same bits for any number of threads. Sources: Gast et al., TVCG 21
/// (2015) 1103-1115; Bank et al., IEEE Trans. Electron Devices 32 (1985) 1992-2007.
class ImplicitStep : public Stepper {
 public:
  /// Throws std::invalid_argument if an option is out of its range.
  ImplicitStep(Motion& motion, Integrator scheme, const ImplicitOptions& options = {},
               const SelfContactOptions& self = {});
  void step(double dt) override;
  void recall(const StepMemory& memory) override;
  StepMemory memory() const override;
  SelfContactState self_contact() const override;

 private:
  /// Where particles are and how they move; what the next step begins with.
  struct State {
    std::vector<Vec3> x, v;  ///< [m], [m/s]
    std::vector<Vec3> a;     ///< of the last stage [m/s^2]; empty: not known
    ElementAnswer elements;  ///< there
  };
  /// What solve() leaves beside x.
  struct Solved {
    bool converged = false;
    FoundForces forces;          ///< where it ended, before friction followed
    std::vector<Vec3> carried;   ///< as of StepContact::move_body(); empty: no body
    std::vector<Vec3> body_way;  ///< of the body's point next to each particle [m]; empty: no body
    StepLoads loads;
  };
  struct Interval {
    double from, to;  ///< [s]
    int parts;        ///< of its step are of this length
    double length() const { return to - from; }
  };
  State read() const;
  void know_elements(State& state);
  void write(const State& state);
  void lead_out(double by, State& state);
  void prepare(double dt);
  void begin_contact(std::vector<Vec3> pull);
  void make_pairs();
  void make_search();
  void couple_again();
  void forget_step(const SelfContactMemory& before);
  int approach(const std::vector<Vec3>& from, std::vector<Vec3>& x);
  bool make_way(const Stage& stage, const StepLoads& loads, const StageStart& start, SearchOptions options,
                std::vector<Vec3>& x);
  SelfContactMemory pair_memory() const;
  StepLoads loads_at(double time);
  State advance(const State& start, Interval time);
  std::optional<State> euler(const State& start, Interval time);
  std::optional<State> tr_bdf2(const State& start, Interval time);
  Solved solve(const Stage& stage, const State& start, Interval time, int few, std::vector<Vec3>& x);
  std::vector<Vec3> contact_before(const State& start, const std::vector<ContactAnchor>& anchors,
                                   const StepLoads& loads) const;
  void book(const State& start, const State& end, const StepImpulse& impulse, double seconds);

  Motion& motion_;
  Integrator scheme_;
  ImplicitOptions options_;
  SelfContactOptions self_;
  Cloth cloth_;                         ///< the motion's, by place
  std::vector<Vec3> a_;                 ///< see State
  ElementAnswer elements_;              ///< at the end of the last step
  std::vector<Vec3> end_;               ///< where that was [m]
  double stiffness_ = 0;                ///< of contact [N/m]; 0: not chosen yet
  std::vector<ContactAnchor> anchors_;  ///< to begin with; empty: none
  std::unique_ptr<StepContact> contact_;
  SelfContactMemory known_;  ///< of contact of the cloth with itself, to begin with
  std::vector<int> fresh_;   ///< particles whose contact begins with the first step
  std::unique_ptr<ClothContact> pairs_;
  std::vector<std::unique_ptr<ContactTerm>> others_;
  std::optional<Vec3> no_room_;  ///< where the last guess could not lead what is held [m]
  bool open_ = false;            ///< a part of the present step was not solved
  bool begins_ = false;          ///< no step was made before
  StepMemory recalled_;          ///< what it goes on from
  std::unique_ptr<StepSearch> search_;
};

}  // namespace furrow::physics
