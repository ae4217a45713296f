// SPDX-License-Identifier: MIT
#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <vector>

#include "physics/body/collider.h"
#include "physics/body/moving_body.h"
#include "physics/cloth/cloth.h"

namespace furrow::physics {

/// Pinned particles that are led: after every step each is exactly at  pose(t) home,  where home is its
/// position in the motion's frame; during the step its velocity is the way that it goes in it over dt.
struct MovedPins {
  std::vector<int> particles;  ///< pinned ones (see pin()); in no two groups
  RigidMotion motion;
};

struct Gust {
  double time;    ///< [s]; strictly increasing
  double factor;  ///< [-]
};

/// Moving air:  w(x, t) = factor(t) velocity + rate(t) axis x (x - centre).  The drag then pulls towards it:
/// v - w decays by exp(-air_drag t), exactly, whichever way the cloth faces. Without drag wind does nothing.
struct Wind {
  Vec3 velocity = Vec3::Zero();  ///< [m/s]
  std::vector<Gust> gusts;       ///< factor; linear between, held outside; none: 1
  std::optional<Spin> swirl;     ///< air that turns like a rigid body
};

/// What surrounds a cloth. What is not used costs nothing. Pointers may be null and must outlive the call.
struct World {
  const Collider* collider = nullptr;  ///< a rigid body, in its own frame
  RigidMotion body_motion;             ///< takes it from there into the world
  AnimatedBody* animated = nullptr;    ///< or a body that changes its shape; not both
  std::vector<MovedPins> pins;
  Wind wind;
};

/// What processor time goes to in a motion.
enum class WorkPart {
  other,          ///< what no name is for: drag, weight, sums over particles
  assembly,       ///< of stiffness matrices
  factorisation,  ///< of these, with the order of elimination
  solve,          ///< with their factors; sweeps of XPBD
  elements,       ///< energies and forces
  contact,        ///< with the body, and its shape at a step's time
  self_contact,   ///< of the cloth with itself
  output          ///< the observer: what is shown and written
};
constexpr std::size_t work_parts = 8;
/// "assembly", "self_contact" and so on.
const char* name_of(WorkPart part);

/// Processor seconds of all threads, by WorkPart.
using WorkTimes = std::array<double, work_parts>;

/// Where the energy of cloth that moves by implicit steps came from and went to [J]: what it has gained is
/// what was given less what was lost. What a force does in a step is its impulse times a velocity of then.
/// The sum is right to rounding. Where something touches, steps of a sixtieth of a second do not part well
/// what contact took from what the steps did; nor what pins gave that are led, by Integrator::implicit.
struct EnergyBalance {
  double seconds = 0;                           ///< of motion that was counted; 0: none was
  double kinetic = 0, elastic = 0, weight = 0;  ///< gained since the start, less than 0: spent
  double by_air = 0, by_body = 0, by_pins = 0;  ///< given by wind, a body that moves, pins that are led
  double by_compensation = 0;                   ///< given by Compensation
  double to_air = 0, to_contact = 0;            ///< lost to drag; to friction, of cloth on cloth, too
  /// The rest: lost by the scheme, and as steps are not solved to the end; less than 0: won.
  double to_steps() const { return given() - to_air - to_contact - kinetic - elastic - weight; }
  double given() const { return by_air + by_body + by_pins + by_compensation; }
  double lost() const { return to_air + to_contact + to_steps(); }
  EnergyBalance& operator+=(const EnergyBalance& more);
};

/// The longest that an edge was, of those measured_edges() names.
struct LongestEdge {
  double strain = 0;       ///< (l - L) / L [-]; 0: none was longer than at rest
  double time = 0;         ///< [s]
  Vec3 at = Vec3::Zero();  ///< its middle [m]
};

/// What a report counts over all calls that shared a state.
struct SimulateTotals {
  std::int64_t force_evaluations = 0, collider_queries = 0;
  std::int64_t truncated_moves = 0;                                    ///< cut short against tunnelling
  std::int64_t linear_solves = 0, factorisations = 0, iterations = 0;  ///< see WorkCounts
  /// Elements times evaluations; 0 shows that a kind that is absent cost nothing.
  std::int64_t spring_evaluations = 0, triangle_evaluations = 0, hinge_evaluations = 0;
  std::int64_t open_steps = 0;  ///< implicit ones whose search did not end, even in 32 parts
  std::int64_t cut_moves = 0;   ///< of particles, so that cloth does not pass through cloth
  std::int64_t limit_estimates = 0;
  std::int64_t frames_built = 0;  ///< fields of an animated body
  EnergyBalance energy;           ///< of implicit steps
  LongestEdge longest_edge;       ///< after any step of implicit ones, of others each 128th
  double dt_smallest = std::numeric_limits<double>::infinity();        ///< [s]
  double dt_limit_smallest = std::numeric_limits<double>::infinity();  ///< of leapfrog [s]
  double seconds = 0, cpu_seconds = 0;  ///< clock and processor time (all threads) [s]
  double frame_seconds = 0;             ///< clock time spent on fields of an animated body [s]
  WorkTimes times{};                    ///< processor time by part, of calls that measured it [s]
};

/// Forces that keep a cloth from jumping when its springs were changed under strain: applied as
///   -force exp(-(t - start) / time_constant),
/// forgotten when the factor falls below 1e-9. Springs along a line that splits an edge do not pull as the
/// edge did, whatever their rest lengths (unlike a membrane's triangles), so an insertion under strain jumps
/// without it.
struct Compensation {
  std::vector<Vec3> force;     ///< one a particle [N]; empty: none
  double start = 0;            ///< [s]
  double time_constant = 0.3;  ///< [s]; > 0, may be infinite
};

/// A pair of the cloth's primitives whose range is not theirs (ClothContact).
struct PairMemory {
  bool edges = false;             ///< two edges; else a vertex and a triangle
  std::array<int, 4> vertices{};  ///< the particles of the one, then of the other
  double range = 0;               ///< at which they push each other now [m]; 0: not yet
  double target = 0;              ///< and may do later [m]

  bool operator==(const PairMemory&) const = default;
};

/// What friction of such a pair remembers (PairAnchor).
struct PairFrictionMemory {
  bool edges = false;
  std::array<int, 4> vertices{};
  Vec3 tether = Vec3::Zero();  ///< [m]
  bool slides = false;

  bool operator==(const PairFrictionMemory&) const = default;
};

/// What contact of the cloth with itself remembers, beside positions, by particle.
struct SelfContactMemory {
  double stiffness = 0;           ///< of its push [N/m], 1 where it has none; 0: it was never on
  std::vector<PairMemory> pairs;  ///< sorted
  std::vector<int> loose;         ///< particles that crossed something at the start, or are next to such
  int crossed_at_start = 0;       ///< edges through faces
  std::vector<std::array<int, 2>> coupled;      ///< what the stiffness has blocks for beside the elements
  std::vector<PairFrictionMemory> friction;     ///< sorted
  std::vector<std::array<int, 2>> ordered_for;  ///< what was coupled when its order of elimination was found

  bool operator==(const SelfContactMemory&) const = default;
};

/// What a step leaves to the next beside positions and velocities.
struct StepMemory {
  std::vector<ContactAnchor> anchors;  ///< of friction, one a particle, or empty
  std::vector<Vec3> acceleration;      ///< at the step's end, one a particle [m/s^2], or empty
  double contact_stiffness = 0;        ///< of a body's push [N/m]; 0: not chosen yet
  SelfContactMemory self;
  std::vector<int> fresh;  ///< particles whose contact begins with the next step, as all do at the start
};

/// All that a simulation knows besides cloth, world and options. A call of simulate() that is stopped at any
/// step and continued with the same state, cloth, world and options gives the bits of one that was not
/// stopped, for any number of threads. A default state is the beginning. Plain numbers and arrays: a file can
/// hold them (bit by bit, with infinity and NaN). After a change of the cloth set `planned` to false, take
/// the memory along (carry_memory(), or clear `contact` and `steps`), and add a force_jump() to the
/// compensation if the cloth was strained.
struct SimulateState {
  double time = 0;        ///< [s]
  std::int64_t step = 0;  ///< steps made

  /// The plan: steps_left steps of dt until `end`. false, as after a change of the cloth: estimate the limit
  /// and divide the rest anew.
  bool planned = false;
  double end = 0;         ///< [s]
  double dt = 0;          ///< [s]
  double dt_longest = 0;  ///< that the plan allows [s]
  std::int64_t steps_left = 0;
  std::int64_t estimated_at = 0;  ///< step of the last estimate of the limit
  double dt_limit = 0;            ///< the estimate, of leapfrog, whatever integrates [s]; 0: none was made
  double strain_at_estimate = 0;  ///< largest strain then [-]
  std::uint64_t cloth = 0;        ///< fingerprint() of the cloth that the plan is for

  std::vector<ContactMemory> contact;  ///< one a particle, or empty
  StepMemory steps;                    ///< of implicit steps
  double body_travel = 0;              ///< of an animated body since the beginning, a bound [m]
  /// Of each of World::pins, one after the other, the particles' positions in the motion's frame [m]. Empty:
  /// taken from where the particles are now.
  std::vector<Vec3> homes;
  Compensation compensation;
  SimulateTotals totals;
};

/// Tells one cloth's elements and masses from another's: a plan is made anew when they changed at a stop. Of
/// Cloth::energies it knows only how many there are: a caller that changes one for another at a stop must
/// make the plan anew (planned = false).
std::uint64_t fingerprint(const Cloth& cloth);

/// Throws std::invalid_argument if the state contradicts itself or does not fit a cloth of so many particles.
void check(const SimulateState& state, std::size_t particles);

enum class Integrator {
  leapfrog,  ///< order 2, symplectic, one force a step; the choice for cloth that moves
  rk4,       ///< order 4, four forces a step; loses energy slowly
  xpbd,      ///< backward Euler by sweeps over the springs: stable at any step, stiffness needs sweeps
  implicit,  ///< backward Euler with contact in the solve, by minimisation: the choice for stiff cloth
  tr_bdf2    ///< the same of order 2, at twice the cost a step
};

/// Whether contact is part of a step's solve (ImplicitStep).
constexpr bool solves_contact(Integrator i) { return i == Integrator::implicit || i == Integrator::tr_bdf2; }

/// Newton's iterations that their steps take, about: 2 or 3 a stage where cloth moves calmly.
constexpr int usual_iterations(Integrator i) { return i == Integrator::tr_bdf2 ? 6 : 3; }

/// Whether steps of any length are stable, so that no limit is estimated.
constexpr bool is_unconditionally_stable(Integrator i) { return i == Integrator::xpbd || solves_contact(i); }

/// Their steps if none is asked for [s]: XPBD gains more from short steps than from many sweeps.
constexpr double default_dt(Integrator i) { return i == Integrator::xpbd ? 1.0 / 1200 : 1.0 / 60; }

struct XpbdOptions {
  int iterations = 10;  ///< sweeps over all springs a step; >= 1
};

struct ImplicitOptions {
  /// A search ends when its next move would correct an error in force of this share of the weight (root mean
  /// square by mass), and nowhere of more than three times that [-]; > 0.
  double tolerance = 0.03;
  int few = 2;  ///< iterations of backward Euler after which 20 times that may be good enough; >= 1
  /// Calm steps of backward Euler go on with the factors of steps before, in under half of the time. Then
  /// a run that was stopped and resumed is the same only up to the tolerance, no more bit by bit.
  bool keep_factors = false;
  std::vector<ContactMaker> contacts = {};  ///< beside those of body and cloth
};

/// Contact of the cloth with itself: no step ever passes through cloth. Implicit steps solve it with the rest
/// (ClothContact); all others respond to it (PairResponse). Where nothing is near, nothing changes, bit by
/// bit.
struct SelfContactOptions {
  bool on = false;
  double thickness = 1e-3;  ///< of the cloth [m]; > 0; where edges are short, it counts as thinner
  double friction = 0;      ///< Coulomb coefficient of cloth on cloth [-]; >= 0
};

/// 2 sqrt(2): RK4 is stable on the imaginary axis up to there. The half-disc of radius 2.785 left of it
/// belongs to its region, too.
constexpr double rk4_limit = 2.8284271247461903, rk4_damped_limit = 2.785;

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
  double dt_max = 0.005;   ///< longest step chosen without `dt`, but for implicit steps [s]; > 0
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
  XpbdOptions xpbd;
  ImplicitOptions implicit;
  SelfContactOptions self;
  int threads = 1;            ///< >= 1; the result is the same for any number
  bool times = false;         ///< whether processor time is divided among parts; no result depends on it
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

enum class Outcome {
  finished,
  stopped_by_observer,
  diverged,
  stopped_at,
  blocked  ///< what is led pulls the cloth into itself: no step is left that passes through nothing
};

/// Contact of the cloth with itself at the end.
struct SelfContactState {
  bool on = false;
  int pairs = 0;             ///< that push each other: vertex and triangle, or two edges
  double nearest = 0;        ///< of them [m]; 0: none
  int crossed_at_start = 0;  ///< edges through faces, which may go on crossing
  int exempt = 0;            ///< pairs of those that did not come apart
};

/// The totals' smallest limit is that of the integrator here.
struct SimulateReport : SimulateTotals {
  Outcome outcome = Outcome::finished;
  std::int64_t steps = 0;
  double time = 0;            ///< reached [s]
  double dt = 0;              ///< of the last step [s]
  double dt_limit = 0;        ///< of the integrator, as last estimated [s]; infinity: there is none
  StrainStatistics strain;    ///< structural springs (else edges of the membrane) at the end
  double kinetic_energy = 0;  ///< [J]; what rests on the body keeps the last half-kick, g dt/2
  double residual_force =
      0;             ///< see residual_force() [-]; of springs, weight and contact with a body at rest
  int contacts = 0;  ///< particles at the body at the end
  bool held_by_cuts = false;  ///< it diverged as cut_moves were too many
  SelfContactState self;
  Vec3 blocked_at = Vec3::Zero();          ///< where, if it was [m]
  double compensation_left = 0;            ///< share of the compensating forces that still acts [-]
  Vec3 compensation_force = Vec3::Zero();  ///< their sum now [N]
};

/// Moves the cloth to the time options.seconds under springs, gravity, air, damping and contact. Steps have
/// equal length between two estimates of the limit, and the end is hit exactly. A state that is not finite or
/// faster than speed_limit ends the run with Outcome::diverged and is left as it is (checked every 16 steps);
/// so does one in which contact of the cloth with itself cuts more than a twentieth of all moves.
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
