// SPDX-License-Identifier: GPL-3.0-or-later
// Oscillations and friction of accuracy_cases.
#include <cmath>

#include "bench/accuracy_table.h"
#include "tests/cases/flat_meshes.h"
#include "tests/cases/friction.h"
#include "tests/cases/modes.h"
#include "tests/cases/oscillations.h"

namespace furrow::bench {

using namespace cases;
using physics::Cloth;
using physics::Vec3;

namespace {

constexpr double pi = 3.14159265358979323846;

void write_chains(const std::string& folder) {
  Table table(folder + "/chain_frequencies.csv", "Eigenvalues of M^-1 K at the exact static state.",
              "chain,length[m],masses,mode,exact[Hz],computed[Hz],error[-]");
  const auto add = [&](const char* name, double length, int masses, const Cloth& chain,
                       const std::vector<double>& exact) {
    const std::vector<double> f = computed_frequencies(chain, 0, int(exact.size()));
    for (std::size_t j = 0; j < f.size(); ++j) {
      table.row(name, length, masses, j + 1, exact[j], f[j], f[j] / exact[j] - 1);
    }
  };
  add("walled", 21, 20, walled_chain(20, 0.01, 100), walled_chain_frequencies(20, 0.01, 100));
  for (const double length : {0.25, 0.5, 1.0}) {
    for (const int links : {4, 8, 16, 32, 64}) {
      add("hanging", length, links, hanging_chain(links, length),
          hanging_chain_frequencies(links, length, 3));
    }
  }
}

void write_leapfrog(const std::string& folder) {
  Table table(folder + "/leapfrog_oscillator.csv", "x'' = -w^2 x from rest, 20000 steps.",
              "z=w*dt,exact_ratio[-],measured_ratio[-],error[-],energy_least[-],energy_most[-]");
  for (const double z : {0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1.0, 1.5, 1.9}) {
    const LeapfrogRun run = run_oscillator(z, 20000);
    const double exact = 2 * std::asin(z / 2) / z;
    table.row(z, exact, run.frequency_ratio, run.frequency_ratio / exact - 1, run.energy_least,
              run.energy_most);
  }
}

void write_limits(const std::string& folder) {
  Table table(folder + "/located_limits.csv", "Step limit found by running leapfrog, over 2/omega_max.",
              "case,jitter[h],steps,limit[s],located[-],C=limit/(h^2*sqrt(rho/B))");
  const std::array<bool, 3> along{true, false, false}, across{false, false, true};
  table.row("oscillator", 0, 20000, 0.1, located_limit(walled_chain(1, 0.1, 20), 20, 20000, along), "");
  const double omega = 2 * pi * walled_chain_frequencies(20, 0.01, 100).back();
  table.row("walled_chain", 0, 20000, 2 / omega,
            located_limit(walled_chain(20, 0.01, 100), omega, 20000, along), "");
  const double h = 1.0 / 24, rigidity = 1e-5, density = 0.15;
  for (const double jitter : {0.0, 0.2, 0.3}) {
    Cloth plate = triangular_sheet(1, 1, 24, equilateral_rows(1, 1, 24), density, jitter);
    plate.structural.clear();
    add_flat_hinges(plate, rigidity);
    const Unknowns unknowns(plate, {false, false, true});
    const double limit =
        2 / highest_frequency(stiffness(plate, plate.particles.x, unknowns), masses(plate, unknowns));
    table.row("hinges", jitter, 4000, limit, located_limit(plate, 2 / limit, 4000, across),
              limit / (h * h * std::sqrt(density / rigidity)));
  }
}

void write_drums(const std::string& folder) {
  Table table(folder + "/membrane_frequencies.csv", "Stretched membrane triangles, pinned border.",
              "T[N/m],rho[kg/m^2],a[m],b[m],columns,jitter[h],mode,exact[Hz],computed[Hz],error[-]");
  const double sheets[][4] = {{10, 0.15, 0.5, 0.5}, {50, 0.2, 0.4, 0.3}, {5, 0.1, 0.6, 0.4}};
  for (const auto& [tension, rho, a, b] : sheets) {
    const double exact[] = {drum_frequency(tension, rho, a, b, 1, 1),
                            drum_frequency(tension, rho, a, b, 2, 1),
                            drum_frequency(tension, rho, a, b, 1, 2)};
    for (const double jitter : {0.0, 0.2}) {
      for (const int columns : {8, 16, 32, 64}) {
        const auto f = computed_frequencies(drum(tension, rho, a, b, columns, jitter), 2, 3);
        for (int i = 0; i < 3; ++i) {
          table.row(tension, rho, a, b, columns, jitter, i + 1, exact[i], f[std::size_t(i)],
                    f[std::size_t(i)] / exact[i] - 1);
        }
      }
    }
  }
}

void write_plates(const std::string& folder) {
  Table table(
      folder + "/plate_frequencies.csv",
      "Hinges. square: supported, 13 or 26 columns make equilateral rows. strip: clamped, against the "
      "beam's frequency, of which a plate with nu = -1/3 has 0.943 (narrow) to 1 (wide).",
      "plate,D[N*m],rho[kg/m^2],L[m],width[m],cells,jitter[h],exact[Hz],computed[Hz],error[-]");
  const double plates[][3] = {{1e-5, 0.15, 0.05}, {1e-5, 0.15, 0.1}, {5e-5, 0.3, 0.1}, {2e-6, 0.1, 0.04}};
  for (const auto& [d, rho, side] : plates) {
    for (const double jitter : {0.0, 0.2}) {
      for (const int n : {8, 13, 16, 26, 52}) {
        const double exact = supported_plate_frequency(d, rho, side),
                     f = computed_frequencies(supported_plate(d, rho, side, n, jitter), 2, 1)[0];
        table.row("square", d, rho, side, side, n, jitter, exact, f, f / exact - 1);
      }
      for (const int n : {8, 16, 32}) {
        for (const double width : {side / 4, side / 2, side * 2}) {
          const double exact = cantilever_frequency(d, rho, side),
                       f = computed_frequencies(cantilever(d, rho, side, width, n, jitter), 2, 1)[0];
          table.row("strip", d, rho, side, width, n, jitter, exact, f, f / exact - 1);
        }
      }
    }
  }
}

void write_incline(const std::string& folder) {
  Table table(
      folder + "/incline_threshold.csv",
      "A sheet of 25 vertices on an incline; creep: farthest way in 2 s at 0.2 degrees below, over 2 s.",
      "mu[-],dt[s],exact[deg],located[deg],error[deg],creep[um/s]");
  for (const double dt : {1e-3, 2e-4}) {
    for (int i = 1; i <= 29; i += dt < 1e-3 ? 7 : 1) {
      const double mu = 0.05 * i, exact = std::atan(mu), found = incline_threshold(mu, dt), degree = 180 / pi;
      table.row(mu, dt, exact * degree, found * degree, (found - exact) * degree,
                1e6 / 2 * slide_of_sheet(exact - 0.2 / degree, mu, dt));
    }
  }
}

void write_strips(const std::string& folder) {
  Table table(
      folder + "/heavy_strips.csv",
      "Length that hangs down when a strip begins to slip. balanced: of the polygon, without time.",
      "case,mu[-],R[m],other_length[m],springs_per_half_turn,exact[m],simulated[m],error[-],balanced[m],"
      "balanced_error[-]");
  const auto add = [&](const char* name, double mu, double radius, double other, int half_turn, double exact,
                       const CriticalLength& found) {
    table.row(name, mu, radius, other, half_turn, exact, found.simulated, found.simulated / exact - 1,
              found.balanced, found.balanced / exact - 1);
  };
  for (const double mu : {0.1, 0.2, 0.3, 0.4, 0.5}) {
    for (const double radius : {0.02, 0.05, 0.1}) {
      const Cylinder cylinder(radius - 0.003);
      for (const int half_turn : {16, 32, 64}) {
        const double exact = capstan_length(mu, radius, 0.1);
        const auto make = [&](double right) { return strip_over_cylinder(radius, 0.1, right, half_turn); };
        add("capstan", mu, radius, 0.1, half_turn, exact,
            critical_length(make, cylinder, 0.8 * exact, 1.23 * exact, {mu}));
      }
    }
  }
  for (const double mu : {0.2, 0.3, 0.5, 0.8}) {
    for (const double radius : {0.005, 0.02}) {
      const RoundedTable table_body(radius - radius / 5);
      const double exact = tablecloth_length(mu, radius, 0.2);
      const auto make = [&](double right) { return strip_over_edge(radius, 0.2, right, 16); };
      add("tablecloth", mu, radius, 0.2, 32, exact,
          critical_length(make, table_body, 0.8 * exact, 1.23 * exact, {mu, radius / 5}));
    }
  }
}

void write_braking(const std::string& folder) {
  Table table(folder + "/braking.csv", "A particle on a floor until it stands.",
              "mu[-],speed[m/s],dt[s],exact[m],measured[m],error[-]");
  for (const double mu : {0.1, 0.4, 0.8}) {
    for (const double speed : {0.5, 1.5}) {
      for (const double dt : {2e-3, 1e-3, 1e-4}) {
        Cloth cloth;
        cloth.particles.x = {{0, 0.003, 0}};
        cloth.particles.v = {{speed, 0, 0}};
        cloth.particles.mass = {1e-4};
        cloth.particles.inv_mass = {1e4};
        physics::SimulateOptions options;
        options.friction = mu, options.dt = dt, options.air_drag = 0;
        const Plane floor(Vec3::UnitY());
        simulate(cloth, &floor, options);
        const double exact = speed * speed / (2 * mu * 9.81), way = cloth.particles.x[0].x();
        table.row(mu, speed, dt, exact, way, way / exact - 1);
      }
    }
  }
}

}  // namespace

void write_oscillations(const std::string& folder) {
  write_chains(folder);
  write_leapfrog(folder);
  write_limits(folder);
  write_drums(folder);
  write_plates(folder);
}

void write_friction(const std::string& folder) {
  write_braking(folder);
  write_incline(folder);
  write_strips(folder);
}

}  // namespace furrow::bench
