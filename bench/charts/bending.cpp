// SPDX-License-Identifier: GPL-3.0-or-later
// What bending costs and what it is worth: plain hinges and the plate on eight kinds of meshes.
#include <algorithm>
#include <cmath>

#include "bench/accuracy_table.h"
#include "bench/charts/charts.h"
#include "physics/cloth/pins.h"
#include "physics/linear/stable_step.h"
#include "physics/motion/leapfrog_step.h"
#include "tests/cases/baselines.h"
#include "tests/cases/flat_meshes.h"
#include "tests/cases/plates.h"
#include "tests/cases/swing.h"
#include "tests/physics/cloth/strips.h"
#include "tests/physics/rest/settled.h"

namespace furrow::bench {
namespace {

using namespace cases;
using physics::Cloth;
using physics::Vec3;

constexpr double strip_length = 0.1, strip_rigidity = 1e-5, strip_gamma = 25;

void add_bending(Cloth& cloth, bool plate) {
  if (plate) return add_plate(cloth, physics::isotropic_plate(strip_rigidity));
  add_flat_hinges(cloth, strip_rigidity);
  physics::stiffen_clamps(cloth);
}

/// Processor time of one leapfrog step of a sheet that has bending and nothing else [ns an inner edge].
double step_cost(SheetKind kind, bool plate) {
  Cloth cloth = sheet_of(kind, 1, 1, 40);
  cloth.structural.clear();
  int inner = 0;
  for (const EdgeApexes& e : edges_of(cloth.triangles)) inner += e.left >= 0 && e.right >= 0;
  add_bending(cloth, plate);
  physics::ThreadPool pool(1);
  physics::Motion motion(cloth, {{0, 0, 0}, 0, 0}, pool);
  const auto stepper = cases::make_stepper(motion, {physics::Integrator::leapfrog});
  std::vector<double> times;
  for (int round = 0; round < 9; ++round) {
    const double started = thread_seconds();
    for (int i = 0; i < 40; ++i) stepper->step(1e-9);
    times.push_back((thread_seconds() - started) / 40);
  }
  std::nth_element(times.begin(), times.begin() + 4, times.end());
  return 1e9 * times[4] / inner;
}

struct Hung {
  double cpu, error, twist;
  int factorisations;
};

Hung hang(SheetKind kind, int n, bool plate) {
  ClampedStrip strip = clamped_strip(kind, strip_length, strip_length / 4, n,
                                     2e5 * strip_rigidity / (strip_length * strip_length));
  add_bending(strip.cloth, plate);
  const double g = tests::gravity_for(strip_gamma, strip.density, strip.length, strip_rigidity);
  const double started = thread_seconds();
  const physics::SettleReport report =
      physics::settle(strip.cloth, nullptr, tests::down_to(1e-5, {0, 0, -g}));
  const double cpu = thread_seconds() - started;
  const auto& x = strip.cloth.particles.x;
  Vec3 tip = Vec3::Zero();
  for (const int i : strip.tip) tip += x[std::size_t(i)] / double(strip.tip.size());
  const tests::Elastica exact = tests::heavy_elastica(strip_gamma);
  const Vec3 across = x[std::size_t(strip.tip.back())] - x[std::size_t(strip.tip.front())];
  return {cpu, -tip.z() / tip.x() / (exact.height / exact.width) - 1, std::abs(across.z()) / strip.width,
          report.factorisations};
}

}  // namespace

void chart_bending(const std::string& folder, Effort effort) {
  Table table(
      folder + "/bending.csv",
      "Cantilever, Gamma 25, L x L/4, Y L^2/B = 2e5, nu = 0, from level until the residual force is 1e-5 "
      "of a vertex's weight (settle, one thread, processor time). Error: H/W against the heavy "
      "elastica. Twist: of the tip over the width. Step: 2/omega_max of the sheet's bending alone over "
      "that of plain hinges. Pass: of leapfrog, 40 x 40 cells, bending alone, ns an inner edge.",
      "mesh,law,cells,vertices,cpu[s],factorisations,error[-],twist[-],step[-],pass[ns]");
  std::vector<int> cells{8, 16, 32};
  if (effort == Effort::full) cells.push_back(64);
  for (const SheetKind kind : sheet_kinds) {
    const auto limit = [&](bool plate) {
      Cloth cloth = sheet_of(kind, 1, 1, 16);
      cloth.structural.clear();
      add_bending(cloth, plate);
      return physics::stable_step(cloth).dt_limit;
    };
    const double plain = limit(false);
    for (const bool plate : {false, true}) {
      const double pass = step_cost(kind, plate), step = plate ? limit(true) / plain : 1;
      for (const int n : cells) {
        const Hung h = hang(kind, n, plate);
        const std::size_t vertices = sheet_of(kind, 1, 0.25, n).particles.size();
        table.row(name_of(kind), plate ? "plate" : "hinge", n, vertices, h.cpu, h.factorisations, h.error,
                  h.twist, step, pass);
      }
    }
  }
}

}  // namespace furrow::bench
