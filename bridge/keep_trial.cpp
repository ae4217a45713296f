// SPDX-License-Identifier: GPL-3.0-or-later
#include "bridge/keep_trial.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "bridge/scatter.h"
#include "geometry/fold/line_height.h"

namespace furrow::bridge {
namespace {

using physics::Vec3;

constexpr double first_part = 0.2;  // of the first run, before it is asked whether it is in vain
constexpr double first_look = 0.5,
                 look = 0.1;  // at what is on its way elsewhere, when the push has calmed [s]

/// The options' direction of the gust; if they name none, the level direction in which the cloth is thinnest.
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

/// Moves each free particle by so much [m], or a tenth of the shortest edge at it, in some direction, which
/// is the same in every run of this number.
void push(physics::Cloth& cloth, double by, std::uint64_t number) {
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

}  // namespace

LineMeter::LineMeter(const geometry::Mesh& mesh, const std::vector<double>& base, std::vector<double> widths)
    : shape_(mesh), widths_(std::move(widths)) {
  for (const geometry::LineHeight& h : geometry::line_heights(shape_, widths_)) {
    const bool known = std::size_t(h.line) < base.size() && std::isfinite(base[h.line]);
    const double below = known ? base[h.line] : 0;
    if (!std::isfinite(h.height)) unmeasured_.push_back(h.line);
    if (!std::isfinite(h.height) || h.height == below) continue;
    lines_.push_back(h.line);
    base_.push_back(below);
  }
}

std::vector<double> LineMeter::heights(const physics::Particles& p) {
  scatter(p, shape_);
  std::vector<double> result;
  const auto all = geometry::line_heights(shape_, widths_);
  for (std::size_t i = 0; i < lines_.size(); ++i) {
    const auto at = std::find_if(all.begin(), all.end(), [&](const auto& h) { return h.line == lines_[i]; });
    result.push_back(at == all.end() ? NAN : at->height - base_[i]);
  }
  return result;
}

KeepTrial try_shape(const physics::Cloth& start, bool stable, const physics::World& world,
                    const KeepOptions& o, LineMeter& meter,
                    const std::function<bool(const std::vector<double>&)>& in_vain,
                    const std::function<bool(double)>& go_on) {
  const std::vector<double> drawn = meter.heights(start.particles);
  const std::vector<double> unknown(drawn.size(), NAN);
  KeepTrial trial{unknown, unknown};
  physics::Cloth cloth;
  physics::SimulateState state;
  const int runs = stable ? 1 : o.pushes;
  const double after = o.gust > 0 ? o.gust_seconds + o.calm_seconds : 0, whole = runs * o.seconds + after;
  double done = 0, next_look = std::numeric_limits<double>::infinity();
  const auto shares = [&] {
    std::vector<double> now = meter.heights(cloth.particles);
    for (std::size_t i = 0; i < now.size(); ++i) now[i] /= drawn[i];
    return now;
  };
  const auto note = [&](std::vector<double>& kept) {  // the worst of several runs, and on their way
    const std::vector<double> now = shares();
    for (std::size_t i = 0; i < kept.size(); ++i) {
      const double share = std::isfinite(now[i]) ? now[i] : std::numeric_limits<double>::infinity();
      if (!(std::abs(share - 1) <= std::abs(kept[i] - 1))) kept[i] = share;  // the first time it is NaN
    }
  };
  const auto on_to = [&](double seconds, const Vec3& gravity) {
    physics::SimulateOptions options = o.run;
    options.seconds = seconds;
    options.gravity = gravity;
    const auto report = physics::simulate(cloth, world, options, &state, [&](const auto& now) {
      if (now.time >= next_look) note(trial.kept), next_look += look;
      return !go_on || go_on((done + now.time) / whole);
    });
    trial.stopped = trial.stopped || report.outcome == physics::Outcome::stopped_by_observer;
    return report.outcome == physics::Outcome::finished;
  };
  for (int run = 1; run <= runs; ++run, done += o.seconds) {
    cloth = start;
    state = {};
    push(cloth, o.push, std::uint64_t(run));
    if (!stable) next_look = first_look;
    if (!on_to(first_part * o.seconds, o.run.gravity)) return {unknown, unknown, 0, trial.stopped};
    if (const std::vector<double> early = shares(); in_vain && in_vain(early)) return {early, unknown};
    if (!on_to(o.seconds, o.run.gravity)) return {unknown, unknown, 0, trial.stopped};
    note(trial.kept);
    for (std::size_t i = 0; i < cloth.particles.size(); ++i)
      trial.drift = std::max(trial.drift, (cloth.particles.x[i] - start.particles.x[i]).norm());
  }
  done -= o.seconds;
  next_look = std::numeric_limits<double>::infinity();  // the gust may bend what comes back
  const double blown = o.seconds + o.gust_seconds;
  const bool calm = o.gust == 0 || (on_to(blown, o.run.gravity + gust_of(o, start.particles.x)) &&
                                    on_to(blown + o.calm_seconds, o.run.gravity));
  if (calm) note(trial.kept_gust);
  return trial;
}

}  // namespace furrow::bridge
