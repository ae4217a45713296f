// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/cases/swing.h"

#include <cmath>
#include <ctime>

#include "physics/cloth/pins.h"
#include "physics/linear/stable_step.h"
#include "tests/cases/baselines.h"
#include "tests/cases/flat_meshes.h"

namespace furrow::cases {
namespace {

using physics::Vec3;

constexpr double fastest_speed = 1000;  // m/s

}  // namespace

Swing sheet_swing(const SheetOptions& o) {
  constexpr double side = 0.4, density = 0.15;
  const int rows = equilateral_rows(side, side, o.columns);
  Swing swing{triangular_sheet(side, side, o.columns, rows, density, o.jitter), {}, o.seconds};
  physics::Cloth& cloth = swing.cloth;
  const std::vector<double> areas = rest_areas(cloth);
  const double young = 2 / std::sqrt(3.0) * o.stiffness;
  set_membrane_stiffness(cloth, o.law, calibrated_stiffness(cloth, o.law, young, areas), areas);
  for (Vec3& x : cloth.particles.x) x = Vec3(x.x(), 0, x.y());
  pin(cloth.particles, std::vector<int>{0, o.columns});
  swing.loads.air_drag = 0.2;
  swing.loads.spring_damping = o.spring_damping;
  return swing;
}

Swing chain_swing() {
  constexpr int links = 32;
  constexpr double length = 1, mass = 0.1, axial = 147;
  Swing swing{{}, {}, 0.5};
  physics::Cloth& cloth = swing.cloth;
  physics::Particles& p = cloth.particles;
  std::vector<double> rest(links);
  double sum = 0;
  for (int i = 0; i < links; ++i) sum += rest[i] = 1 + 0.7 * std::sin(2.4 * (i + 1));
  p.x.push_back(Vec3::Zero());
  p.mass.assign(links + 1, 0);
  for (int i = 0; i < links; ++i) {
    rest[i] *= length / sum;
    p.x.push_back(p.x.back() + Vec3(rest[i], 0, 0));
    for (const int end : {i, i + 1}) p.mass[end] += mass * rest[i] / (2 * length);
    cloth.structural.push_back({i, i + 1, rest[i], axial / rest[i]});
  }
  p.v.assign(p.size(), Vec3::Zero());
  for (const double m : p.mass) p.inv_mass.push_back(1 / m);
  pin(p, std::vector<int>{0});
  swing.loads.air_drag = 0.2;
  swing.loads.spring_damping = 0.02;
  return swing;
}

Swing elastic_pendulum() {
  Swing swing{{}, {}, 2};
  physics::Particles& p = swing.cloth.particles;
  p.x = {Vec3::Zero(), Vec3(1.1, 0.2, 0)};
  p.v.assign(2, Vec3::Zero());
  p.mass = {0.1, 0.1};
  p.inv_mass = {0, 10};
  swing.cloth.structural.push_back({0, 1, 1, 50});
  swing.loads.air_drag = swing.loads.spring_damping = 0;
  return swing;
}

SwingRun run(const Swing& swing, const physics::StepperOptions& options, double dt) {
  const auto steps = std::int64_t(std::ceil(swing.seconds / dt * (1 - 1e-12)));
  SwingRun result;
  result.dt = swing.seconds / double(steps);
  const double started = thread_seconds();
  physics::ThreadPool pool(1);
  physics::Motion motion(swing.cloth, swing.loads, pool);
  const auto stepper = cases::make_stepper(motion, options);
  for (std::int64_t i = 1; i <= steps && !result.diverged; ++i) {
    stepper->step(result.dt);
    if (i % 16 == 0 || i == steps) result.diverged = has_diverged(motion.cloth());
  }
  result.cpu_seconds = thread_seconds() - started;
  result.work = motion.work();
  physics::Particles end = swing.cloth.particles;
  motion.unpack(end);
  result.x = std::move(end.x);
  return result;
}

double thread_seconds() {
  std::timespec t{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return double(t.tv_sec) + 1e-9 * double(t.tv_nsec);
}

bool has_diverged(const physics::PackedCloth& cloth) {
  for (std::size_t i = 0; i < cloth.v.size(); ++i) {
    const auto &v = cloth.v[i], &x = cloth.x[i];
    const double square = v.x * v.x + v.y * v.y + v.z * v.z;
    if (!(square <= fastest_speed * fastest_speed) || !std::isfinite(x.x + x.y + x.z)) return true;
  }
  return false;
}

double relative_error(const Swing& swing, const std::vector<Vec3>& end, const std::vector<Vec3>& exact) {
  double away = 0, way = 0;
  for (std::size_t i = 0; i < end.size(); ++i) {
    away += swing.cloth.particles.mass[i] * (end[i] - exact[i]).squaredNorm();
    way += swing.cloth.particles.mass[i] * (swing.cloth.particles.x[i] - exact[i]).squaredNorm();
  }
  return std::sqrt(away / way);
}

double step_limit(const Swing& swing) { return stable_step(swing.cloth, {.tolerance = 1e-4}).dt_limit; }

}  // namespace furrow::cases
