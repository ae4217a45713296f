// SPDX-License-Identifier: GPL-3.0-or-later
#include "bridge/keeping/keep_trial.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <utility>

#include "bridge/arrays/gather.h"
#include "geometry/fold/line_height.h"
#include "geometry/mesh/property_names.h"
#include "physics/base/cancel_scope.h"

namespace furrow::bridge {
namespace {

using physics::Vec3;

constexpr double first_part = 0.2;  // of the first run, before it is asked whether it is in vain
constexpr int look_steps = 100;     // between two moments that are looked at, however often a run is observed
// At what is on its way elsewhere, when the push has calmed [s].
constexpr double first_look = 0.5, look = 0.1;
constexpr double calm_dt = 1.0 / 30;   // of implicit steps, where nothing blows [s]
constexpr double gust_of_euler = 1.6;  // such steps take so much out of a swing that gusts blow stronger
// Calm is what has moved for so long so slowly that no line is lost within a second [s].
constexpr double calm_for = 0.3, lost_in = 1;
constexpr double least_share = 0.005;  // of the mean edge: what is lower is not told from the mesh
constexpr double never = std::numeric_limits<double>::infinity();

}  // namespace

Vec3 gust_of(const KeepOptions& o, const std::vector<Vec3>& x) {
  if (o.gust_direction.norm() > 0) return o.gust * o.gust_direction.normalized();
  const Vec3 down = o.run.gravity.norm() > 0 ? Vec3(o.run.gravity.normalized()) : Vec3(Vec3::Zero());
  Vec3 centre = Vec3::Zero();
  for (const Vec3& p : x) centre += p / double(x.size());
  Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
  for (const Vec3& p : x) spread += (p - centre) * (p - centre).transpose();
  spread += 10 * spread.trace() * down * down.transpose();
  return o.gust * Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(spread).eigenvectors().col(0);
}

/// As strong, level, to the side.
Vec3 across(const Vec3& gust, const Vec3& gravity) {
  const Vec3 side = gust.cross(gravity.norm() > 0 ? gravity : gust.unitOrthogonal());
  return side.norm() > 0 ? Vec3(gust.norm() * side.normalized()) : Vec3(gust.norm() * gust.unitOrthogonal());
}

void push_off(physics::Cloth& cloth, double by, std::uint64_t number) {
  physics::Particles& p = cloth.particles;
  std::vector<double> most(p.size(), by);
  for (const auto& t : cloth.triangles)
    for (int c = 0; c < 3; ++c) {
      const int a = t[c], b = t[(c + 1) % 3];
      const double tenth = 0.1 * (p.x[a] - p.x[b]).norm();
      most[a] = std::min(most[a], tenth);
      most[b] = std::min(most[b], tenth);
    }
  std::mt19937_64 engine(number);
  const auto random = [&] { return double(engine() >> 11) * 0x1p-52 - 1; };
  for (std::size_t i = 0; i < p.size(); ++i) {
    const double a = random(), b = random(), c = random();
    if (p.inv_mass[i] > 0) p.x[i] += most[i] * Vec3(a, b, c).normalized();
  }
}

std::vector<double> shares_of_heights(std::vector<double> heights, const std::vector<double>& at_start) {
  for (std::size_t i = 0; i < heights.size(); ++i) heights[i] /= at_start[i];
  return heights;
}

double farthest_apart(const std::vector<Vec3>& a, const std::vector<Vec3>& b) {
  double most = 0;
  for (std::size_t i = 0; i < a.size(); ++i) most = std::max(most, (a[i] - b[i]).norm());
  return most;
}

LineMeter::LineMeter(const geometry::Mesh& mesh, const std::vector<double>& base, std::vector<double> widths,
                     const std::vector<char>& flat)
    : shape_(mesh), widths_(std::move(widths)) {
  for (const geometry::LineHeight& h : geometry::line_heights(shape_, widths_)) {
    if (std::size_t(h.line) < flat.size() && flat[std::size_t(h.line)]) continue;
    const bool known = std::size_t(h.line) < base.size() && std::isfinite(base[h.line]);
    const double below = known ? base[h.line] : 0;
    if (!std::isfinite(h.height)) unmeasured_.push_back(h.line);
    if (!std::isfinite(h.height) || h.height == below) continue;
    lines_.push_back(h.line);
    base_.push_back(below);
  }
}

std::vector<double> LineMeter::heights(const physics::Particles& p) {
  const physics::CancelScope whole([] { return false; });  // a trial that was stopped is measured, too
  scatter(p, shape_);
  std::vector<double> result;
  const auto all = geometry::line_heights(shape_, widths_);
  for (std::size_t i = 0; i < lines_.size(); ++i) {
    const auto at = std::find_if(all.begin(), all.end(), [&](const auto& h) { return h.line == lines_[i]; });
    result.push_back(at == all.end() ? NAN : at->height - base_[i]);
  }
  return result;
}

double LineMeter::mean_edge_at(int line) const {
  const auto id = geometry::find_map(shape_, geometry::attribute::line);
  double sum = 0;
  int count = 0;
  for (const geometry::Edge e : shape_.edges()) {
    const geometry::Vertex a = shape_.vertex(e, 0), b = shape_.vertex(e, 1);
    if ((*id)[a] != line && (*id)[b] != line) continue;
    sum += std::sqrt((shape_.point(a) - shape_.point(b)).squared_length());
    ++count;
  }
  return count > 0 ? sum / count : 0;
}

std::vector<LineMeter::TooLow> LineMeter::leave_out_low(const physics::Particles& p, double least) {
  const std::vector<double> now = heights(p);  // and shape_ lies there
  const std::vector<int> lines = std::exchange(lines_, {});
  const std::vector<double> base = std::exchange(base_, {});
  std::vector<TooLow> low;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const double floor = std::max(least, least_share * mean_edge_at(lines[i]));
    if (std::abs(now[i]) < floor) {
      low.push_back({lines[i], now[i], floor});
      continue;
    }
    lines_.push_back(lines[i]);
    base_.push_back(base[i]);
  }
  return low;
}

namespace {

/// A cloth on its way.
struct Run {
  physics::Cloth cloth;
  physics::SimulateState state;
  double before = 0;     ///< simulated in runs before this one [s]
  double next_look = 0;  ///< at the lines [s]
};

/// Of a run, up to so many seconds from its beginning.
struct Part {
  double until;             ///< [s]
  Vec3 gravity;             ///< with the gust [m/s^2]
  bool ends_early = false;  ///< once the cloth is calm
};

/// What goes on from a run: gusts to both sides along two level axes, and calm.
std::vector<Part> gusts_and_calm(const KeepOptions& o, const Vec3& gust, double from) {
  if (!(o.gust > 0)) return {};
  const double factor = o.run.integrator == physics::Integrator::implicit ? gust_of_euler : 1;
  const Vec3 a = factor * gust, b = factor * across(gust, o.run.gravity);
  std::vector<Part> parts;
  for (const Vec3& side : {a, Vec3(-a), b, Vec3(-b)})
    parts.push_back({from += o.gust_seconds, o.run.gravity + side});
  parts.push_back({from + o.calm_seconds, o.run.gravity, true});
  return parts;
}

/// Sees when a run has been calm for a while.
class CalmWatch {
 public:
  explicit CalmWatch(double speed) : speed_(speed) {}

  bool operator()(const physics::Particles& p, double time) {
    const bool slow = std::all_of(p.v.begin(), p.v.end(), [&](const Vec3& v) { return v.norm() <= speed_; });
    if (!slow || !since_) since_ = time;
    return slow && time - *since_ >= calm_for;
  }

 private:
  double speed_;  ///< that is none [m/s]
  std::optional<double> since_;
};

/// Each line's worst of several runs, or on their way.
void note(const std::vector<double>& shares, std::vector<double>& worst) {
  for (std::size_t i = 0; i < worst.size(); ++i) {
    const double share = std::isfinite(shares[i]) ? shares[i] : never;
    if (!(std::abs(share - 1) <= std::abs(worst[i] - 1))) worst[i] = share;  // the first time it is NaN
  }
}

/// What all runs of a trial have in common.
struct Setting {
  const physics::World& world;
  const KeepOptions& o;
  const std::function<bool(double)>& go_on;
  LineMeter& meter;
  const std::vector<double> drawn;  ///< heights at the start [m]
  const double whole;               ///< all that is simulated [s]

  /// Shares of the heights at the start.
  std::vector<double> shares(const physics::Cloth& cloth) const {
    return shares_of_heights(meter.heights(cloth.particles), drawn);
  }

  /// Slower than that, no line leaves its bounds within lost_in [m/s].
  double calm_speed() const {
    double least = never;
    for (const double height : drawn) least = std::min(least, std::abs(height));
    return (1 - o.kept) * least / lost_in;
  }

  physics::SimulateOptions options_of(const Part& part) const {
    physics::SimulateOptions options = o.run;
    options.seconds = part.until;
    options.gravity = part.gravity;
    options.implicit.keep_factors = true;
    if (!physics::solves_contact(options.integrator)) return options;
    options.observe_steps = 1;
    if (!options.dt && part.gravity == o.run.gravity) options.dt = calm_dt;
    return options;
  }

  /// Simulates a part of the run; from next_look on it notes what lines keep.
  physics::Outcome on_to(const Part& part, Run& run, std::vector<double>& worst) const {
    const physics::SimulateOptions options = options_of(part);
    CalmWatch watch(calm_speed());
    bool calm = false;
    const auto see = [&](const physics::SimulateProgress& now) {
      const bool looks =
          physics::solves_contact(options.integrator) || now.step % look_steps == 0 || now.time >= part.until;
      if (looks && now.time >= run.next_look) {
        note(shares(run.cloth), worst);
        run.next_look += look;
      }
      calm = part.ends_early && watch(run.cloth.particles, now.time);
      return !calm && (!go_on || go_on((run.before + now.time) / whole));
    };
    const physics::Outcome end = physics::simulate(run.cloth, world, options, &run.state, see).outcome;
    return calm ? physics::Outcome::finished : end;
  }

  /// What lines keep of a run after these parts.
  physics::Outcome through(const std::vector<Part>& parts, Run& run, std::vector<double>& kept) const {
    run.next_look = never;  // a gust may bend what comes back
    for (const Part& part : parts) {
      const physics::Outcome end = on_to(part, run, kept);
      if (end != physics::Outcome::finished) return end;
    }
    note(shares(run.cloth), kept);
    return physics::Outcome::finished;
  }
};

}  // namespace

KeepTrial try_shape(const physics::Cloth& start, bool stable, const physics::World& world,
                    const KeepOptions& o, LineMeter& meter, const InVain& in_vain,
                    const std::function<bool(double)>& go_on) {
  using physics::Outcome;
  const int runs = stable ? 1 : o.pushes;
  const double branch = first_part * o.seconds;
  const std::vector<Part> gusts = gusts_and_calm(o, gust_of(o, start.particles.x), branch);
  const double in_gusts = gusts.empty() ? 0 : gusts.back().until - branch;
  const Setting setting{world, o, go_on, meter, meter.heights(start.particles), runs * o.seconds + in_gusts};
  const std::vector<double> unknown(setting.drawn.size(), NAN);
  KeepTrial trial{unknown, unknown};
  const auto lost = [&](Outcome end) {
    return KeepTrial{unknown, unknown, 0, end == Outcome::stopped_by_observer};
  };
  for (int number = 1; number <= runs; ++number) {
    Run run{start, {}, (number - 1) * o.seconds + (number > 1 ? in_gusts : 0), stable ? never : first_look};
    push_off(run.cloth, o.push, std::uint64_t(number));
    Outcome end = setting.on_to({branch, o.run.gravity}, run, trial.kept);
    if (end != Outcome::finished) return lost(end);
    if (const std::vector<double> early = setting.shares(run.cloth); in_vain && in_vain(early))
      return {early, unknown};
    if (number == 1 && !gusts.empty()) {
      Run blown = run;
      end = setting.through(gusts, blown, trial.kept_gust);
      if (end != Outcome::finished) return lost(end);
      run.before += in_gusts;
    }
    end = setting.on_to({o.seconds, o.run.gravity, stable}, run, trial.kept);
    if (end != Outcome::finished) return lost(end);
    note(setting.shares(run.cloth), trial.kept);
    trial.drift = std::max(trial.drift, farthest_apart(run.cloth.particles.x, start.particles.x));
  }
  if (gusts.empty()) trial.kept_gust = trial.kept;
  return trial;
}

}  // namespace furrow::bridge
