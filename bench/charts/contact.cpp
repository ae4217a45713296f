// SPDX-License-Identifier: GPL-3.0-or-later
// Whether contact takes away from the stable step: a sheet that falls on a ball, step x stiffness x
// integrator.
#include <cmath>
#include <vector>

#include "bench/accuracy_table.h"
#include "bench/charts/charts.h"
#include "physics/linear/stable_step.h"
#include "tests/cases/baselines.h"
#include "tests/cases/drop_on_ball.h"

namespace furrow::bench {
namespace {

using namespace cases;
using physics::Integrator;

struct Panel {
  const char* name;
  physics::StepperOptions options;
  double jitter;
};

const char* verdict(const DropRun& r) {
  constexpr double depth = 1e-3, rise = 1e-6, gain = 1e-2;
  if (r.end.diverged) return "diverged";
  if (r.deepest > depth || r.gain > gain) return "wrong";
  return r.largest_rise > rise ? "rough" : "stable";
}

/// 2/omega_max at the end of a run at half the limit, over that at the start: folds shorten it.
double shrunk_limit(const Drop& drop, double limit) {
  Swing draped = drop.fall;
  draped.cloth.particles.x = run(drop, {Integrator::leapfrog}, 0.5 * limit).end.x;
  return step_limit(draped) / limit;
}

}  // namespace

void chart_contact(const std::string& folder, Effort effort) {
  Table table(
      folder + "/contact.csv",
      "Hexagon of 127 vertices that falls 1 cm on a ball (radius R) and drapes, 0.3 s; friction 0.3, air "
      "drag "
      "0.2 1/s, springs' damping 0.02. stable: total energy never rises by more than 1e-6 m g R in a step; "
      "rough: it gains at most 1e-2 m g R; wrong: more, or a vertex is deeper than 1e-3 R; diverged: not "
      "finite, or faster than 1000 m/s. "
      "limit: 2/omega_max at the start; draped: at the end of a run at half of it.",
      "integrator,jitter[h],k[N/m],place,dt/limit[-],limit[s],draped/limit[-],rise[-],gain[-],deepest[-],"
      "off_axis[-],status");
  const std::vector<double> bounded{0.25, 0.35, 0.5, 0.6, 0.7, 0.8, 0.9, 0.95, 1.03, 1.1, 1.25, 1.5};
  const std::vector<double> free{0.5, 1, 2, 4, 8, 16, 32, 64, 128, 256};
  const Panel panels[] = {
      {"leapfrog", {Integrator::leapfrog}, 0}, {"leapfrog", {Integrator::leapfrog}, 0.3},
      {"semi-implicit", {semi_implicit}, 0},   {"RK4", {Integrator::rk4}, 0},
      {"implicit", {Integrator::implicit}, 0}, {"XPBD 1 sweep", {Integrator::xpbd, {1}}, 0}};
  const int per_decade = effort == Effort::quick ? 1 : 2;
  for (const Panel& panel : panels) {
    const bool any = physics::is_unconditionally_stable(panel.options.integrator);
    for (int i = 0; i <= 4 * per_decade; ++i) {
      const double k = 10 * std::pow(10.0, double(i) / per_decade);
      const Drop drop = drop_on_ball({.rings = 6, .stiffness = k, .jitter = panel.jitter});
      const double limit = step_limit(drop.fall), draped = any ? NAN : shrunk_limit(drop, limit);
      int place = 0;
      for (const double ratio : any ? free : bounded) {
        if (ratio * limit > drop.fall.seconds / 4) break;
        const DropRun r = run(drop, panel.options, ratio * limit);
        table.row(panel.name, panel.jitter, k, ++place, ratio, limit, draped, r.largest_rise, r.gain,
                  r.deepest, r.off_axis, verdict(r));
      }
    }
  }
}

}  // namespace furrow::bench
