// SPDX-License-Identifier: GPL-3.0-or-later
#include "bridge/try_statics.h"

#include <algorithm>

#include "bridge/standing_body.h"
#include "physics/rest/settle.h"

namespace furrow::bridge {
namespace {

using physics::Vec3;

constexpr double overshoot = 1.15;      // of the gust, by which cloth in motion swings out farther
constexpr double longest_move = 0.005;  // m: a search shall not step over what holds a fold

constexpr int most_iterations = 60;   // of a search: what moves on then is measured where it is
constexpr int brief_iterations = 14;  // of one that motion follows: it is left to that

physics::SettleOptions options_of(const KeepOptions& o, bool brief, physics::StiffnessWork& work) {
  physics::SettleOptions settle;
  settle.gravity = o.run.gravity;
  settle.friction = o.run.friction;
  settle.gap = o.run.contact_gap;
  settle.threads = o.run.threads;
  settle.longest_move = longest_move;
  settle.max_iterations = brief ? brief_iterations : most_iterations;
  settle.work = &work;
  return settle;
}

}  // namespace

KeepTrial try_statics(const physics::Cloth& start, const physics::World& world, const KeepOptions& o,
                      bool brief, LineMeter& meter, physics::StiffnessWork& work,
                      const std::function<bool(double)>& go_on) {
  const std::optional<physics::PosedCollider> standing = standing_body(world);
  const physics::Collider* const body = standing ? &*standing : nullptr;
  const std::vector<double> drawn = meter.heights(start.particles);
  KeepTrial trial{std::vector<double>(drawn.size(), NAN), std::vector<double>(drawn.size(), NAN)};
  physics::Cloth cloth = start;
  physics::SettleOptions settle = options_of(o, brief, work);
  physics::SettleReport last;
  int searches = 0;
  const double all = brief ? 1 : 3;
  const auto rest_under = [&](const Vec3& gravity) {
    const double done = searches++ / all;
    settle.gravity = gravity;
    last = physics::settle(cloth, body, settle, [&](const auto&) { return !go_on || go_on(done); });
    trial.stopped = last.stopped;
    return !trial.stopped;
  };
  const auto shares = [&] {
    std::vector<double> now = meter.heights(cloth.particles);
    for (std::size_t i = 0; i < now.size(); ++i) now[i] /= drawn[i];
    return now;
  };
  push_off(cloth, o.push, 1);
  if (!rest_under(o.run.gravity)) return trial;
  trial.kept = shares();
  for (std::size_t i = 0; i < start.particles.size(); ++i)
    trial.drift = std::max(trial.drift, (cloth.particles.x[i] - start.particles.x[i]).norm());
  if (brief) {
    trial.kept_gust.assign(drawn.size(), 1);  // that is for motion to say
    if (!last.converged) trial.kept = trial.kept_gust;
    return trial;
  }
  const Vec3 gust = gust_of(o, start.particles.x);
  if (o.gust > 0 && !(rest_under(o.run.gravity + overshoot * gust) && rest_under(o.run.gravity)))
    return trial;
  trial.kept_gust = shares();
  return trial;
}

}  // namespace furrow::bridge
