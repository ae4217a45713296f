// SPDX-License-Identifier: MIT
#include "physics/motion/step_search.h"

#include <algorithm>
#include <cmath>

#include "physics/base/cancel_scope.h"
#include "physics/base/vector_sums.h"

namespace furrow::physics {
namespace {

using Vectors = std::vector<Vec3>;

constexpr double good_enough = 20;  // times the tolerance, after few iterations
constexpr double short_move = 10;   // times the tolerance: the factors serve the next one
constexpr double armijo = 1e-4;
constexpr double least_move_share = 1e-3;  // of a move
constexpr double least_fall = 1e-12;       // of the energy, that can be told from rounding
constexpr double energy_rounding = 1e-13;

/// Where the parabola through the energy, its slope and the energy at `share` is least.
double least_of_parabola(double share, double slope, double rise) {
  const double curvature = rise - slope * share;
  if (!(curvature > 0)) return 0.5 * share;
  return std::clamp(-0.5 * slope * share * share / curvature, 0.05 * share, 0.5 * share);
}

}  // namespace

StepSearch::StepSearch(const Cloth& cloth, const Loads& loads, StepContact* contact, ThreadPool& pool,
                       WorkCounts& work)
    : cloth_(cloth),
      loads_(loads),
      contact_(contact),
      pool_(pool),
      work_(work),
      elements_(cloth),
      stiffness_(cloth) {
  const Particles& p = cloth.particles;
  for (std::size_t i = 0; i < p.size(); ++i)
    if (p.inv_mass[i] > 0) mass_ += p.mass[i];
}

double StepSearch::contact_stiffness(std::span<const Vec3> x) {
  stiffness_.assemble(cloth_, x, Stiffness::positive_part, &pool_);
  const double k = 0.5 * stiffness_.mean_diagonal();
  return k > 0 ? k : 1;
}

double StepSearch::mean_mass() const {
  const int n = stiffness_.free_particles();
  return n > 0 ? mass_ / n : 0;
}

/// Root of the mean square by mass [m].
double StepSearch::mean_length(const Vectors& move) const {
  const Particles& p = cloth_.particles;
  double sum = 0;
  for (std::size_t i = 0; i < move.size(); ++i)
    if (p.inv_mass[i] > 0) sum += p.mass[i] * move[i].squaredNorm();
  return mass_ > 0 ? std::sqrt(sum / mass_) : 0;
}

/// Inertia, weight, what is given, and the air.
void StepSearch::add_stage(const Vectors& x, Answer& answer) const {
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

StepSearch::Answer StepSearch::look(const Vectors& x) {
  Answer answer{Vectors(x.size()), 0, 0};
  answer.energy = elements_(x, answer.net, pool_);
  ++work_.force_evaluations;
  if (contact_) {
    AnchoredContact& contact = contact_->anchored();
    contact.look(x, cloth_.particles.inv_mass, &pool_);
    answer.energy += contact.energy();
    contact.add_forces(answer.net);
  }
  answer.terms = std::abs(answer.energy);
  add_stage(x, answer);
  return answer;
}

/// Of the place that was looked at last.
void StepSearch::factorise(const Vectors& x) {
  throw_if_cancelled("implicit step");
  const Particles& p = cloth_.particles;
  stiffness_.assemble(cloth_, x, Stiffness::positive_part, &pool_);
  if (contact_) contact_->anchored().add_stiffness(stiffness_);
  const double factor = stage_->s + loads_.air_drag * stage_->p;
  for (std::size_t i = 0; i < p.size(); ++i)
    if (p.inv_mass[i] > 0) stiffness_.add(int(i), p.mass[i] * factor * Mat3::Identity());
  ++work_.factorisations;
  // What is positive semidefinite and a mass beside it fails where numbers are not finite: the run is seen to
  // have diverged.
  stiffness_.factorise_definite(0, &pool_);
}

/// The share of a move that was made; 0: none lowers the energy, and `here` is as it was.
double StepSearch::advance(const Vectors& move, Vectors& x, Answer& here, const SearchOptions& options) {
  const double slope = -dot(here.net, move);
  double longest = 0;
  for (const Vec3& m : move) longest = std::max(longest, m.norm());
  double share = longest > options.longest_move ? options.longest_move / longest : 1;
  if (!(slope < 0) || !std::isfinite(longest)) return 0;
  for (const double least = least_move_share * share; share > least;) {
    Vectors trial = x;
    add_multiple(trial, share, move);
    Answer there = look(trial);
    const double rise = there.energy - here.energy;
    if (rise <= armijo * share * slope + energy_rounding * here.terms) {
      x = std::move(trial);
      here = std::move(there);
      return share;
    }
    share = least_of_parabola(share, slope, rise);
  }
  look(x);
  return 0;
}

SearchEnd StepSearch::find(const Stage& stage, const StepLoads& given, std::span<const Vec3> start,
                           const SearchOptions& options, Vectors& x) {
  stage_ = &stage;
  given_ = &given;
  Answer here = look(x);
  bool keep_factors = false;
  for (int iteration = 1; iteration <= options.most; ++iteration) {
    if (!keep_factors) factorise(x);
    Vectors move = here.net;
    stiffness_.solve(move, &pool_);
    ++work_.linear_solves;
    ++work_.iterations;
    if (contact_ && iteration == 1) {  // friction as of the push to come: once, as it changes the energy
      contact_->anchored().expect(move);
      here = look(x);
      move = here.net;
      stiffness_.solve(move, &pool_);
    }
    const double length = mean_length(move);
    const double share = advance(move, x, here, options);
    if (contact_ && iteration == 1) {
      contact_->anchored().hold_new(start);
      here = look(x);
    }
    const double enough = iteration >= options.few ? good_enough : 1;
    if (length <= enough * options.tolerance) return {true, iteration};
    const bool at_rounding = std::abs(dot(here.net, move)) <= least_fall * here.terms;
    if (share == 0 && !keep_factors) return {at_rounding, iteration};
    keep_factors = share == 1 && length <= short_move * options.tolerance;
  }
  return {false, options.most};
}

}  // namespace furrow::physics
