// SPDX-License-Identifier: GPL-3.0-or-later
#include "bridge/keeping/try_statics.h"

#include <algorithm>

#include "bridge/draping/standing_body.h"
#include "physics/rest/settle.h"

namespace furrow::bridge {
namespace {

constexpr double longest_move = 0.005;  // m: a search shall not step over what holds a fold
constexpr int most_iterations = 60;     // what moves on then is measured where it is

physics::SettleOptions options_of(const KeepOptions& o, physics::StiffnessWork& work) {
  physics::SettleOptions settle;
  settle.gravity = o.run.gravity;
  settle.friction = o.run.friction;
  settle.gap = o.run.contact_gap;
  settle.threads = o.run.threads;
  settle.longest_move = longest_move;
  settle.max_iterations = most_iterations;
  settle.work = &work;
  return settle;
}

}  // namespace

StaticTrial try_statics(const physics::Cloth& start, const physics::World& world, const KeepOptions& o,
                        LineMeter& meter, physics::StiffnessWork& work, const std::function<bool()>& go_on) {
  const std::optional<physics::PosedCollider> standing = standing_body(world);
  const std::vector<double> drawn = meter.heights(start.particles);
  StaticTrial trial{std::vector<double>(drawn.size(), NAN)};
  physics::Cloth cloth = start;
  push_off(cloth, o.push, 1);
  const physics::SettleReport rest =
      physics::settle(cloth, standing ? &*standing : nullptr, options_of(o, work),
                      [&](const auto&) { return !go_on || go_on(); });
  trial.stopped = rest.stopped;
  if (trial.stopped) return trial;
  trial.kept = shares_of_heights(meter.heights(cloth.particles), drawn);
  trial.drift = farthest_apart(cloth.particles.x, start.particles.x);
  return trial;
}

}  // namespace furrow::bridge
