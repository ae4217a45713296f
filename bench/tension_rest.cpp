// SPDX-License-Identifier: GPL-3.0-or-later
// "Something like hysteresis" of quadratic tension (method S2.4): one spring is loaded and unloaded step by
// step; after each the free end moves along the force on it, as in fast fitting, until that is below a
// tolerance. The law has no loop: what opens, and what remains without load, is the tolerance.
//   tension_rest > tension_rest.csv;  gnuplot bench/tension_rest.gp  draws it.
#include <cmath>
#include <cstdio>

#include "physics/cloth/tension_forces.h"

using namespace furrow::physics;

namespace {

constexpr Tension spring{0, 1, 0.02, 10, 2};  // c = 10 N, L = 2 cm
constexpr double largest_load = 0.02;         // N
constexpr int load_steps = 100;

/// From a strain on until |load - pull| <= tolerance. Steps of a tenth of what the slope would allow.
double settle(double strain, double load, double tolerance) {
  for (int i = 0; i < 10'000'000; ++i) {
    const double net = load - tension_law(spring, strain).force;
    if (std::abs(net) <= tolerance) return strain;
    const double slope =
        tension_law(spring, std::sqrt(largest_load / spring.stretch)).slope * spring.rest_length;
    strain += 0.1 * net / slope;
  }
  return strain;
}

}  // namespace

int main() {
  std::printf("# tolerance [N],load [N],strain [-],strain in balance [-],unloading\n");
  for (const double tolerance : {1e-5, 1e-4, 1e-3}) {
    double strain = 0;
    for (int i = 0; i <= 2 * load_steps; ++i) {
      const double load = largest_load * (1 - std::abs(1 - double(i) / load_steps));
      strain = settle(strain, load, tolerance);
      std::printf("%g,%.9g,%.9g,%.9g,%d\n", tolerance, load, strain, remaining_strain(spring.stretch, load),
                  i > load_steps);
    }
    std::fprintf(stderr, "tolerance %g N: %.4f %% remain, sqrt(f / c) = %.4f %%\n", tolerance, 100 * strain,
                 100 * remaining_strain(spring.stretch, tolerance));
  }
}
