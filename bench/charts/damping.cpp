// SPDX-License-Identifier: GPL-3.0-or-later
// The longest stable step against the damping of springs, found by running.
#include <cmath>

#include "bench/accuracy_table.h"
#include "bench/charts/charts.h"
#include "physics/packed/dashpots.h"
#include "tests/cases/baselines.h"
#include "tests/cases/swing.h"

namespace furrow::bench {
namespace {

using namespace cases;
using physics::Integrator;

/// Whether tiny velocities about rest, no weight, grow a thousandfold in any of so many steps.
bool grows(const Swing& swing, Integrator integrator, double dt, int steps) {
  physics::ThreadPool pool(1);
  physics::Motion motion(swing.cloth, swing.loads, pool);
  const auto stepper = cases::make_stepper(motion, {integrator});
  const auto energy = [&] {
    double sum = 0;
    for (const auto& v : motion.cloth().v) sum += v.x * v.x + v.y * v.y + v.z * v.z;
    return sum;
  };
  const double start = energy();
  for (int i = 1; i <= steps; ++i) {
    stepper->step(dt);
    if (i % 50 == 0 && !(energy() < 1e6 * start)) return true;
  }
  return false;
}

/// dt over `limit`, by bisection to 0.1 %.
double located(const Swing& swing, Integrator integrator, double limit, int steps) {
  double low = 1e-4, high = 4;
  while (high / low > 1.001) {
    const double middle = std::sqrt(low * high);
    (grows(swing, integrator, middle * limit, steps) ? high : low) = middle;
  }
  return std::sqrt(low * high);
}

}  // namespace

void chart_damping(const std::string& folder, Effort effort) {
  Table table(
      folder + "/damping.csv",
      "Longest stable step over 2/omega_max of a sheet of 95 vertices at rest, found by running. "
      "rk4_bound: as the library foresees it. naive: (sqrt(1 + z^2) - z), where damping is a force at the "
      "old velocity.",
      "damping[-],jitter[h],leapfrog[-],semi_implicit[-],rk4[-],explicit_euler[-],rk4_bound[-],naive[-]");
  const int steps = effort == Effort::quick ? 2000 : 20000;
  for (const double jitter : {0.0, 0.3}) {
    for (const double z : {0.0, 0.005, 0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1.0}) {
      Swing swing = sheet_swing({.columns = 8, .jitter = jitter, .spring_damping = z});
      swing.loads.gravity.setZero();
      swing.loads.air_drag = 0;
      for (std::size_t i = 0; i < swing.cloth.particles.size(); ++i) {
        if (swing.cloth.particles.inv_mass[i] == 0) continue;
        swing.cloth.particles.v[i] =
            1e-9 * physics::Vec3(std::sin(7.0 * double(i)), 0, std::cos(5.0 * double(i)));
      }
      const double limit = step_limit(swing);
      const physics::PackedCloth packed = physics::pack(swing.cloth);
      const double decay = z > 0 ? fastest_decay(packed, dashpots(packed, z)) : 0;
      const auto find = [&](Integrator i) { return located(swing, i, limit, steps); };
      table.row(z, jitter, find(Integrator::leapfrog), find(semi_implicit), find(Integrator::rk4),
                find(explicit_euler),
                std::min(physics::rk4_limit / 2, physics::rk4_damped_limit / decay / limit),
                std::sqrt(1 + z * z) - z);
    }
  }
}

}  // namespace furrow::bench
