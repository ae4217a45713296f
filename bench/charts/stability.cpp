// SPDX-License-Identifier: GPL-3.0-or-later
// Where integrators are stable, wrong or diverge: step x stiffness x mesh x law.
#include <atomic>
#include <cmath>
#include <mutex>
#include <thread>
#include <vector>

#include "bench/accuracy_table.h"
#include "bench/charts/charts.h"
#include "tests/cases/swing.h"

namespace furrow::bench {
namespace {

using namespace cases;
using physics::Integrator;

/// One row of cells.
struct Series {
  const char* integrator;
  physics::StepperOptions options;
  const char* law_name;
  MembraneLaw law;
  double jitter, stiffness;
  std::vector<double> ratios;  ///< dt over 2/omega_max
};

struct Cell {
  const Series* series;
  int place;  ///< of the step in the series, from 1
  double ratio, limit, gershgorin, error;
};

std::vector<double> spread(double low, double high, int count) {
  std::vector<double> values;
  for (int i = 0; i < count; ++i) values.push_back(low * std::pow(high / low, double(i) / (count - 1)));
  return values;
}

std::vector<Series> all_series(Effort effort) {
  const std::pair<const char*, MembraneLaw> laws[] = {{"paper", MembraneLaw::paper},
                                                      {"uniform", MembraneLaw::uniform},
                                                      {"inverse", MembraneLaw::inverse},
                                                      {"van_gelder", MembraneLaw::van_gelder}};
  // Powers of 2^(1/4) and finer ones about the limits of leapfrog and RK4.
  const std::vector<double> explicit_ratios{0.25, 0.35, 0.5,  0.71, 0.85, 0.93, 0.98, 1.03, 1.1,
                                            1.2,  1.3,  1.38, 1.45, 1.6,  2,    2.8,  4};
  std::vector<Series> list;
  const int per_decade = effort == Effort::quick ? 2 : 4;
  for (int i = 4 * per_decade; i >= 0; --i) {  // the stiffest, slowest first
    const double k = 10 * std::pow(10.0, double(i) / per_decade);
    for (const double jitter : {0.0, 0.3}) {
      for (const auto& [name, law] : laws) {
        list.push_back({"leapfrog", {Integrator::leapfrog}, name, law, jitter, k, explicit_ratios});
      }
      list.push_back({"RK4", {Integrator::rk4}, "paper", laws[0].second, jitter, k, explicit_ratios});
      list.push_back(
          {"implicit", {Integrator::implicit}, "paper", laws[0].second, jitter, k, spread(2, 256, 15)});
    }
  }
  return list;
}

/// The limit by the largest sum of stiffness around a particle: safe without any eigenvalue.
double gershgorin_limit(const physics::Cloth& cloth) {
  std::vector<double> sum(cloth.particles.size(), 0.0);
  for (const physics::Spring& s : cloth.structural) sum[s.a] += s.stiffness, sum[s.b] += s.stiffness;
  double most = 0;
  for (std::size_t i = 0; i < sum.size(); ++i)
    most = std::max(most, 2 * sum[i] * cloth.particles.inv_mass[i]);
  return 2 / std::sqrt(most);
}

std::vector<Cell> cells(const Series& s) {
  const Swing swing = sheet_swing({.columns = 8,
                                   .stiffness = s.stiffness,
                                   .jitter = s.jitter,
                                   .law = s.law,
                                   .spring_damping = 0,
                                   .seconds = 0.2});
  const double limit = step_limit(swing), safe = gershgorin_limit(swing.cloth);
  const SwingRun exact = run(swing, {Integrator::rk4}, 0.35 * limit);
  std::vector<Cell> result;
  for (const double ratio : s.ratios) {
    if (ratio * limit > swing.seconds / 2) break;
    const SwingRun end = run(swing, s.options, ratio * limit);
    const double error = relative_error(swing, end.x, exact.x);
    result.push_back({&s, int(result.size()) + 1, end.dt / limit, limit, safe,
                      end.diverged || !(error < 3) ? INFINITY : error});
  }
  return result;
}

const char* verdict(double error) {
  return error < 0.01 ? "stable" : error < 0.1 ? "rough" : error < 3 ? "wrong" : "diverged";
}

}  // namespace

void chart_stability(const std::string& folder, Effort effort) {
  Table table(folder + "/stability.csv",
              "Sheet of 95 vertices that swings 0.2 s, air drag 0.2 1/s, no other damping. Error against "
              "RK4, relative to the way: stable < 0.01 <= rough < 0.1 <= wrong < 3 <= "
              "diverged. limit: 2/omega_max at rest; safe: Gershgorin's bound for it.",
              "integrator,law,jitter[h],k[N/m],place,dt/limit[-],limit[s],safe/limit[-],error[-],status");
  const std::vector<Series> series = all_series(effort);
  std::vector<std::vector<Cell>> found(series.size());
  std::atomic<std::size_t> next{0};
  std::vector<std::jthread> workers;
  for (int w = 0; w < 2; ++w) {
    workers.emplace_back([&] {
      for (std::size_t i = next++; i < series.size(); i = next++) found[i] = cells(series[i]);
    });
  }
  workers.clear();
  for (const auto& row : found) {
    for (const Cell& c : row) {
      table.row(c.series->integrator, c.series->law_name, c.series->jitter, c.series->stiffness, c.place,
                c.ratio, c.limit, c.gershgorin / c.limit, c.error, verdict(c.error));
    }
  }
}

}  // namespace furrow::bench
