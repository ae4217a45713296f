// SPDX-License-Identifier: MIT
#include "physics/rest/settle.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "physics/base/cancel_scope.h"
#include "physics/base/progress.h"
#include "physics/base/require.h"
#include "physics/base/vector_sums.h"
#include "physics/cloth/check_cloth.h"
#include "physics/cloth/element_forces.h"
#include "physics/cloth/riders.h"
#include "physics/contact/anchored_contact.h"
#include "physics/contact/face_contact.h"
#include "physics/contact/residual_force.h"
#include "physics/linear/free_stiffness.h"
#include "physics/pairs/cloth_contact.h"
#include "physics/pairs/ease_around.h"
#include "physics/rest/limited_memory.h"
#include "physics/rest/stiffness_work.h"

namespace furrow::physics {
namespace {

using Vectors = std::vector<Vec3>;

constexpr double least_depth = 1e-7;  // m

constexpr double contact_share = 0.5;     // of the mean stiffness of a particle
constexpr double first_time = 0.03;       // tau [s]
constexpr double endless = 1;             // tau that holds nothing back any more [s]
constexpr double least_share = 1.0 / 32;  // of a step
constexpr double least_clamp = 0.02;      // once the Hessian alone would not do
constexpr double relax_clamp = 0.7;       // after a success
constexpr double far_from_rest = 1e4;     // residual above which one step is all that a factorisation is for
constexpr double stiffer = 10;            // a contact's next depth, that many times less
constexpr int most_followers = 15;        // steps with one factorisation, after the first
constexpr double follow_until = 1e-2;     // share of the first one's expected fall of energy
constexpr int most_face_rounds = 8;       // rests after which contacts of faces are set or raised
constexpr int most_face_steps = 40;       // iterations of such a round
constexpr double face_stiffness = 4;      // that many times the vertices'
constexpr int most_blocked = 8;           // steps running that cloth cuts short, before it ends
constexpr int most_refused = 30;          // steps running that lead nowhere, before it ends
constexpr double nowhere = 1e-9;          // m
constexpr double little_left = 0.1;       // of a move that cloth cuts: it is cut around that alone
constexpr int most_rounds_of_easing = 4;
constexpr std::size_t many = 10000;       // particles whose factors are of single precision, as that pays
constexpr double single_residual = 1e-3;  // of the force, that a solution of those may leave

void check(const Cloth& cloth, const SettleOptions& o) {
  constexpr const char* me = "settle";
  for (const double g : o.gravity) require(me, "gravity", g, true, "finite");
  require(me, "friction", o.friction, o.friction >= 0, ">= 0");
  require(me, "gap", o.gap, o.gap > 0, "> 0");
  require(me, "contact_depth", std::min(o.contact_depth, 1e300), o.contact_depth >= least_depth, ">= 1e-7");
  require(me, "tolerance", o.tolerance, o.tolerance > 0, "> 0");
  require(me, "max_iterations", o.max_iterations, o.max_iterations >= 0, ">= 0");
  require(me, "longest_move", o.longest_move, o.longest_move > 0, "> 0");
  require(me, "threads", o.threads, o.threads >= 1, ">= 1");
  require(me, "faces.error", o.faces.error, o.faces.error >= 0, ">= 0");
  require(me, "self.thickness", o.self.thickness, o.self.thickness > 0, "> 0");
  require(me, "self.friction", o.self.friction, o.self.friction >= 0, ">= 0");
  require(me, "self.max_iterations", o.self.max_iterations, o.self.max_iterations >= 0, ">= 0");
  const std::size_t drawn = o.self.drawn.size(), n = cloth.particles.size();
  if (drawn != 0 && drawn != n) refuse(me, "self.drawn has ", drawn, " positions of ", n, " particles");
  const std::size_t thick = o.self.thicknesses.size();
  if (thick != 0 && thick != n) refuse(me, "self.thicknesses has ", thick, " numbers for ", n, " particles");
  const std::size_t groups = o.self.groups.size();
  if (groups != 0 && groups != n) refuse(me, "self.groups has ", groups, " numbers for ", n, " particles");
  for (const double t : o.self.thicknesses) require(me, "self.thicknesses", t, t > 0, "> 0");
  check_cloth(cloth, me);
}

/// What elements and weight answer at a place.
struct Answer {
  Vectors force;      ///< of the elements [N]
  double energy = 0;  ///< of elements and weight [J]
};
struct Move {
  Vectors way;     ///< of each particle [m]
  double share;    ///< the largest that the options allow [-]; in (0, 1]
  double longest;  ///< of the ways [m]
};
/// Where a move led.
struct Trial {
  double share = 0;  ///< of the move [-]; 0: no share lowers the energy, and the rest says nothing
  Vectors x;
  Answer answer;
};
/// What one Newton step passes on to the next.
struct Pace {
  double tau = first_time;  ///< [s]
  double clamp = 1;         ///< share of the Hessian's clamped part [-]
};
struct Factors {
  bool definite;  ///< there are factors
  double clamp;   ///< share of the clamped part that they have, or the last try had [-]
  int tries;      ///< factorisations that it took
};
/// What a step took, and how to go on.
struct Step {
  Pace next;
  int factorisations, followers;
  bool moved;
};

/// A rest that was found.
struct Rest {
  Vectors x;
  double residual;  ///< [-]
  int through;      ///< faces that the body comes through
  int pushed;       ///< points within faces that it pushes, and their energy [J]
  double energy;
};

/// Pseudo-transient continuation: the longer a step reaches, the less time holds it back; and where the
/// Hessian alone will not do, more of its clamped part is added.
Pace next_pace(Pace pace, const Factors& factors, const Move& move, double share) {
  pace.clamp = factors.clamp;
  if (factors.tries == 1) pace.clamp = factors.clamp < least_clamp / 2 ? 0 : relax_clamp * factors.clamp;
  if (share == 0) return {0.25 * std::min(pace.tau, endless), std::min(1.0, 2 * factors.clamp + least_clamp)};
  if (share == 1) pace.tau *= 4;
  if (share < move.share) return {0.9 * pace.tau, std::min(1.0, 1.5 * factors.clamp + least_clamp / 2)};
  return pace;
}

Vectors moved(Vectors x, double share, const Vectors& way) {
  add_multiple(x, share, way);
  return x;
}

/// One search for rest. The particles' positions are the state, with the contact's anchors; the members
/// beside them are tools.
class Settler {
 public:
  Settler(Cloth& cloth, const Collider* collider, const SettleOptions& options)
      : cloth_(cloth),
        p_(cloth.particles),
        collider_(collider),
        o_(options),
        elements_(cloth),
        stiffness_(stiffness_for(cloth, true, options.work)),
        pool_(options.threads) {
    throw_if_cancelled("settle");
    stiffness_->assemble(cloth, p_.x, Stiffness::positive_part);
    throw_if_cancelled("settle");
    const double k = contact_share * stiffness_->mean_diagonal();
    if (o_.self.on)
      pairs_.emplace(cloth,
                     ClothContactOptions{o_.self.thickness, k > 0 ? k : 1, o_.self.friction,
                                         o_.self.thicknesses, o_.self.groups},
                     p_.x, o_.self.drawn, &pool_);
    const double clearance = std::min(o_.gap / 6, 5e-4);
    if (collider)
      contact_.emplace(*collider, AnchoredContactOptions{o_.friction, o_.gap, k > 0 ? k : 1}, p_.size());
    if (collider && o_.faces.body)
      faces_.emplace(*collider, *o_.faces.body, cloth.triangles,
                     FaceContactOptions{clearance, o_.faces.error, face_stiffness * (k > 0 ? k : 1)});
    if (contact_) contacts_.push_back(&*contact_);
    if (faces_) contacts_.push_back(&*faces_);
    for (const ContactMaker& make : o_.contacts)
      contacts_.push_back(others_.emplace_back(make(cloth, k > 0 ? k : 1)).get());
    if (pairs_) contacts_.push_back(&*pairs_);
  }

  SettleReport run(const SettleObserver& observer) {
    SettleReport report;
    Pace pace;
    Answer here = look(p_.x);
    move_anchors();
    for (;; ++report.iterations) {
      bool rests = look_for_rest(here, report);
      report.converged = rests && !(contact_ && contact_->deepest() > o_.contact_depth);
      if (report.converged && faces_ && keep_faces_out(report)) {
        here = look(p_.x);
        pace.tau = first_time;
        rests = report.converged = false;
      }
      report.stopped = (observer && !observer({report.iterations, report.residual})) || is_cancelled();
      if (report.converged || report.stopped || report.iterations == last_iteration() || is_blocked() ||
          refused_ == most_refused)
        break;
      if (rests) {
        here = stiffen();
        pace.tau = first_time;
      } else {
        const std::optional<Step> done = try_step(pace, here, report.residual < far_from_rest);
        report.stopped = !done;
        if (!done) break;
        pace = done->next;
        refused_ = done->moved ? 0 : refused_ + 1;
        report.factorisations += done->factorisations;
        report.followers += done->followers;
      }
    }
    if (faces_) report.face_contacts = faces_->touching();
    report.contact_energy = faces_ ? faces_->energy() : 0;
    if (best_ && !report.stopped) take_best(report);
    report.stuck = !report.converged && refused_ == most_refused;
    if (contact_) {
      report.touching = contact_->touching();
      report.deepest = contact_->deepest();
    }
    if (pairs_) report.self = self_report(report);
    report.contact_energy =
        (contact_ ? contact_->energy() : 0) + report.contact_energy + (pairs_ ? pairs_->energy() : 0);
    for (const auto& other : others_) report.contact_energy += other->energy();
    return report;
  }

 private:
  /// Whether forces balance; not while ranges of pairs still grow.
  bool look_for_rest(const Answer& here, SettleReport& report) {
    const bool grows = pairs_ && pairs_->widen(p_.x);
    if (grows) pairs_->look(p_.x, &pool_);
    report.residual = residual(here);
    return report.residual <= o_.tolerance && !grows;
  }

  /// Rest is found: sets contacts in faces that the body comes through. Whether it has to go on.
  bool keep_faces_out(const SettleReport& report) {
    const int pushed = faces_->touching();  // before `find` sets more, whose push is not known yet
    const double energy = faces_->energy();
    const FaceContact::Found found = faces_->find(p_.x, p_.inv_mass, &pool_);
    if (!best_ || found.through <= best_->through)
      best_ = Rest{p_.x, report.residual, found.through, pushed, energy};
    if (found.changed == 0 || face_rounds_ == most_face_rounds) return false;
    ++face_rounds_;
    round_ends_ = report.iterations + most_face_steps;
    return true;
  }

  bool is_blocked() const { return pairs_ && pairs_->blocked() >= most_blocked; }

  SelfContactReport self_report(const SettleReport& report) const {
    SelfContactReport self;
    self.pairs = pairs_->touching();
    self.sliding = pairs_->sliding();
    if (self.pairs > 0) self.nearest = pairs_->nearest();
    self.cut_searches = pairs_->cut_searches();
    self.list_builds = pairs_->list_builds();
    self.crossed_at_start = pairs_->crossed_at_start();
    self.exempt = pairs_->exempt();
    self.acted = pairs_->has_acted();
    self.blocked = !report.converged && !report.stopped && is_blocked();
    if (self.blocked) self.blocked_at = *pairs_->blocked_at();
    return self;
  }

  int last_iteration() const {
    const bool more = pairs_ && pairs_->has_acted() && o_.self.max_iterations > 0;
    return std::min(more ? o_.self.max_iterations : o_.max_iterations, round_ends_);
  }

  /// Of the rests that were found, the last with the fewest faces that the body comes through.
  void take_best(SettleReport& report) {
    report.residual = best_->residual;
    report.converged = true;
    report.face_contacts = best_->pushed;  // later rounds set points that this rest was found without
    report.contact_energy = best_->energy;
    p_.x = std::move(best_->x);
    ask_contacts(p_.x);
  }

  void ask_contacts(const Vectors& x) {
    for (ContactTerm* c : contacts_) c->look(x, p_.inv_mass, &pool_);
  }

  /// What the body does to particles it finds by itself.
  double residual(const Answer& at) const {
    Vectors force = at.force;
    for (const ContactTerm* c : contacts_)
      if (!contact_ || c != &*contact_) c->add_forces(force);
    return residual_of(force, p_, o_.gravity, collider_, o_.friction, o_.gap);
  }

  /// Asks elements, weight and body at x; contact_ answers for x until it is asked elsewhere.
  Answer look(const Vectors& x) {
    Answer answer{Vectors(x.size())};
    answer.energy = elements_(x, answer.force, pool_);
    for (std::size_t i = 0; i < x.size(); ++i)
      if (p_.inv_mass[i] > 0) answer.energy -= p_.mass[i] * o_.gravity.dot(x[i]);
    ask_contacts(x);
    return answer;
  }

  /// [J], with the contact's, which must have been asked there last.
  double energy(const Answer& at) const {
    double sum = at.energy;
    for (const ContactTerm* c : contacts_) sum += c->energy();
    return sum;
  }

  /// Of elements, weight and contact [N]; 0 on what is held. As energy().
  Vectors net_force(const Answer& at) const {
    Vectors net = at.force;
    for (const ContactTerm* c : contacts_) c->add_forces(net);
    for (std::size_t i = 0; i < net.size(); ++i) {
      if (p_.inv_mass[i] > 0)
        net[i] += p_.mass[i] * o_.gravity;
      else
        net[i].setZero();
    }
    return net;
  }

  /// Rest is found, but too deep in the gap: the contact becomes stiffer.
  Answer stiffen() {
    const Vectors before = p_.x;
    contact_->stiffen(stiffer, p_.x);
    keep_apart(before, p_.x);
    Answer answer = look(p_.x);
    move_anchors();
    return answer;
  }

  /// Friction takes hold where the particles are; contacts were asked there last.
  void move_anchors() {
    for (ContactTerm* c : contacts_) c->move_anchors(p_.x);
  }

  /// Limits of friction become those of after a move.
  void expect(const Vectors& way) {
    for (ContactTerm* c : contacts_) c->expect(way);
  }

  double safe_share(const Vectors& from, const Vectors& way, double share) {
    for (ContactTerm* c : contacts_) share = c->safe_share(from, way, share, &pool_);
    return share;
  }

  /// As far as nothing passes through cloth. Where that leaves little, the move is shortened around what cuts
  /// it alone, if it goes downhill still.
  void cut(const Vectors& net, Move& move) {
    const double open = move.share;
    move.share = safe_share(p_.x, move.way, open);
    if (!pairs_ || !(move.share < little_left * open)) return;
    Move eased = move;
    std::vector<double> kept(p_.size(), 1);
    for (int round = 0; round < most_rounds_of_easing && eased.share < 0.5 * open; ++round) {
      ease_around(pairs_->cuts(), cloth_.triangles, kept);
      for (std::size_t i = 0; i < kept.size(); ++i) eased.way[i] = kept[i] * move.way[i];
      eased.share = dot(net, eased.way) > 0 ? safe_share(p_.x, eased.way, open) : 0;
      if (eased.share == 0) break;
    }
    if (eased.share > move.share)
      move = std::move(eased);
    else
      move.share = safe_share(p_.x, move.way, open);  // what cuts it is known again
  }

  /// Positions that were reached from others, without what would pass through cloth on the way.
  void keep_apart(const Vectors& from, Vectors& to) {
    Vectors way = to;
    add_multiple(way, -1, from);
    const double share = safe_share(from, way, 1);
    if (share < 1) to = moved(from, share, way);
  }

  /// Blocks of pairs go into a matrix of its own: what other searches share has none.
  void couple_pairs() {
    if (!pairs_->misses_blocks(*stiffness_)) return;
    if (o_.work && !own_stiffness_) stiffness_ = std::make_shared<FreeStiffness>(cloth_, true);
    own_stiffness_ = true;
    pairs_->couple(*stiffness_);
  }

  /// In single precision, until that does not do once: what is nearly singular needs more.
  bool factorise_as_assembled() {
    unchecked_ = single_ && stiffness_->factorise_single(&pool_);
    if (unchecked_) return true;
    const bool definite = stiffness_->factorise_definite(0, &pool_);
    single_ = single_ && !definite;
    return definite;
  }

  /// By the last factors. The first solution of those in single precision is checked; where they do not do,
  /// others take their place, and where there are none, b stays.
  void solve(std::span<Vec3> b) {
    if (!std::exchange(unchecked_, false)) return stiffness_->solve(b, &pool_);
    if (stiffness_->solve_within(single_residual, b, &pool_)) return;
    single_ = false;
    if (stiffness_->factorise_definite(0, &pool_)) stiffness_->solve(b, &pool_);
  }

  /// Clamps the Hessian until it is positive definite.
  Factors factorise(const Pace& pace) {
    double clamp = pace.clamp;
    if (pairs_) couple_pairs();
    for (int tries = 1;; ++tries) {
      throw_if_cancelled("settle");
      stiffness_->assemble(cloth_, p_.x, {clamp}, &pool_);
      for (const ContactTerm* c : contacts_) c->add_stiffness(*stiffness_, SlipStiffness::none);
      for (std::size_t i = 0; i < p_.size(); ++i)
        if (p_.inv_mass[i] > 0)
          stiffness_->add(int(i), p_.mass[i] / (pace.tau * pace.tau) * Mat3::Identity());
      if (factorise_as_assembled()) return {true, clamp, tries};
      if (clamp == 1) return {false, clamp, tries};
      clamp = tries == 4 ? 1 : std::min(1.0, std::max(least_clamp, 2 * clamp));
    }
  }

  Move find_move(const LimitedMemory& inverse, const Vectors& net) const {
    Move move{net, 1, 0};
    inverse.apply(move.way);
    for (const Vec3& m : move.way) move.longest = std::max(move.longest, m.norm());
    if (move.longest > o_.longest_move) move.share = o_.longest_move / move.longest;
    return move;
  }

  /// The longest share of the move, from its largest halved, that lowers the energy. Asks the contact there
  /// last; if there is none, or it is cancelled, where the particles are.
  Trial search(const Answer& here, const Vectors& net, const Move& move) {
    const double before = energy(here), slope = -dot(net, move.way);
    if (!(slope < 0)) return {};
    for (double share = move.share; share > least_share * move.share && !is_cancelled(); share *= 0.5) {
      Trial trial{share, moved(p_.x, share, move.way), {}};
      trial.answer = look(trial.x);
      if (energy(trial.answer) <= before + 1e-4 * share * slope + 1e-13 * std::abs(before)) return trial;
    }
    ask_contacts(p_.x);
    return {};
  }

  void accept(Trial trial, Answer& here) {
    p_.x = std::move(trial.x);
    here = std::move(trial.answer);
  }

  /// As step(); nothing, with the particles as they were, if it was cancelled in a factorisation.
  std::optional<Step> try_step(const Pace& pace, Answer& here, bool near) try {
    return step(pace, here, near);
  } catch (const Cancelled&) {
    return std::nullopt;
  }

  /// One Newton step and, near rest, those that follow it with its factors. The particles move, and `here`
  /// becomes what is answered there.
  Step step(const Pace& pace, Answer& here, bool near) {
    const Factors factors = factorise(pace);
    if (!factors.definite) return {{0.25 * pace.tau, factors.clamp}, factors.tries, 0, false};
    LimitedMemory inverse([this](std::span<Vec3> f) { solve(f); }, most_followers);
    Vectors net = net_force(here);
    Move move = find_move(inverse, net);
    if (!contacts_.empty() && near) {
      expect(move.way);
      net = net_force(here);
      move = find_move(inverse, net);
    }
    cut(net, move);
    Trial trial = search(here, net, move);
    const double share = trial.share;
    const bool refused = contact_ && share < move.share;
    if (refused) contact_->make_room(p_.x, moved(p_.x, move.share, move.way), p_.inv_mass);
    if (share > 0) accept(std::move(trial), here);
    if (refused) ask_contacts(p_.x);  // as there is room now
    const bool blocked = pairs_ && pairs_->blocked() > 0;
    const int followers = share > 0 && near && !blocked ? follow(inverse, here) : 0;
    if (share > 0)
      move_anchors();
    else
      expect(Vectors(p_.size(), Vec3::Zero()));  // limits of where it stayed
    Pace next = next_pace(pace, factors, move, share);
    if (pairs_ && pairs_->blocked() > 1) next.tau *= 0.25;  // cut short twice running
    return {next, factors.tries, followers, share * move.longest > nowhere};
  }

  /// Goes on with the same factors and what the steps with them show, as long as that pays. Returns how many
  /// steps those were.
  int follow(LimitedMemory& inverse, Answer& here) {
    Vectors net = net_force(here);
    double most = 0;
    for (int k = 0; k < most_followers; ++k) {
      Move move = find_move(inverse, net);
      const double fall = dot(net, move.way);
      most = std::max(most, fall);
      if (fall < follow_until * most || is_cancelled()) return k;
      move.share = safe_share(p_.x, move.way, move.share);
      if (pairs_ && pairs_->blocked() > 0) return k;  // these factors do not know what cuts the way
      Trial trial = search(here, net, move);
      if (trial.share == 0) return k;
      for (Vec3& m : move.way) m *= trial.share;
      accept(std::move(trial), here);
      Vectors now = net_force(here), change = std::move(net);
      add_multiple(change, -1, now);
      inverse.add(std::move(move.way), std::move(change));
      net = std::move(now);
    }
    return most_followers;
  }

  Cloth& cloth_;
  Particles& p_;
  const Collider* collider_;
  const SettleOptions& o_;
  ElementForces elements_;
  std::shared_ptr<FreeStiffness> stiffness_;  ///< shared by o_.work until pairs need more blocks
  bool own_stiffness_ = false;
  bool single_ = p_.size() >= many;  ///< factors are of single precision
  bool unchecked_ = false;           ///< those at hand are, and solved for nothing yet
  ThreadPool pool_;
  std::optional<AnchoredContact> contact_;
  std::optional<FaceContact> faces_;
  std::optional<ClothContact> pairs_;
  std::vector<std::unique_ptr<ContactTerm>> others_;
  std::vector<ContactTerm*> contacts_;  ///< the sum of these
  std::optional<Rest> best_;            ///< with faces_
  int face_rounds_ = 0, round_ends_ = std::numeric_limits<int>::max();
  int refused_ = 0;  ///< steps running
};

}  // namespace

SettleReport settle(Cloth& cloth, const Collider* collider, const SettleOptions& options,
                    const SettleObserver& observer) {
  check(cloth, options);
  std::optional<Settler> settler;
  try {
    settler.emplace(cloth, collider, options);
  } catch (const Cancelled&) {
    SettleReport report;
    report.residual = std::numeric_limits<double>::infinity();
    report.stopped = true;
    return report;
  }
  const auto placed = [&](const SettleProgress& progress) {
    place_riders(cloth);
    return observer(progress);
  };
  const SettleReport report = settler->run(observer ? SettleObserver(placed) : observer);
  place_riders(cloth);
  for (Vec3& v : cloth.particles.v) v.setZero();
  return report;
}

}  // namespace furrow::physics
