// SPDX-License-Identifier: MIT
#pragma once
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <span>

#include "physics/body/collider.h"
#include "physics/cloth/cloth.h"

namespace furrow::physics {

/// Keeps a body from coming through faces whose vertices keep the gap. Where rest is found and the body is
/// nearer to a point of a face than 1/24 of the gap (0.125 mm at most), such points are pushed out to four
/// times that, and rest is looked for again, up to eight times; it ends where fewest faces are pierced. Where
/// nothing is pierced nothing changes, bit by bit. Without friction: the vertices have theirs.
struct FaceGuard {
  const Collider* body = nullptr;  ///< the collider's body, precisely (it may be the collider); null: none
  double error = 0;                ///< by which the collider may differ from it [m]; >= 0
};

/// Contact of the cloth with itself: nothing passes through anything (ClothContact). Where
/// nothing is near, nothing changes, bit by bit.
struct SelfContact {
  bool on = false;
  double thickness = 1e-3;  ///< of the cloth [m]; > 0; where edges are short, it counts as thinner
  double friction = 0.3;    ///< Coulomb coefficient of cloth on cloth [-]; >= 0
  /// In place of SettleOptions::max_iterations as soon as it acts: piles take many steps to lie still. >= 0;
  /// 0: the same.
  int max_iterations = 0;
  std::span<const double> thicknesses = {};  ///< of each particle, in place of `thickness` [m]; empty: none
  /// Of each particle: cloth of two groups does not touch, and passes through each other; empty: one group.
  std::span<const int> groups = {};
  std::span<const Vec3> drawn = {};  ///< positions in which nothing is to be pushed; empty: none
};

class FreeStiffness;

/// What one solve may leave to the next on a cloth with the same elements and held particles: where blocks of
/// the matrix lie and the order of elimination. It changes no bit. For one solve at a time.
struct StiffnessWork {
  std::shared_ptr<FreeStiffness> stiffness;  ///< filled by the first; anew where it does not fit
};

struct SettleOptions {
  Vec3 gravity{0, -9.81, 0};  ///< [m/s^2]; finite
  double friction = 0.3;      ///< Coulomb coefficient with the body [-]; >= 0
  double gap = 0.003;         ///< distance from the body at which it begins to push [m]; > 0
  /// How far the cloth may lie inside the gap at rest [m]; >= 1e-7. By default 0.1 mm in the mean, 1 mm where
  /// most presses on it. With a smaller value tight cloth keeps its energy; 1e-6 takes about twice as long
  /// where tolerance is 1e-3.
  double contact_depth = std::numeric_limits<double>::infinity();
  double tolerance = 1e-3;   ///< residual_force() at which it ends [-]; > 0
  int max_iterations = 200;  ///< >= 0
  /// No vertex moves farther in a step [m]; > 0: less than half the thickness of any limb.
  double longest_move = 0.02;
  int threads = 1;  ///< that share the work; >= 1; the result is the same for any number
  FaceGuard faces = {};
  std::vector<ContactMaker> contacts = {};  ///< beside those of body, faces and cloth
  SelfContact self = {};
  StiffnessWork* work = nullptr;  ///< shared with searches before and after, until self acts; null: none
};

struct SettleProgress {
  int iteration;
  double residual;  ///< [-]
};
/// Called before each iteration and at the end; the cloth holds the state of then and must stay as it is.
/// false: stop here.
using SettleObserver = std::function<bool(const SettleProgress&)>;

/// What contact of the cloth with itself came to.
struct SelfContactReport {
  bool acted = false;        ///< something was near enough, crossed, or cut a step: else all is as without
  int pairs = 0;             ///< that push each other: vertex and triangle, or two edges
  double nearest = 0;        ///< of them [m]; 0: none
  int sliding = 0;           ///< of them, held by all the friction that they can have
  int cut_searches = 0;      ///< steps that were shortened so that nothing passes through
  int list_builds = 0;       ///< detections of what is near
  int crossed_at_start = 0;  ///< edges through faces, which may go on crossing
  int exempt = 0;            ///< pairs of those that did not come apart
  /// Moves of particles that were cut, by displace_by_force(), whose `cut_searches` counts the passes with
  /// such; none: a step is cut as a whole.
  std::optional<long long> cut_moves = {};
  bool blocked = false;      ///< it ended as no step was left: eight running were cut to less than 1/32
  Vec3 blocked_at{0, 0, 0};  ///< where [m]
};

struct SettleReport {
  int iterations = 0, factorisations = 0;
  int followers = 0;       ///< steps with the factors of the step before
  double residual = 0;     ///< residual_force() at the end [-]
  bool converged = false;  ///< residual <= tolerance
  bool stopped = false;    ///< by the observer
  bool stuck = false;      ///< it ended as thirty steps running led nowhere
  int touching = 0;        ///< particles that the body carries
  double deepest = 0;      ///< of them, inside the gap [m]
  int face_contacts = 0;   ///< points within faces that the body pushes (FaceGuard)
  SelfContactReport self = {};
  double contact_energy = 0;  ///< stored in contact, its friction, and contact of the cloth with itself [J]
};

/// Moves the free particles to rest on a body (null: none), from cloth.particles.x: to a state in which
/// elements, weight and contact forces within the friction cone balance. Velocities become 0. The way there
/// counts for nothing. Where friction acts there are many such states, and the start chooses; a start that
/// lies deeper in the body than the gap should be brought out first (bring_out()).
/// Cost: a factorisation or two an iteration, O(n^1.5) for n particles of a sheet; some 10 to 30 iterations.
/// Cancelled before its first iteration, it reports no residual (infinity). Same input, same bits. Throws
/// std::invalid_argument, nothing changed, if an option is out of its range,
/// arrays differ in length, a position is not finite, a free particle has no mass, or as the elements do.
///
/// \details Newton's method on the energy of elements, weight and AnchoredContact. Where the Hessian is not
/// positive definite, as much of its clamped part (Stiffness) is added as makes it so, and m / tau^2, tau
/// from 0.03 s up while steps succeed (pseudo-transient continuation). A step is halved until the energy
/// falls (Armijo, 1e-4). Near rest, up to fifteen quasi-Newton steps (LimitedMemory) follow each Newton step
/// with its factors. It ends, too, where thirty steps running lead nowhere (1e-9 m): cloth folded onto
/// itself, whose angles jump. Limits of friction follow the push within a step. One of Cloth::energies
/// without stiffness counts in forces and energies alone: the same rest by more iterations, or none where it
/// is the stiffest of all. It looks for balance alone: from a start within a plane of symmetry it may end in
/// a saddle, which certify() tells. Source: Nocedal and Wright, Numerical Optimization, 2nd ed., 3.1; Kelley
/// and Keyes 1998, Convergence analysis of pseudo-transient continuation, SIAM J. Numer. Anal. 35(2).
SettleReport settle(Cloth& cloth, const Collider* collider, const SettleOptions& options,
                    const SettleObserver& observer = {});

struct DisplaceOptions {
  Vec3 gravity{0, -9.81, 0};  ///< [m/s^2]; finite
  double friction = 0.3;      ///< Coulomb coefficient with the body [-]; >= 0
  double gap = 0.003;         ///< distance at which cloth rests on the body [m]; > 0
  double tolerance = 1e-3;    ///< residual_force() at which it ends [-]; > 0
  int max_passes = 20000;     ///< >= 0
  double rate = 0;            ///< alpha, way per force [m/N]; >= 0; 0: displacement_rate()
  bool cap = true;            ///< whether large forces are replaced
  /// Largest summed force that stays as it is, in mean weights of a free particle [-]; > 0 if cap.
  double limit = 1.5;
  double replacement = 1.1;  ///< what a larger one becomes, in the same [-]; in (0, limit] if cap
  SelfContact self = {};     ///< max_iterations does not count
  int threads = 1;           ///< that look for what is near; >= 1; the result is the same for any number
};

enum class DisplaceOutcome {
  converged,    ///< residual <= tolerance
  limit_cycle,  ///< the last quarter of max_passes came back to where it was and its residual had not fallen
  unfinished,   ///< still on the way after max_passes, or sliding or falling without end
  stopped,      ///< by the observer
  diverged      ///< not finite, or a particle farther from the start than 100 times the cloth's extent there
};

struct DisplaceReport {
  DisplaceOutcome outcome = DisplaceOutcome::unfinished;
  int passes = 0;
  double residual = 0;   ///< residual_force() at the end [-]; of the real forces, replaced or not
  double rate = 0;       ///< alpha [m/N]
  long long capped = 0;  ///< forces replaced, over all passes
  int touching = 0;      ///< particles within the gap (plus 1e-5 m) of the body at the end
  SelfContactReport self = {};
};

/// Fitting without velocities: in each pass every free particle is displaced by its force,
///   x += alpha f,   f of elements (elements.h) and weight m g, all taken before any particle moves.
/// Velocities become 0; the states on the way are no motion. Cost: passes * (elements + a query of the field
/// a particle); passes grow as the square of the particles across the cloth, where settle() needs fewer than
/// a hundred iterations. Same input, same bits. What diverged is left as it is, maybe not finite.
/// Throws std::invalid_argument, nothing changed, if an option is out of its range, arrays differ in length,
/// a position is not finite, a free particle has no mass, there is contact of the cloth with itself but no
/// triangle, or as the elements do.
///
/// \details Where |f| > limit w, w the mean weight of the free particles (9.81 m/s^2 where gravity is 0), f
/// becomes replacement w f/|f|. This bounds the travel of a pass, so that a start far from rest does not
/// break the cloth; a rate that is not stable stays so, but goes round in a limit cycle. (By its own weight a
/// light corner could not follow the others; the paper's particles all weigh the same.) A particle that came
/// nearer to the body (null: none) than the gap has its way along the surface shortened by friction times the
/// correction that the way into the body calls for, maybe to nothing (it sticks), and is moved out along the
/// gradient. Bodies thinner than alpha |f| are passed through.
///
/// With contact of the cloth with itself (methods S2.9, S2.10) what is near is kept apart after each pass, in
/// turns with the body (PairPushes): all free particles are moved alike, so what pairs do are forces, equal
/// and opposite, which the next pass adds to f; the residual has them, too. A tenth of what is missing to the
/// thickness is made up in a pass. Then a guard cuts what would pass through cloth, so no pass crosses. It is
/// no rest where in the last pass a move was cut, sweeps had not ended, or a fiftieth of a range was missing.
///
/// Stable for alpha < 2 / (largest eigenvalue of K). Tension c e^2 on edges of length L has the slope 2 c e /
/// L: a chain is stable for alpha c e / L < 1/4, by Gershgorin a sheet of valence v for < 1/(2 v), 1/12 on
/// regular triangles. Balance needs e = sqrt(T / c), so small strains want small rates.
/// Source: Hanami and Tokoi (method S2.6 to S2.10), whose alpha is 1; the replacement's direction, the
/// friction and the kinds of end are ours.
DisplaceReport displace_by_force(Cloth& cloth, const Collider* collider, const DisplaceOptions& options,
                                 const SettleObserver& observer = {});

/// A rate [m/N] for the cloth as it lies: 1 / (largest eigenvalue of K), half of what is stable, K as for
/// stable_step(), with tension strained by tension_margin more, or by the strain at which it pulls with half
/// of all free weight if that is more (so it is stable while no edge carries twice the weight). At most what
/// displaces no free particle's weight farther than `longest` [m, > 0]. 0 if nothing is free. Throws
/// std::invalid_argument as the elements do.
double displacement_rate(const Cloth& cloth, const Vec3& gravity, double longest);

}  // namespace furrow::physics
