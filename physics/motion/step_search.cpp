// SPDX-License-Identifier: MIT
#include "physics/motion/step_search.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

#include "physics/base/cancel_scope.h"
#include "physics/base/vector_sums.h"

namespace furrow::physics {
namespace {

constexpr double good_enough = 20;        // times the tolerance, after few iterations
constexpr double longest_enough = 3;      // times what is good enough in the mean
constexpr double stretch_enough = 0.2;    // of an edge by a move that is good enough: few may be far off yet
constexpr double short_move = 10;         // times the tolerance: the factors serve the next one
constexpr int most_with_kept = 4;         // iterations with the factors of a search before
constexpr double single_residual = 1e-4;  // of the force, that a solution of single precision may leave
constexpr std::size_t most_coupled = 4;   // times the pairs of particles that contact couples
constexpr int most_rounds = 4;            // in which friction follows the push
constexpr double followed = 0.1;          // of the tolerance, for the move of another round
constexpr double armijo = 1e-4;
constexpr double least_move_share = 1e-3;  // of a move
constexpr double least_fall = 1e-12;       // of the energy, that can be told from rounding
constexpr double energy_rounding = 1e-13;

double longest_length(const std::vector<Vec3>& move) {
  double longest = 0;
  for (const Vec3& m : move) longest = std::max(longest, m.norm());
  return longest;
}

std::vector<Vec3> moved(std::vector<Vec3> x, double share, const std::vector<Vec3>& way) {
  add_multiple(x, share, way);
  return x;
}

/// Where the parabola through the energy, its slope and the energy at `share` is least.
double least_of_parabola(double share, double slope, double rise) {
  const double curvature = rise - slope * share;
  if (!(curvature > 0)) return 0.5 * share;
  return std::clamp(-0.5 * slope * share * share / curvature, 0.05 * share, 0.5 * share);
}

}  // namespace

StepSearch::StepSearch(const Cloth& cloth, Motion& motion, StepContact* contact, ClothContact* pairs,
                       std::span<const std::unique_ptr<ContactTerm>> others)
    : cloth_(cloth),
      loads_(motion.loads()),
      contact_(contact),
      pairs_(pairs),
      pool_(motion.pool()),
      work_(motion.work()),
      clock_(motion.clock()),
      elements_(cloth),
      edges_(measured_edges(cloth)),
      stiffness_(cloth, StepElements::part.narrow) {
  const Particles& p = cloth.particles;
  for (std::size_t i = 0; i < p.size(); ++i)
    if (p.inv_mass[i] > 0) mass_ += p.mass[i];
  if (contact) contacts_.push_back({contact, WorkPart::contact});
  for (const auto& other : others) contacts_.push_back({other.get(), WorkPart::contact});
  if (pairs) contacts_.push_back({pairs, WorkPart::self_contact});
}

FoundForces StepSearch::found() const {
  FoundForces forces{{found_.elements, found_.pull}, pushes(), {}};
  for (const Contact& c : contacts_) {
    if (c.term == contact_) continue;
    forces.cloth.resize(found_.pull.size(), Vec3::Zero());
    c.term->add_forces(forces.cloth);
  }
  for (std::size_t i = 0; i < forces.body.size(); ++i)  // contact is far stiffer than what else is unsolved
    if (!forces.body[i].isZero(0)) forces.body[i] -= found_.net[i];
  return forces;
}

/// The body's on each particle where it was looked last.
std::vector<Vec3> StepSearch::pushes() const {
  if (!contact_) return {};
  std::vector<Vec3> force(cloth_.particles.size(), Vec3::Zero());
  contact_->add_forces(force);
  return force;
}

void StepSearch::hold(std::span<const Vec3> x) {
  for (const Contact& c : contacts_) c.term->move_anchors(x);
}

ElementAnswer StepSearch::elements_at(std::span<const Vec3> x) {
  ElementAnswer answer;
  answer.pull.resize(x.size());
  answer.energy = elements_(x, answer.pull, pool_);
  return answer;
}

double StepSearch::contact_stiffness(std::span<const Vec3> x) {
  elements_.assemble(stiffness_, x, pool_);
  const double k = 0.5 * stiffness_.mean_diagonal();
  return k > 0 ? k : 1;
}

double StepSearch::mean_mass() const {
  const int n = stiffness_.free_particles();
  return n > 0 ? mass_ / n : 0;
}

/// Root of the mean square by mass [m].
double StepSearch::mean_length(const std::vector<Vec3>& move) const {
  const Particles& p = cloth_.particles;
  double sum = 0;
  for (std::size_t i = 0; i < move.size(); ++i)
    if (p.inv_mass[i] > 0) sum += p.mass[i] * move[i].squaredNorm();
  return mass_ > 0 ? std::sqrt(sum / mass_) : 0;
}

/// The most by which a move changes an edge's length [-], to first order: turning does not count.
double StepSearch::stretch_of(const std::vector<Vec3>& move, const std::vector<Vec3>& x) const {
  double most = 0;
  for (const Spring& edge : edges_) {
    const auto a = std::size_t(edge.a), b = std::size_t(edge.b);
    const Vec3 way = x[b] - x[a];
    const double length = std::max(way.norm(), edge.rest_length);
    most = std::max(most, std::abs(way.dot(move[b] - move[a])) / (length * edge.rest_length));
  }
  return most;
}

/// Whether the move after this one would be short enough to be left.
bool StepSearch::is_good_enough(int iteration, const std::vector<Vec3>& move, Lengths lengths,
                                const std::vector<Vec3>& x, const SearchOptions& options) const {
  const auto within = [&](double enough) {
    return lengths.mean <= enough && lengths.longest <= longest_enough * enough;
  };
  if (within(options.tolerance)) return true;
  const double enough = good_enough * options.tolerance;
  if (iteration < options.few || lengths.mean > enough || stretch_of(move, x) > stretch_enough) return false;
  const bool by_mean_alone = iteration == options.most && options.few < options.most;
  return by_mean_alone || within(enough);
}

/// Inertia, weight, what is given, and the air.
void StepSearch::add_stage(const std::vector<Vec3>& x, Answer& answer) const {
  const Stage& stage = *stage_;
  const Particles& particles = cloth_.particles;
  const double c = loads_.air_drag;
  for (std::size_t i = 0; i < x.size(); ++i) {
    if (!(particles.inv_mass[i] > 0)) {
      answer.net[i].setZero();
      continue;
    }
    const double m = particles.mass[i];
    const Vec3 d = x[i] - stage.y[i];
    Vec3 wind = stage.p * x[i] + stage.q[i], load = m * loads_.gravity;
    if (!given_->air.empty()) wind -= given_->air[i];
    if (!given_->force.empty()) load += given_->force[i];
    answer.net[i] += load - (m * stage.s) * d - (c * m) * wind;
    const double kinetic = m * (0.5 * stage.s * d.squaredNorm() + 0.5 * c / stage.p * wind.squaredNorm());
    answer.energy += kinetic - load.dot(d);
    answer.terms += kinetic + std::abs(load.dot(d));
  }
}

void StepSearch::add_contact(const std::vector<Vec3>& x, Answer& answer) {
  answer.net = answer.pull;
  answer.energy = answer.elements;
  for (const Contact& c : contacts_) {
    const WorkClock::Within part(clock_, c.part);
    answer.energy += c.term->energy();
    c.term->add_forces(answer.net);
  }
  answer.terms = std::abs(answer.energy);
  add_stage(x, answer);
}

StepSearch::Answer StepSearch::look(const std::vector<Vec3>& x) {
  Answer answer;
  answer.pull.resize(x.size());
  {
    const WorkClock::Within elements(clock_, WorkPart::elements);
    answer.elements = elements_(x, answer.pull, pool_);
  }
  ++work_.force_evaluations;
  for (const Contact& c : contacts_) {
    const WorkClock::Within part(clock_, c.part);
    c.term->look(x, cloth_.particles.inv_mass, &pool_);
  }
  met_ = met_ || (contact_ && contact_->touching() > 0);
  add_contact(x, answer);
  return answer;
}

void StepSearch::couple(FreeStiffness::Pairs pairs, FreeStiffness::Pairs ordered_for) {
  if (pairs.empty()) return;
  stiffness_.order_for(std::move(ordered_for));
  couple(std::move(pairs));
}

void StepSearch::couple(FreeStiffness::Pairs pairs) {
  coupled_ = std::move(pairs);
  factored_ = 0;
  stiffness_.couple(coupled_);
}

/// What is coupled stays so until it is several times what must be.
void StepSearch::couple_pairs() {
  FreeStiffness::Pairs needed = pairs_->couples();
  const auto there = [this](const std::array<int, 2>& pair) { return stiffness_.couples(pair[0], pair[1]); };
  if (std::all_of(needed.begin(), needed.end(), there)) return;
  if (coupled_.size() < most_coupled * needed.size()) {
    FreeStiffness::Pairs both;
    std::set_union(needed.begin(), needed.end(), coupled_.begin(), coupled_.end(), std::back_inserter(both));
    needed = std::move(both);
  }
  couple(std::move(needed));
}

/// Of the place that was looked at last.
void StepSearch::assemble(const std::vector<Vec3>& x, SlipStiffness of_slip) {
  const WorkClock::Within assembly(clock_, WorkPart::assembly);
  const Particles& p = cloth_.particles;
  if (pairs_) couple_pairs();
  elements_.assemble(stiffness_, x, pool_);
  for (std::size_t k = contacts_.size(); k-- > 0;) contacts_[k].term->add_stiffness(stiffness_, of_slip);
  const double factor = inertia_of(*stage_);
  for (std::size_t i = 0; i < p.size(); ++i)
    if (p.inv_mass[i] > 0) stiffness_.add(int(i), p.mass[i] * factor * Mat3::Identity());
}

/// Drag's share is in it [1/s^2].
double StepSearch::inertia_of(const Stage& stage) const { return stage.s + loads_.air_drag * stage.p; }

/// What is pushed no more, by the body or by cloth, would stay where it is, as if it still were.
bool StepSearch::kept_factors_serve() const {
  return factored_ == inertia_of(*stage_) && factored_pushed_ && factored_pushed_ == pushed();
}

/// None: factors with what is pushed now serve no other search.
std::optional<std::vector<int>> StepSearch::pushed() const {
  std::vector<int> all;
  for (const Contact& c : contacts_) {
    const std::optional<std::vector<int>> own = c.term->pushed();
    if (!own) return std::nullopt;
    all.insert(all.end(), own->begin(), own->end());
  }
  return all;
}

void StepSearch::factorise(const std::vector<Vec3>& x, SlipStiffness of_slip) {
  throw_if_cancelled("implicit step");
  assemble(x, of_slip);
  const WorkClock::Within factorisation(clock_, WorkPart::factorisation);
  ++work_.factorisations;
  secant_ = of_slip == SlipStiffness::secant;
  single_ = stiffness_.factorise_single(&pool_);
  // What is positive semidefinite and a mass beside it fails where numbers are not finite: the run is seen to
  // have diverged.
  if (!single_) stiffness_.factorise_definite(0, &pool_);
  factored_ = inertia_of(*stage_);
  factored_pushed_ = pushed();
}

/// With factors of single precision what is left is looked at, and where it is too much they solve for it,
/// too, or give way to those of double precision.
std::vector<Vec3> StepSearch::solve(std::vector<Vec3> net) {
  const WorkClock::Within solve_part(clock_, WorkPart::solve);
  ++work_.linear_solves;
  if (single_ && stiffness_.solve_within(single_residual, net, &pool_)) return net;
  if (single_) stiffness_.factorise_definite(0, &pool_);
  single_ = false;
  stiffness_.solve(net, &pool_);
  return net;
}

/// Makes a share of a move; 0: none lowers the energy, and x is as it was. `here` is of x at the end.
StepSearch::Way StepSearch::advance(const std::vector<Vec3>& move, std::vector<Vec3>& x, Answer& here) {
  const double slope = -dot(here.net, move);
  const double longest = longest_length(move);
  double most = std::numeric_limits<double>::infinity();
  for (const Contact& c : contacts_) most = std::min(most, c.term->longest_move());
  double share = longest > most ? most / longest : 1;
  if (!(slope < 0) || !std::isfinite(longest)) return {0, false, false};
  const double open = share;
  for (const Contact& c : contacts_) {
    const WorkClock::Within part(clock_, c.part);
    share = c.term->safe_share(x, move, share, &pool_);
  }
  const bool cut = share < 0.5 * open;
  const double wanted = share;
  for (const double least = least_move_share * share; share > least;) {
    std::vector<Vec3> trial = moved(x, share, move);
    Answer there = look(trial);
    const double rise = there.energy - here.energy;
    if (rise <= armijo * share * slope + energy_rounding * here.terms) {
      const bool room = share < wanted && make_room(x, moved(x, wanted, move));
      x = std::move(trial);
      here = room ? look(x) : std::move(there);
      return {share, cut, room};
    }
    if (share == wanted && contact_)
      if (auto landed = land(x, trial); landed && landed->energy - here.energy <= armijo * share * slope) {
        x = std::move(trial);
        here = *std::move(landed);
        return {0.5 * share, cut, false};
      }
    share = least_of_parabola(share, slope, rise);
  }
  const bool room = make_room(x, moved(x, wanted, move));
  here = look(x);
  return {0, cut, room};
}

/// Where a move ends if each particle goes on only to where the body begins to push it: none, if all do.
std::optional<StepSearch::Answer> StepSearch::land(const std::vector<Vec3>& from, std::vector<Vec3>& to) {
  if (!contact_->cut_ways(from, cloth_.particles.inv_mass, to, pool_)) return std::nullopt;
  if (pairs_ && pairs_->safe_share(from, moved(to, -1, from), 1, &pool_) < 1) return std::nullopt;
  return look(to);
}

/// For what the body pushes from two sides. Whether there is such.
bool StepSearch::make_room(const std::vector<Vec3>& from, const std::vector<Vec3>& to) {
  if (!contact_) return false;
  const WorkClock::Within contact_part(clock_, WorkPart::contact);
  return contact_->make_room(from, to, cloth_.particles.inv_mass) > 0;
}

bool StepSearch::rubs() const {
  return std::any_of(contacts_.begin(), contacts_.end(), [](const Contact& c) { return c.term->rubs(); });
}

/// What has come to touch has friction, too. Whether the body has such, with limits of a push that is not
/// solved for yet.
bool StepSearch::hold_new(const StageStart& start, const std::vector<Vec3>& x) {
  bool found = false;
  for (const Contact& c : contacts_) found = c.term->hold_new(start, x) || found;
  return found;
}

SearchEnd StepSearch::find(const Stage& stage, const StepLoads& given, const StageStart& start,
                           const SearchOptions& options, std::vector<Vec3>& x) {
  stage_ = &stage;
  given_ = &given;
  if (pairs_) pairs_->forget_cuts();
  met_ = false;
  found_ = look(x);
  const SearchEnd end = descend(start, options, x, found_);
  if (end.converged && met_) follow_friction(start, options, x, found_);
  return end;
}

/// How many times as far as their moves the factors' particles may have to go: the secant holds them back.
double StepSearch::friction_bias() const {
  return secant_ ? 1 + contact_->held_back(cloth_.particles.mass, inertia_of(*stage_)) : 1;
}

/// Round by round, limits become those of the push as it is. What the factors at hand say of another round is
/// enough to end; where the cloth lies or slides as before, that is at once.
void StepSearch::follow_friction(const StageStart& start, const SearchOptions& options, std::vector<Vec3>& x,
                                 Answer& here) {
  for (int round = 0; round < most_rounds; ++round) {
    contact_->relimit();
    hold_new(start, x);
    add_contact(x, here);
    if (friction_bias() * mean_length(solve(here.net)) <= followed * options.tolerance) return;
    factorise(x, SlipStiffness::none);
    ++work_.iterations;
    const Way way = advance(solve(here.net), x, here);
    if (way.cut || way.share == 0) return;
  }
}

/// Those of a whole move of this mean and longest length: where a few particles are far off, theirs are
/// wrong.
bool StepSearch::factors_go_on_serving(int iteration, Lengths lengths, const SearchOptions& options) const {
  const double brief = short_move * options.tolerance;
  if (lengths.mean > brief || (options.careful && lengths.longest > longest_enough * brief)) return false;
  return !options.keep_factors || iteration % most_with_kept != 0;
}

/// `here` is of x, before and after.
SearchEnd StepSearch::descend(const StageStart& start, const SearchOptions& options, std::vector<Vec3>& x,
                              Answer& here) {
  bool kept = options.keep_factors && kept_factors_serve();
  bool relimit = rubs();
  double share = 1;
  for (int iteration = 1; iteration <= options.most; ++iteration) {
    const bool by_secant = options.careful && (iteration == 1 || share < 1);
    const SlipStiffness of_slip = by_secant ? SlipStiffness::secant : SlipStiffness::none;
    if (!kept) factorise(x, of_slip);
    std::vector<Vec3> move = solve(here.net);
    if (kept && iteration == 1 && mean_length(move) > short_move * options.tolerance) {
      kept = false;
      factorise(x, of_slip);
      move = solve(here.net);
    }
    ++work_.iterations;
    if (relimit) {
      for (const Contact& c : contacts_) c.term->expect(move, iteration > 1);
      add_contact(x, here);
      move = solve(here.net);
    }
    const Lengths lengths{mean_length(move), longest_length(move)};
    const Way way = advance(move, x, here);
    share = way.share;
    relimit = false;
    if (iteration == 1 && rubs()) {
      relimit = hold_new(start, x) && options.careful;
      add_contact(x, here);
    }
    if (!way.cut && is_good_enough(iteration, move, lengths, x, options)) return {true, iteration};
    const bool at_rounding = std::abs(dot(here.net, move)) <= least_fall * here.terms;
    if (way.share == 0 && !kept && !way.cut && !way.room) return {at_rounding, iteration};
    kept = way.share == 1 && factors_go_on_serving(iteration, lengths, options);
  }
  return {false, options.most};
}

}  // namespace furrow::physics
