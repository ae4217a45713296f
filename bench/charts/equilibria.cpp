// SPDX-License-Identifier: GPL-3.0-or-later
// What it costs to come to rest: processor time until the residual force is 1e-4 of a vertex's weight, and
// how far that rest is from theory.
#include <cmath>
#include <functional>
#include <limits>

#include "bench/accuracy_table.h"
#include "bench/charts/charts.h"
#include "physics/contact/residual_force.h"
#include "tests/cases/baselines.h"
#include "tests/cases/swing.h"
#include "tests/physics/cloth/strips.h"
#include "tests/physics/rest/hanging_chains.h"
#include "tests/physics/rest/settled.h"

namespace furrow::bench {
namespace {

using namespace cases;
using physics::Cloth;
using physics::Integrator;
using physics::Vec3;

constexpr double at_rest = 1e-4;  // residual force over weight [-]

struct Scene {
  std::string name;
  Cloth cloth;
  Vec3 gravity;                               ///< [m/s^2]
  double air_drag;                            ///< about critical for the slowest mode [1/s]
  bool shell;                                 ///< has hinges and triangles, which XPBD does not know
  std::function<double(const Cloth&)> error;  ///< relative to theory [-]
};

Scene catenary() {
  const Cloth chain = tests::hanging_chain(32, 0.7);
  const auto exact = tests::exact_chain(chain);
  const auto error = [exact](const Cloth& now) {
    double worst = 0;
    for (std::size_t i = 0; i < exact.size(); ++i) {
      const Vec3 node(exact[i].x(), exact[i].y(), 0);
      worst = std::max(worst, (now.particles.x[i] - node).norm());
    }
    return worst / tests::chain_span;
  };
  return {"catenary", chain, {0, -tests::chain_gravity, 0}, 8, false, error};
}

Scene cantilever(double gamma) {
  const tests::StripOptions o;
  const tests::Strip strip = tests::equilateral_strip(o);
  const double g = tests::gravity_for(gamma, o.density, o.length, o.rigidity);
  const double bending = 3.516 * std::sqrt(o.rigidity / o.density) / (o.length * o.length);
  const double slowest = std::hypot(bending, std::sqrt(g / o.length));  // [rad/s], roughly
  const tests::Elastica exact = tests::heavy_elastica(gamma);
  const auto error = [rows = strip.rows, exact](const Cloth& now) {
    Vec3 tip = Vec3::Zero();
    for (const int i : rows.back()) tip += now.particles.x[i];
    return std::abs(-tip.z() / tip.x() / (exact.height / exact.width) - 1);
  };
  char name[32];
  std::snprintf(name, sizeof name, "cantilever %g", gamma);
  return {name, strip.cloth, {0, 0, -g}, 2 * slowest, true, error};
}

struct Method {
  const char* name;
  physics::StepperOptions options;
  double dt;  ///< over 2/omega_max at the start; of what is stable at any step in seconds
};

constexpr Method methods[] = {{"semi-implicit Euler 0.9", {semi_implicit}, 0.9},
                              {"leapfrog 0.9", {Integrator::leapfrog}, 0.9},
                              {"RK4 1.2", {Integrator::rk4}, 1.2},
                              {"XPBD 1 sweep 1/1200 s", {Integrator::xpbd, {1}}, 1.0 / 1200},
                              {"XPBD 10 sweeps 1/240 s", {Integrator::xpbd, {10}}, 1.0 / 240},
                              {"implicit 1/240 s", {Integrator::implicit}, 1.0 / 240},
                              {"implicit 1/60 s", {Integrator::implicit}, 1.0 / 60},
                              {"implicit 1/15 s", {Integrator::implicit}, 1.0 / 15}};

struct Rest {
  double cpu = 0, residual = 0, error = 0, simulated = 0;
  physics::WorkCounts work;
};

/// Steps until at rest, at most `most` seconds. The time for looking at the residual is not counted.
Rest settle(const Scene& scene, const Method& method, double dt, double most) {
  constexpr double longest = 60;  // simulated seconds
  Rest rest;
  Cloth cloth = scene.cloth;
  physics::ThreadPool pool(1);
  physics::Motion motion(cloth, {scene.gravity, scene.air_drag, 0.02}, pool);
  const auto stepper = cases::make_stepper(motion, method.options);
  const std::int64_t between = std::max<std::int64_t>(1, std::llround(0.05 / dt));
  do {
    const double started = thread_seconds();
    for (std::int64_t i = 0; i < between; ++i) stepper->step(dt);
    rest.cpu += thread_seconds() - started;
    rest.simulated += double(between) * dt;
    motion.unpack(cloth.particles);
    rest.residual = has_diverged(motion.cloth())
                        ? INFINITY
                        : physics::residual_force(cloth, scene.gravity, nullptr, 0, 0.003);
  } while (rest.residual > at_rest && std::isfinite(rest.residual) && rest.cpu < most &&
           rest.simulated < longest);
  rest.error = scene.error(cloth);
  rest.work = motion.work();
  return rest;
}

Rest newton(const Scene& scene) {
  Cloth cloth = scene.cloth;
  const physics::SettleOptions options = tests::down_to(at_rest, scene.gravity);
  Rest rest;
  const double started = thread_seconds();
  const physics::SettleReport report = physics::settle(cloth, nullptr, options);
  rest.cpu = thread_seconds() - started;
  rest.residual = report.residual;
  rest.error = scene.error(cloth);
  rest.work.factorisations = report.factorisations;
  return rest;
}

}  // namespace

void chart_equilibria(const std::string& folder, Effort effort) {
  Table table(
      folder + "/equilibria.csv",
      "From level until the largest net force on a vertex is 1e-4 of its weight. Thread processor time, one "
      "thread. Error: catenary, worst node over the span; cantilevers (Gamma; 16 x 4 cells), H/W against the "
      "elastica. status: at rest, or what was reached in 30 s (full: 300 s) or 60 simulated seconds.",
      "scene,method,dt[s],cpu[s],simulated[s],steps,factorisations,residual[-],error[-],status");
  const double most = effort == Effort::quick ? 30 : 300;
  for (const Scene& scene : {catenary(), cantilever(10), cantilever(25), cantilever(100)}) {
    const double limit = step_limit({scene.cloth, {}, 0});
    const auto print = [&](const char* name, double dt, const Rest& r) {
      const char* status = r.residual <= at_rest       ? "at rest"
                           : std::isfinite(r.residual) ? "not yet"
                                                       : "diverged";
      table.row(scene.name, name, dt, r.cpu, r.simulated, r.work.steps, r.work.factorisations, r.residual,
                r.error, status);
    };
    print("Newton (statics)", NAN, newton(scene));
    for (const Method& m : methods) {
      const bool bounded = !physics::is_unconditionally_stable(m.options.integrator);
      if (scene.shell && m.options.integrator == Integrator::xpbd) continue;
      const double dt = bounded ? m.dt * limit : m.dt;
      print(m.name, dt, settle(scene, m, dt, most));
    }
  }
}

}  // namespace furrow::bench
