// SPDX-License-Identifier: GPL-3.0-or-later
#include "jobs/move/judge.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <nlohmann/json.hpp>
#include <random>

#include "physics/base/cancel_scope.h"
#include "physics/linear/stable_step.h"

namespace furrow::jobs {
namespace {

constexpr double twin_offset = 1e-9;  // [m]
constexpr double chaos =
    0.01;  // of the error that is to be told, the tolerance: a twin that drifts farther is chaotic
constexpr double shortest = 1.0 / 30;                       // [s]
constexpr double clock_of_budget = 3, clock_at_least = 60;  // [-], [s]

/// Two digits, never above.
double rounded_down(double x) {
  const double places = 1 - std::floor(std::log10(x)), units = std::pow(10, std::abs(places));
  const double digits = std::floor((places > 0 ? x * units : x / units) * (1 + 1e-12));
  return places > 0 ? digits / units : digits * units;
}

class Judge {
 public:
  Judge(const SceneCloth& scene, const physics::World& world, const JudgeOptions& options,
        const Context& context)
      : scene_(scene),
        world_(world),
        context_(context),
        progress_(context.listener, "trying settings"),
        started_(std::chrono::steady_clock::now()),
        meter_(scene.file.mesh, scene.cloth, scene.options.gravity) {
    check(options);
    j_.options = options;
    j_.scene_seconds = scene.options.seconds;
    j_.ends_at_lines = scene.ends_at_lines;
    j_.size = meter_.size();
    j_.dt_limit = physics::stable_step(scene.cloth).dt_limit;
    if (!std::isfinite(j_.dt_limit))
      throw std::invalid_argument(
          "nothing in this cloth moves or resists, so there is no step limit to judge by; leave "
          "vertices free of pins, or raise the stiffness");
    try_scenes_own();
  }

  Judgement run() {
    list();
    fit_budget();
    run_candidate(0);
    run_twin();
    run_candidate(1);
    run_candidate(reference());
    for (std::size_t i = 2; i < reference(); ++i)
      if (j_.candidates[i].fate != Fate::too_dear) run_candidate(i);
    measure();
    choose();
    return std::move(j_);
  }

 private:
  std::size_t reference() const { return j_.candidates.size() - 1; }

  /// What the scene asks for and no run would do, such as a dt above the limit, is refused before the work.
  void try_scenes_own() const {
    physics::SimulateOptions o = scene_.options;
    o.seconds = 0;
    physics::Cloth cloth = scene_.cloth;
    physics::simulate(cloth, world_, o, nullptr);
  }

  void list() {
    for (Candidate& c : candidates_for(scene_, j_.dt_limit)) j_.candidates.push_back({std::move(c)});
    j_.candidates.push_back({reference_candidate(scene_, j_.dt_limit)});
    shapes_.resize(j_.candidates.size());
    for (JudgedCandidate& c : j_.candidates) c.cost = predicted_cost(c.candidate, scene_, 1);
    for (JudgedCandidate& c : j_.candidates)
      if (c.cost > j_.candidates.back().cost) c.fate = Fate::too_dear;
  }

  /// How long can be simulated for the budget.
  void fit_budget() {
    for (const JudgedCandidate& c : j_.candidates)
      if (c.fate != Fate::too_dear) rate_ += c.cost;
    rate_ += j_.candidates[0].cost;  // the twin
    j_.seconds = scene_.seconds;
    if (!(j_.seconds > 0))
      throw std::invalid_argument("the scene has no time to judge; give it `simulation.seconds=1`");
    if (rate_ * j_.seconds <= j_.options.budget) return;
    const double fits = j_.options.budget / rate_;
    if (fits < shortest)
      throw std::invalid_argument("`budget=" + Json(j_.options.budget).dump() + "`: judges only " +
                                  Json(fits).dump() + " s of this scene; raise it to " +
                                  Json(std::floor(rate_ * shortest) + 1).dump() + " or more");
    j_.seconds = rounded_down(fits);
    j_.shortened = true;
  }

  /// The cloth after the candidate's run; empty if it was broken off.
  Shape simulate(JudgedCandidate& c, physics::Cloth cloth) {
    if (j_.broken != Broken::no) return {};
    physics::SimulateOptions o = options_of(c.candidate, scene_, j_.seconds);
    o.observe_steps = physics::is_unconditionally_stable(o.integrator) ? 1 : 50;
    const physics::CancelScope cancelling([this] { return must_stop(); });
    const auto r = physics::simulate(cloth, world_, o, nullptr, [&](const physics::SimulateProgress& p) {
      progress_((spent_ + c.cost * p.time) / (rate_ * j_.seconds));
      return !must_stop();
    });
    spent_ += c.cost * j_.seconds;
    if (r.outcome == physics::Outcome::stopped_by_observer) return {};
    c.fate = r.outcome == physics::Outcome::diverged ? Fate::diverged : Fate::done;
    if (c.fate == Fate::done) c.cost = counted_cost(r, c.candidate, scene_) / j_.seconds;
    c.steps = r.steps;
    c.dt = r.dt;
    return meter_.shape_of(std::move(cloth));
  }

  bool must_stop() {
    using Seconds = std::chrono::duration<double>;
    const double clock = Seconds(std::chrono::steady_clock::now() - started_).count();
    if (context_.listener.cancelled())
      j_.broken = Broken::interrupted;
    else if (clock > clock_of_budget * j_.options.budget + clock_at_least)
      j_.broken = Broken::clock;
    return j_.broken != Broken::no;
  }

  void run_candidate(std::size_t i) { shapes_[i] = simulate(j_.candidates[i], scene_.cloth); }

  /// The cheapest explicit run again, begun a nanometre beside.
  void run_twin() {
    physics::Cloth cloth = scene_.cloth;
    std::mt19937 random(1);
    for (std::size_t i = 0; i < cloth.particles.size(); ++i)
      for (int k = 0; k < 3; ++k) {
        const double way = random() & 1 ? twin_offset : -twin_offset;
        if (cloth.particles.inv_mass[i] > 0) cloth.particles.x[i][k] += way;
      }
    JudgedCandidate twin = j_.candidates[0];
    const Shape shape = simulate(twin, std::move(cloth));
    if (shape.x.empty() || shapes_[0].x.empty()) return;
    twin_ = meter_.between(shape, shapes_[0]);
    j_.twin_drift = twin_.rms;
  }

  void measure() {
    if (j_.candidates.back().fate != Fate::done) return;
    for (std::size_t i = 0; i < reference(); ++i) {
      JudgedCandidate& c = j_.candidates[i];
      c.off = c.fate == Fate::done ? meter_.between(shapes_[i], shapes_.back()) : infinitely_far;
    }
    choose_error();
    for (JudgedCandidate& c : j_.candidates) c.error = error_of(c.off);
    j_.candidates.back().error = j_.reference_error = reference_error();
  }

  double error_of(const ShapeDistance& d) const {
    return std::max(j_.by_shape ? d.shape() : d.rms, d.energy);
  }

  void choose_error() {
    const double drift = chaos * j_.options.tolerance, halves = j_.candidates[1].off.rms;
    j_.by_shape = j_.twin_drift > drift || halves > j_.options.tolerance;
    j_.why = "positions at the end (RMS by mass): two runs begun 1e-9 m apart stay together";
    if (!j_.by_shape) return;
    j_.why = j_.twin_drift > drift
                 ? "the motion is chaotic (two runs begun 1e-9 m apart part by "
                 : "positions do not converge (steps of 0.45 and 0.225 of the limit part by ";
    j_.why += far(j_.twin_drift > drift ? j_.twin_drift : halves) +
              "), so not where each vertex lies, but surface, centre and extent are compared";
  }

  static std::string far(double share) {
    if (!std::isfinite(share)) return "more than can be told, as one diverged";
    return Json(std::stod(fmt::format("{:.2g}", 100 * share))).dump() + " % of the size";
  }

  /// Richardson's: halves are d apart, quarters d 2^p, so the finer one is off by d / (2^p - 1); the order p
  /// is what the three runs show, between 1/2 (contact) and 2. A chaotic motion has no order: there, the
  /// distance between runs that should be equal.
  double reference_error() const {
    const double fine = error_of(j_.candidates[1].off), coarse = error_of(j_.candidates[0].off);
    if (j_.by_shape) return std::max(fine, error_of(twin_));
    const double ratio = std::clamp(fine > 0 ? (coarse - fine) / fine : 4.0, std::sqrt(2.0), 4.0);
    return fine / (ratio - 1);
  }

  void choose() {
    for (std::size_t i = 0; i < j_.candidates.size(); ++i) {
      const JudgedCandidate& c = j_.candidates[i];
      if (c.fate != Fate::done || !j_.meets(c)) continue;
      if (j_.chosen < 0 || c.cost < j_.candidates[static_cast<std::size_t>(j_.chosen)].cost)
        j_.chosen = static_cast<int>(i);
    }
  }

  const SceneCloth& scene_;
  const physics::World& world_;
  const Context& context_;
  ProgressScope progress_;
  std::chrono::steady_clock::time_point started_;
  ShapeMeter meter_;
  Judgement j_;
  std::vector<Shape> shapes_;  ///< of the candidates
  ShapeDistance twin_;
  double rate_ = 0, spent_ = 0;  ///< predicted cost of all runs a simulated second; so far [s]
};

}  // namespace

void check(const JudgeOptions& o) {
  if (!(o.tolerance > 0 && o.tolerance < 1))
    throw std::invalid_argument("`accuracy`: " + std::to_string(o.tolerance) + " is not between 0 and 1");
  if (!(o.budget > 0) || !std::isfinite(o.budget))
    throw std::invalid_argument("`budget`: " + std::to_string(o.budget) + " is no number above 0 [s]");
}

Judgement judge(const SceneCloth& scene, const physics::World& world, const JudgeOptions& options,
                const Context& context) {
  return Judge(scene, world, options, context).run();
}

}  // namespace furrow::jobs
