// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/cases/drop_on_ball.h"

#include <algorithm>
#include <cmath>

#include "physics/cloth/elements.h"
#include "tests/cases/baselines.h"
#include "tests/cases/flat_meshes.h"
#include "tests/cases/gravity.h"

namespace furrow::cases {
namespace {

using physics::Vec3;

struct Ball : physics::Collider {
  physics::SignedDistance at(const Vec3& x) const override {
    const double r = x.norm();
    return {r - ball_radius, r > 0 ? Vec3(x / r) : Vec3::UnitY()};
  }
};

double total_energy(const physics::Cloth& cloth) {
  const physics::Particles& p = cloth.particles;
  double energy = physics::potential_energy(cloth, p.x);
  for (std::size_t i = 0; i < p.size(); ++i) {
    energy += p.mass[i] * (p.v[i].squaredNorm() / 2 + gravity * p.x[i].y());
  }
  return energy;
}

double depth(const physics::Particles& p) {
  double least = INFINITY;
  for (const Vec3& x : p.x) least = std::min(least, x.norm());
  return std::max(0.0, ball_radius - least) / ball_radius;
}

}  // namespace

Drop drop_on_ball(const DropOptions& o) {
  constexpr double half_diagonal = 0.25, density = 0.15, fall = 0.01;
  Drop drop{{hexagon(half_diagonal, o.rings, density, o.jitter), {}, o.seconds}, {}};
  physics::Cloth& cloth = drop.fall.cloth;
  drop.contact.friction = o.friction;
  for (physics::Spring& s : cloth.structural) s.stiffness = o.stiffness;
  for (Vec3& x : cloth.particles.x) x = Vec3(x.x(), ball_radius + drop.contact.gap + fall, -x.y());
  drop.fall.loads.air_drag = 0.2;
  drop.fall.loads.spring_damping = o.spring_damping;
  return drop;
}

DropRun run(const Drop& drop, const physics::StepperOptions& options, double dt) {
  const Swing& fall = drop.fall;
  const auto steps = std::int64_t(std::ceil(fall.seconds / dt * (1 - 1e-12)));
  DropRun result;
  result.end.dt = fall.seconds / double(steps);
  physics::Cloth cloth = fall.cloth;
  physics::Particles& p = cloth.particles;
  const Ball ball;
  physics::BodyContact contact(ball, drop.contact, int(p.size()));
  physics::ThreadPool pool(1);
  physics::Motion motion(cloth, fall.loads, pool, {.contact = &contact});
  const auto stepper = cases::make_stepper(motion, options);
  double mass = 0;
  for (const double m : p.mass) mass += m;
  double last = total_energy(cloth), least = last;
  const double unit = mass * gravity * ball_radius;
  for (std::int64_t i = 0; i < steps && !result.end.diverged; ++i) {
    motion.begin_step(double(i) * result.end.dt, double(i + 1) * result.end.dt);
    stepper->step(result.end.dt);
    motion.unpack(p);
    result.end.diverged = has_diverged(motion.cloth());
    if (result.end.diverged) break;
    const double energy = total_energy(cloth);
    result.largest_rise = std::max(result.largest_rise, (energy - last) / unit);
    result.gain = std::max(result.gain, (energy - least) / unit);
    result.deepest = std::max(result.deepest, depth(p));
    last = energy;
    least = std::min(least, energy);
  }
  result.end.work = motion.work();
  Vec3 centre = Vec3::Zero();
  for (std::size_t i = 0; i < p.size(); ++i) centre += p.mass[i] / mass * p.x[i];
  result.off_axis = std::hypot(centre.x(), centre.z()) / ball_radius;
  result.end.x = std::move(p.x);
  return result;
}

}  // namespace furrow::cases
