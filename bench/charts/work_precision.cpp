// SPDX-License-Identifier: GPL-3.0-or-later
// Error against processor time and force evaluations: each integrator, one point a step length.
#include <algorithm>
#include <cmath>
#include <span>
#include <tuple>
#include <vector>

#include "bench/accuracy_table.h"
#include "bench/charts/charts.h"
#include "tests/cases/baselines.h"
#include "tests/cases/swing.h"

namespace furrow::bench {
namespace {

using namespace cases;
using physics::Integrator;

constexpr double wrong = 0.1;       // an error that anybody sees [-]
constexpr double same_time = 1.05;  // times nearer than that are the same
constexpr double senseless = 3;     // counts as diverged

using Positions = std::vector<physics::Vec3>;

struct Scene {
  std::string name, title;
  Swing swing;
  double share;        ///< of the limit: the reference's step
  Positions end = {};  ///< known from elsewhere, or none
};

struct Size {
  const char* name;
  int columns;
  double seconds[3];  ///< soft, medium, stiff: the finer and stiffer, the sooner its folds depend on rounding
};

std::vector<Scene> scenes(bool quick) {
  const double share = quick ? 0.2 : 0.1;
  std::vector<Scene> list;
  const physics::Vec3 pendulum_end(0.389103045248, -0.920914325687, 0);
  list.push_back(
      {"pendulum", "elastic pendulum", elastic_pendulum(), share, {physics::Vec3::Zero(), pendulum_end}});
  list.push_back({"chain", "chain, 33 vertices, 147 N", chain_swing(), share});
  const Size sizes[] = {
      {"small", 16, {0.2, 0.2, 0.2}}, {"large", 50, {0.15, 0.15, 0.1}}, {"huge", 160, {0.1, 0.1, 0.05}}};
  for (const Size& size : std::span(sizes, quick ? 2 : 3)) {
    const std::tuple<const char*, double, const char*> cloths[] = {
        {"soft", 200.0, "200"}, {"medium", 2e3, "2,000"}, {"stiff", 2e4, "20,000"}};
    for (int i = 0; i < 3; ++i) {
      const auto& [name, k, text] = cloths[i];
      const Swing swing =
          sheet_swing({.columns = size.columns, .stiffness = k, .jitter = 0.2, .seconds = size.seconds[i]});
      list.push_back(
          {std::string(size.name) + "-" + name,
           "sheet, " + std::to_string(swing.cloth.particles.size()) + " vertices; " + text + " N/m", swing,
           size.columns > 100 ? 0.2 : share});
    }
  }
  return list;
}

struct Method {
  const char* name;
  physics::StepperOptions options;
  double weight;                ///< time of a step over that of leapfrog, roughly [-]
  bool of_limit;                ///< steps are in 2/omega_max, else in seconds
  std::vector<double> lengths;  ///< of steps, the longest first
};

std::vector<Method> methods() {
  const std::vector<double> symplectic{1.05, 0.95, 0.7, 0.4, 0.2, 0.1, 0.05, 0.02};
  std::vector<double> seconds;
  for (int per_second = 15; per_second <= 61440; per_second *= 2) seconds.push_back(1.0 / per_second);
  return {{"explicit Euler", {explicit_euler}, 1, true, {0.25, 0.06, 0.03, 0.015, 0.0075, 0.004}},
          {"semi-implicit Euler", {semi_implicit}, 1, true, symplectic},
          {"leapfrog", {Integrator::leapfrog}, 1, true, symplectic},
          {"RK4", {Integrator::rk4}, 4, true, {1.55, 1.35, 1.1, 0.8, 0.5, 0.4}},
          {"implicit", {Integrator::implicit}, 300, false, seconds},
          {"XPBD 1 sweep", {Integrator::xpbd, {1}}, 2, false, seconds},
          {"XPBD 10 sweeps", {Integrator::xpbd, {10}}, 15, false, seconds},
          {"XPBD 100 sweeps", {Integrator::xpbd, {100}}, 150, false, seconds}};
}

struct Point {
  const Method* method;
  double dt, cpu, passes, error;  ///< per simulated second; error: infinite if diverged
  bool on_cpu_front = true, on_pass_front = true;
};

/// The median time of up to `repeats` runs; long ones run once.
Point measured(const Scene& scene, const Method& method, double dt, int repeats,
               const std::vector<physics::Vec3>& exact) {
  const SwingRun first = run(scene.swing, method.options, dt);
  std::vector<double> cpu{first.cpu_seconds};
  while (int(cpu.size()) < repeats && cpu[0] < 0.4) {
    cpu.push_back(run(scene.swing, method.options, dt).cpu_seconds);
  }
  std::nth_element(cpu.begin(), cpu.begin() + int(cpu.size()) / 2, cpu.end());
  const bool sweeps = method.options.integrator == Integrator::xpbd;
  const double passes = double(first.work.force_evaluations + (sweeps ? first.work.iterations : 0));
  const double error = relative_error(scene.swing, first.x, exact);
  return {&method, first.dt, cpu[cpu.size() / 2] / scene.swing.seconds, passes / scene.swing.seconds,
          first.diverged || !(error < senseless) ? INFINITY : error};
}

/// Implicit steps' factorisations are no passes, so it has no place on the front of passes.
void mark_fronts(std::vector<Point>& points) {
  const auto counts = [](const Point& p) { return p.method->options.integrator != Integrator::implicit; };
  for (Point& p : points) {
    for (const Point& q : points) {
      if (!(q.error < p.error)) continue;
      if (q.cpu <= same_time * p.cpu) p.on_cpu_front = false;
      if (q.passes <= p.passes && counts(q)) p.on_pass_front = false;
    }
    if (!(p.error < wrong)) p.on_cpu_front = p.on_pass_front = false;
    if (!counts(p)) p.on_pass_front = false;
  }
}

/// The cheapest way to an error of at most `error`; nan: none.
double cost(const std::vector<Point>& points, const Method& method, double error) {
  double least = NAN;
  for (const Point& p : points) {
    if (p.method == &method && p.error <= error) least = std::fmin(least, p.cpu);
  }
  return least;
}

struct Tables {
  Table points, checks, fronts;
  explicit Tables(const std::string& folder)
      : points(
            folder + "/work.csv",
            "Error: RMS distance from the reference, over that of the way from the start (still: 1). "
            "Thread processor time, one thread. Passes over all springs: force evaluations, and sweeps of "
            "XPBD; factorisations of implicit steps are not counted. wrong: error > 0.1.",
            "scene,method,dt[s],dt/limit[-],cpu[s/s],passes[1/s],error[-],status,on_cpu_front,on_pass_front"),
        checks(folder + "/work_references.csv",
               "References: RK4 at dt; of the pendulum a method of order 8. check: how far RK4 at 2 dt ends "
               "from it, whose own error is about "
               "1/15 of that. order: from 4 dt, 2 dt and dt, 4 where rounding has no part in it. twin: how"
               " far a run ends that began 1e-9 m beside. limit_cpu, limit_passes: of leapfrog at its "
               "limit.",
               "scene,title,vertices,springs,seconds,limit[s],dt[s],check[-],order[-],twin[-],limit_cpu[s/"
               "s],limit_passes[1/s]"),
        fronts(folder + "/work_fronts.csv",
               "Points (error < 0.1) on the front of error against processor time, or against passes, and "
               "the processor time per simulated second of the cheapest point with at most that error.",
               "scene,method,points,on_cpu_front,on_pass_front,cpu_at_1e-2,cpu_at_1e-3,cpu_at_1e-4") {}
};

double twin_distance(const Swing& swing, double dt, const std::vector<physics::Vec3>& end) {
  Swing twin = swing;
  for (std::size_t i = 0; i < twin.cloth.particles.size(); ++i) {
    if (twin.cloth.particles.inv_mass[i] == 0) continue;
    twin.cloth.particles.x[i] += 1e-9 * Eigen::Array3d(i + 1, 2 * i + 1, 3 * i + 1).sin().matrix();
  }
  return relative_error(swing, run(twin, {Integrator::rk4}, dt).x, end);
}

/// Where the scene ends, and the remark about that.
Positions reference(const Scene& scene, double limit, Table& table) {
  const double share = scene.share;
  const auto rk4 = [&](double dt) { return run(scene.swing, {Integrator::rk4}, dt * limit); };
  const SwingRun exact = rk4(share), half = rk4(2 * share), quarter = rk4(4 * share);
  const Positions end = scene.end.empty() ? exact.x : scene.end;
  const double check = relative_error(scene.swing, half.x, end);
  const double order = std::log2(relative_error(scene.swing, quarter.x, half.x) / check);
  const SwingRun fastest = run(scene.swing, {Integrator::leapfrog}, limit);
  const double seconds = scene.swing.seconds;
  table.row(scene.name, '"' + scene.title + '"', scene.swing.cloth.particles.size(),
            scene.swing.cloth.structural.size(), seconds, limit, exact.dt, check, order,
            twin_distance(scene.swing, 4 * share * limit, quarter.x), fastest.cpu_seconds / seconds,
            double(fastest.work.force_evaluations) / seconds);
  return end;
}

std::vector<Point> all_points(const Scene& scene, const std::vector<Method>& methods, double limit,
                              const Positions& exact, bool quick) {
  std::vector<Point> points;
  for (const Method& m : methods) {
    for (const double length : m.lengths) {
      const double dt = m.of_limit ? length * limit : length, seconds = scene.swing.seconds;
      if (dt > seconds / 2) continue;
      // Of the slow methods `quick` keeps those near the limit.
      const double work = m.weight * double(scene.swing.cloth.particles.size()) * seconds / dt;
      if (work > (quick ? 6e7 : 1e9) && !(m.of_limit && length >= 0.4)) continue;
      points.push_back(measured(scene, m, dt, quick ? 3 : 5, exact));
    }
  }
  mark_fronts(points);
  return points;
}

void write_fronts(const Scene& scene, const Method& m, const std::vector<Point>& points, Table& table) {
  int count = 0, cpu = 0, passes = 0;
  for (const Point& p : points) {
    if (p.method == &m) ++count, cpu += p.on_cpu_front, passes += p.on_pass_front;
  }
  table.row(scene.name, m.name, count, cpu, passes, cost(points, m, 1e-2), cost(points, m, 1e-3),
            cost(points, m, 1e-4));
}

void chart(const Scene& scene, bool quick, Tables& tables) {
  const double limit = step_limit(scene.swing);
  const Positions exact = reference(scene, limit, tables.checks);
  const std::vector<Method> all = methods();
  const std::vector<Point> points = all_points(scene, all, limit, exact, quick);
  for (const Point& p : points) {
    const char* status = p.error < wrong ? "ok" : p.error < senseless ? "wrong" : "diverged";
    tables.points.row(scene.name, p.method->name, p.dt, p.dt / limit, p.cpu, p.passes, p.error, status,
                      p.on_cpu_front, p.on_pass_front);
  }
  for (const Method& m : all) write_fronts(scene, m, points, tables.fronts);
}

}  // namespace

void chart_work_precision(const std::string& folder, Effort effort) {
  Tables tables(folder);
  for (const Scene& scene : scenes(effort == Effort::quick)) chart(scene, effort == Effort::quick, tables);
}

}  // namespace furrow::bench
