// SPDX-License-Identifier: MIT
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <optional>

#include "physics/base/require.h"
#include "physics/base/thread_pool.h"
#include "physics/body/collider.h"
#include "physics/cloth/check_cloth.h"
#include "physics/cloth/elements.h"
#include "physics/cloth/tension_forces.h"
#include "physics/contact/contact.h"
#include "physics/contact/residual_force.h"
#include "physics/linear/stable_step.h"
#include "physics/pairs/pair_pushes.h"
#include "physics/rest/settle.h"

namespace furrow::physics {
namespace {

using Vectors = std::vector<Vec3>;

constexpr double too_far = 100;      // extents
constexpr double least_fall = 1e-3;  // of the residual from quarter to quarter, or it does not fall
constexpr double came_back = 0.1;    // of its path: a net way below
constexpr int most_pass_sweeps = 16;
constexpr int widening_passes = 64;      // between two changes of what pairs may do
constexpr double recovered_share = 0.1;  // of what is missing between layers, in a pass
constexpr double near_enough = 0.02;     // of a range, that may be missing at rest

double strength(const Vec3& gravity) { return gravity.norm() > 0 ? gravity.norm() : standard_gravity; }

void check(const Cloth& cloth, const DisplaceOptions& o) {
  constexpr const char* me = "displace_by_force";
  for (const double g : o.gravity) require(me, "gravity", g, true, "finite");
  require(me, "friction", o.friction, o.friction >= 0, ">= 0");
  require(me, "gap", o.gap, o.gap > 0, "> 0");
  require(me, "tolerance", o.tolerance, o.tolerance > 0, "> 0");
  require(me, "max_passes", o.max_passes, o.max_passes >= 0, ">= 0");
  require(me, "rate", o.rate, o.rate >= 0, ">= 0");
  if (o.cap) {
    require(me, "limit", o.limit, o.limit > 0, "> 0");
    require(me, "replacement", o.replacement, o.replacement > 0 && o.replacement <= o.limit, "in (0, limit]");
  }
  require(me, "threads", o.threads, o.threads >= 1, ">= 1");
  check_cloth(cloth, me);
}

/// Of the free particles [N]; 0 if there are none.
struct Weights {
  double sum = 0, mean = 0, largest = 0;
  Weights(const Particles& p, const Vec3& gravity) {
    int count = 0;
    for (const double w : p.inv_mass) {
      if (w == 0) continue;
      const double weight = strength(gravity) / w;
      sum += weight;
      largest = std::max(largest, weight);
      ++count;
    }
    if (count > 0) mean = sum / count;
  }
};

double distance(const Vectors& a, const Vectors& b) {
  double square = 0;
  for (std::size_t i = 0; i < a.size(); ++i) square += (a[i] - b[i]).squaredNorm();
  return std::sqrt(square);
}

/// The last two quarters of all passes: whether the cloth goes round and round.
class Recurrence {
 public:
  explicit Recurrence(int max_passes) : quarter_(max_passes / 4), max_(max_passes) {}

  /// A pass took the particles from `before`, where the residual was so, to x.
  void note(int pass, double residual, const Vectors& before, const Vectors& x) {
    if (pass < max_ - 2 * quarter_) return;
    if (pass < max_ - quarter_) {
      third_ += residual;
      return;
    }
    if (start_.empty()) start_ = before;
    fourth_ += residual;
    path_ += distance(before, x);
  }

  bool found(const Vectors& x) const {
    if (start_.empty() || fourth_ < (1 - least_fall) * third_) return false;
    return distance(start_, x) < came_back * path_;
  }

 private:
  int quarter_, max_;
  double third_ = 0, fourth_ = 0, path_ = 0;  // sums of residuals; way of the last quarter [m]
  Vectors start_;                             // of the last quarter
};

/// Contact of the cloth with itself, pass by pass.
class OwnContact {
 public:
  OwnContact(const Cloth& cloth, const SelfContact& o, int threads)
      : pool_(threads), pushes_(cloth, cloth.particles.x, options_of(o), &pool_) {
    for (const double w : cloth.particles.inv_mass) mobility_.push_back(w > 0 ? 1 : 0);
  }

  /// Before a pass from x: adds what pairs push and rub each other with. rate: way per force [m/N]; > 0.
  void begin_pass(int pass, const Vectors& x, double rate, Vectors& force) {
    if (pass % widening_passes == 0) grows_ = pushes_.contact().widen(x);
    pushes_.add_reactions(x, mobility_, 1 / rate, force);
  }

  /// A pass led from `before` to x: keeps layers apart. meet_body(particles) keeps those out of the body.
  template <class MeetBody>
  void end_pass(const Vectors& before, Vectors& x, const MeetBody& meet_body) {
    again_ = false;
    missing_ = 0;
    last_cut_ = 0;
    if (!pushes_.begin_step(before, x, &pool_)) return;
    for (int sweep = 0; sweep < most_pass_sweeps; ++sweep) {
      again_ = pushes_.sweep(x, mobility_);
      meet_body(pushes_.touched());
      if (!again_) break;
    }
    missing_ = pushes_.recover(x, mobility_, recovered_share);
    last_cut_ = int(pushes_.guard(x, mobility_, &pool_).size());
    acted_ = acted_ || !pushes_.touched().empty() || last_cut_ > 0;
    cut_moves_ += last_cut_;
    cut_passes_ += last_cut_ > 0;
  }

  /// Whether what the last pass did are forces that hold, and nothing else.
  bool holds() const { return !grows_ && !again_ && last_cut_ == 0 && missing_ <= near_enough; }

  SelfContactReport report(const Vectors& x) const {
    const PairPushes::Touching touching = pushes_.touching(x);
    SelfContactReport self;
    self.acted = acted_ || pushes_.contact().has_acted();
    self.pairs = touching.pairs;
    if (self.pairs > 0) self.nearest = touching.nearest;
    self.sliding = touching.sliding;
    self.cut_searches = cut_passes_;
    self.cut_moves = cut_moves_;
    self.list_builds = pushes_.contact().list_builds();
    self.crossed_at_start = pushes_.contact().crossed_at_start();
    self.exempt = pushes_.contact().exempt();
    return self;
  }

 private:
  static PairPushOptions options_of(const SelfContact& o) {
    return {o.thickness, o.friction, o.thicknesses, o.groups, o.drawn, true};
  }

  ThreadPool pool_;
  PairPushes pushes_;
  std::vector<double> mobility_;
  bool grows_ = false, again_ = false, acted_ = false;
  double missing_ = 0;  // of a range
  int last_cut_ = 0, cut_passes_ = 0;
  long long cut_moves_ = 0;
};

class Displacer {
 public:
  Displacer(Cloth& cloth, const Collider* collider, const DisplaceOptions& options)
      : cloth_(cloth),
        p_(cloth.particles),
        collider_(collider),
        o_(options),
        rate_(o_.rate > 0 ? o_.rate : displacement_rate(cloth_, o_.gravity, o_.gap)),
        weights_(p_, o_.gravity),
        moves_(p_.size(), Vec3::Zero()) {
    if (o_.self.on) own_.emplace(cloth, o_.self, o_.threads);
    Eigen::AlignedBox3d box;
    for (const Vec3& x : p_.x) box.extend(x);
    if (p_.size() == 0) return;
    centre_ = box.center();
    const double extent = box.diagonal().norm();
    reach_ = too_far * (extent > 0 ? extent : 1);
  }

  DisplaceReport run(const SettleObserver& observer) {
    DisplaceReport report;
    report.rate = rate_;
    Recurrence recurrence(o_.max_passes);
    bool lost = false;
    for (;; ++report.passes) {
      report.residual = find_forces(report.passes, lost);
      const bool converged = report.residual <= o_.tolerance && !lost && (!own_ || own_->holds());
      const bool stopped = observer && !observer({report.passes, report.residual});
      const bool last = report.passes == o_.max_passes;
      if (lost || converged || stopped || last) {
        report.outcome = lost                     ? DisplaceOutcome::diverged
                         : converged              ? DisplaceOutcome::converged
                         : stopped                ? DisplaceOutcome::stopped
                         : recurrence.found(p_.x) ? DisplaceOutcome::limit_cycle
                                                  : DisplaceOutcome::unfinished;
        break;
      }
      report.capped += find_moves();
      before_ = p_.x;
      lost = !displace();
      recurrence.note(report.passes, report.residual, before_, p_.x);
    }
    report.touching = collider_ ? count_contacts(p_.x, *collider_, o_.gap) : 0;
    if (own_) report.self = own_->report(p_.x);
    return report;
  }

 private:
  /// Fills force_. Returns the residual [-].
  double find_forces(int pass, bool lost) {
    force_.assign(p_.size(), Vec3::Zero());
    add_forces(cloth_, p_.x, force_);
    if (own_ && rate_ > 0 && !lost) own_->begin_pass(pass, p_.x, rate_, force_);
    return residual_of(force_, p_, o_.gravity, collider_, o_.friction, o_.gap);
  }

  /// Fills moves_. Returns how many forces were replaced.
  long long find_moves() {
    long long capped = 0;
    for (std::size_t i = 0; i < p_.size(); ++i) {
      if (p_.inv_mass[i] == 0) continue;
      Vec3 f = force_[i] + o_.gravity / p_.inv_mass[i];
      const double size = f.norm();
      if (o_.cap && size > o_.limit * weights_.mean) {
        f *= o_.replacement * weights_.mean / size;
        ++capped;
      }
      moves_[i] = rate_ * f;
    }
    return capped;
  }

  /// false: it diverged.
  bool displace() {
    bool good = true;
    for (std::size_t i = 0; i < p_.size(); ++i) {
      p_.x[i] += moves_[i];
      if (p_.inv_mass[i] > 0) good = good && (p_.x[i] - centre_).norm() <= reach_;  // false for NaN
    }
    if (!good) return false;
    if (collider_) {
      touching_.clear();
      for (std::size_t i = 0; i < p_.size(); ++i)
        if (p_.inv_mass[i] > 0) rub(i, moves_[i]);
      push_out(p_.x, touching_, *collider_, o_.gap);
    }
    if (own_) own_->end_pass(before_, p_.x, [this](const std::vector<int>& moved) { meet_body(moved); });
    return true;
  }

  /// Of particles that cloth moved, towards the body maybe.
  void meet_body(const std::vector<int>& moved) {
    if (!collider_) return;
    touching_.clear();
    for (const int v : moved) {
      const auto i = std::size_t(v);
      if (p_.inv_mass[i] > 0) rub(i, p_.x[i] - before_[i]);
    }
    push_out(p_.x, touching_, *collider_, o_.gap);
  }

  /// What came too near has its way along the body shortened.
  void rub(std::size_t i, const Vec3& move) {
    const SignedDistance field = collider_->at(p_.x[i]);
    const double slope = field.gradient.norm();
    if (!(field.value < o_.gap) || !(slope > 0)) return;
    touching_.push_back(int(i));
    const Vec3 n = field.gradient / slope;
    const double into = -move.dot(n), pressed = std::min(into, (o_.gap - field.value) / slope);
    const Vec3 slip = move + into * n;
    const double way = slip.norm(), most = o_.friction * std::max(0.0, pressed);
    p_.x[i] -= way <= most ? slip : Vec3(most / way * slip);
  }

  Cloth& cloth_;
  Particles& p_;
  const Collider* collider_;
  const DisplaceOptions& o_;
  double rate_;  // [m/N]
  Weights weights_;
  std::optional<OwnContact> own_;
  Vec3 centre_ = Vec3::Zero();
  double reach_ = 0;                // of particles from the centre [m]
  Vectors force_, moves_, before_;  // of a pass
  std::vector<int> touching_;
};

}  // namespace

double displacement_rate(const Cloth& cloth, const Vec3& gravity, double longest) {
  constexpr const char* me = "displacement_rate";
  for (const double g : gravity) require(me, "gravity", g, true, "finite");
  require(me, "longest", longest, longest > 0, "> 0");
  check_cloth(cloth, me);
  const Weights weights(cloth.particles, gravity);
  if (weights.sum == 0) return 0;
  Cloth unit = cloth;  // with masses 1 the eigenvalues are those of K
  for (double& w : unit.particles.inv_mass) w = w > 0 ? 1 : 0;
  for (Tension& t : unit.tension) {
    if (t.stretch == 0) continue;
    const double strain = remaining_strain(t.stretch, weights.sum / 2);
    t.stretch *= std::max(1.0, strain / tension_margin);  // with it the slope that the margin gives
  }
  const double omega = stable_step(unit).omega_max, most = longest / weights.largest;
  return omega > 0 ? std::min(most, 1 / (omega * omega)) : most;
}

DisplaceReport displace_by_force(Cloth& cloth, const Collider* collider, const DisplaceOptions& options,
                                 const SettleObserver& observer) {
  check(cloth, options);
  const DisplaceReport report = Displacer(cloth, collider, options).run(observer);
  for (Vec3& v : cloth.particles.v) v.setZero();
  return report;
}

}  // namespace furrow::physics
