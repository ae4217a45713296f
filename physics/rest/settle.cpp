// SPDX-License-Identifier: MIT
#include "physics/rest/settle.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <stdexcept>
#include <string>

#include "physics/base/check_particles.h"
#include "physics/base/vector_sums.h"
#include "physics/cloth/element_forces.h"
#include "physics/contact/anchored_contact.h"
#include "physics/contact/residual_force.h"
#include "physics/linear/free_stiffness.h"
#include "physics/rest/limited_memory.h"

namespace furrow::physics {
namespace {

using Vectors = std::vector<Vec3>;

constexpr double least_depth = 1e-7;  // m

constexpr double contact_share = 0.5;     // of the mean stiffness of a particle
constexpr double first_time = 0.03;       // tau [s]
constexpr double least_share = 1.0 / 32;  // of a step
constexpr double least_clamp = 0.02;      // once the Hessian alone would not do
constexpr double relax_clamp = 0.7;       // after a success
constexpr double far_from_rest = 1e4;     // residual above which one step is all that a factorisation is for
constexpr double stiffer = 10;            // a contact's next depth, that many times less
constexpr int most_followers = 15;        // steps with one factorisation, after the first
constexpr double follow_until = 1e-2;     // share of the first one's expected fall of energy

void check(const Cloth& cloth, const SettleOptions& o) {
  const auto need = [](bool good, const char* name, double value, const char* range) {
    if (good && std::isfinite(value)) return;
    throw std::invalid_argument(std::string("settle: ") + name + " = " + std::to_string(value) + " is not " +
                                range);
  };
  for (const double g : o.gravity) need(true, "gravity", g, "finite");
  need(o.friction >= 0, "friction", o.friction, ">= 0");
  need(o.gap > 0, "gap", o.gap, "> 0");
  need(o.contact_depth >= least_depth, "contact_depth", std::min(o.contact_depth, 1e300), ">= 1e-7");
  need(o.tolerance > 0, "tolerance", o.tolerance, "> 0");
  need(o.max_iterations >= 0, "max_iterations", o.max_iterations, ">= 0");
  need(o.longest_move > 0, "longest_move", o.longest_move, "> 0");
  need(o.threads >= 1, "threads", o.threads, ">= 1");
  check_particles(cloth.particles, "settle");
}

class Settler {
 public:
  Settler(Cloth& cloth, const Collider* collider, const SettleOptions& options)
      : cloth_(cloth),
        p_(cloth.particles),
        collider_(collider),
        o_(options),
        elements_(cloth),
        stiffness_(cloth),
        pool_(options.threads),
        memory_([this](std::span<Vec3> f) { stiffness_.solve(f, &pool_); }, most_followers) {
    stiffness_.assemble(cloth, p_.x, Stiffness::positive_part);
    if (!collider) return;
    const double k = contact_share * stiffness_.mean_diagonal();
    contact_ = std::make_unique<AnchoredContact>(
        *collider, AnchoredContactOptions{o_.friction, o_.gap, k > 0 ? k : 1}, p_.size());
  }

  SettleReport run(const SettleObserver& observer) {
    look(p_.x);
    if (contact_) contact_->move_anchors();
    for (;; ++report_.iterations) {
      find_net();
      report_.residual = residual_of(elastic_, p_, o_.gravity, collider_, o_.friction, o_.gap);
      const bool rests = report_.residual <= o_.tolerance;
      report_.converged = rests && !(contact_ && contact_->deepest() > o_.contact_depth);
      report_.stopped = observer && !observer({report_.iterations, report_.residual});
      if (report_.converged || report_.stopped || report_.iterations == o_.max_iterations) break;
      rests ? stiffen() : step();
    }
    if (contact_) {
      report_.touching = contact_->touching();
      report_.deepest = contact_->deepest();
    }
    return report_;
  }

 private:
  /// Asks elements and body what they do at x.
  void look(const Vectors& x) {
    elastic_.resize(x.size());
    at_ = elements_(x, elastic_, pool_);
    for (std::size_t i = 0; i < x.size(); ++i)
      if (p_.inv_mass[i] > 0) at_ -= p_.mass[i] * o_.gravity.dot(x[i]);
    if (contact_) contact_->look(x, p_.inv_mass, &pool_);
  }

  double energy() const { return contact_ ? at_ + contact_->energy() : at_; }

  void find_net() {
    net_ = elastic_;
    if (contact_) contact_->add_forces(net_);
    for (std::size_t i = 0; i < net_.size(); ++i) {
      if (p_.inv_mass[i] > 0)
        net_[i] += p_.mass[i] * o_.gravity;
      else
        net_[i].setZero();
    }
  }

  void stiffen() {
    contact_->stiffen(stiffer, p_.x);
    look(p_.x);
    contact_->move_anchors();
    tau_ = first_time;
  }

  /// Clamps the Hessian until it is positive definite.
  bool factorise() {
    memory_.clear();
    for (int failures = 0;; ++failures) {
      stiffness_.assemble(cloth_, p_.x, {clamp_}, &pool_);
      if (contact_) contact_->add_stiffness(stiffness_);
      for (std::size_t i = 0; i < p_.size(); ++i)
        if (p_.inv_mass[i] > 0) stiffness_.add(int(i), p_.mass[i] / (tau_ * tau_) * Mat3::Identity());
      ++report_.factorisations;
      if (stiffness_.factorise_definite(0, &pool_)) {
        clamped_ = clamp_;
        if (failures == 0) clamp_ = clamp_ < least_clamp / 2 ? 0 : relax_clamp * clamp_;
        return true;
      }
      if (clamp_ == 1) return false;
      clamp_ = failures == 3 ? 1 : std::min(1.0, std::max(least_clamp, 2 * clamp_));
    }
  }

  void find_move() {
    move_ = net_;
    memory_.apply(move_);
    double longest = 0;
    for (const Vec3& m : move_) longest = std::max(longest, m.norm());
    first_ = longest > o_.longest_move ? o_.longest_move / longest : 1;
  }

  /// The longest share of the move, from first_ halved, that lowers the energy; trial_ is there, and all has
  /// looked there. 0: none, and all has looked where it was.
  double search() {
    const double before = energy(), slope = -dot(net_, move_);
    if (!(slope < 0)) return 0;
    for (double share = first_; share > least_share * first_; share *= 0.5) {
      trial_ = moved(share);
      look(trial_);
      if (energy() <= before + 1e-4 * share * slope + 1e-13 * std::abs(before)) return share;
    }
    look(p_.x);
    return 0;
  }

  Vectors moved(double share) const {
    Vectors x = p_.x;
    add_multiple(x, share, move_);
    return x;
  }

  void step() {
    if (!factorise()) {
      tau_ *= 0.25;
      return;
    }
    find_move();
    if (contact_ && report_.residual < far_from_rest) {
      contact_->expect(move_);
      find_net();
      find_move();
    }
    const double share = search();
    const bool refused = share < first_;
    if (contact_ && refused) contact_->make_room(p_.x, moved(first_), p_.inv_mass);
    if (share > 0) p_.x = trial_;
    if (contact_ && refused) contact_->look(p_.x, p_.inv_mass, &pool_);  // as there is room now
    if (share == 0) {
      if (contact_) contact_->expect(Vectors(p_.size(), Vec3::Zero()));  // limits of where it stayed
      tau_ *= 0.25;
      clamp_ = std::min(1.0, 2 * clamped_ + least_clamp);
      return;
    }
    if (share == 1) tau_ *= 4;
    if (refused) {
      tau_ *= 0.9;
      clamp_ = std::min(1.0, 1.5 * clamped_ + least_clamp / 2);
    }
    if (report_.residual < far_from_rest) follow();
    if (contact_) contact_->move_anchors();
  }

  /// Goes on with the same factors and what the steps with them show, as long as that pays.
  void follow() {
    find_net();
    double most = 0;
    for (int k = 0; k < most_followers; ++k) {
      find_move();
      const double fall = dot(net_, move_);
      most = std::max(most, fall);
      if (fall < follow_until * most) return;
      const double share = search();
      if (share == 0) return;
      p_.x = trial_;
      ++report_.followers;
      Vectors way = move_, change = net_;
      for (Vec3& m : way) m *= share;
      find_net();
      add_multiple(change, -1, net_);
      memory_.add(std::move(way), std::move(change));
    }
  }

  Cloth& cloth_;
  Particles& p_;
  const Collider* collider_;
  const SettleOptions& o_;
  ElementForces elements_;
  FreeStiffness stiffness_;
  ThreadPool pool_;
  std::unique_ptr<AnchoredContact> contact_;
  LimitedMemory memory_;
  double tau_ = first_time, clamp_ = 1, clamped_ = 1;  // clamped_: of the last factorisation
  double at_ = 0;                                      // energy but contact's, where all looked last [J]
  double first_ = 1;                                   // share of a move that search() begins with
  Vectors elastic_, net_, move_, trial_;
  SettleReport report_;
};

}  // namespace

SettleReport settle(Cloth& cloth, const Collider* collider, const SettleOptions& options,
                    const SettleObserver& observer) {
  check(cloth, options);
  const SettleReport report = Settler(cloth, collider, options).run(observer);
  for (Vec3& v : cloth.particles.v) v.setZero();
  return report;
}

}  // namespace furrow::physics
