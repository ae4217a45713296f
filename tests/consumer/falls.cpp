// SPDX-License-Identifier: MIT
#include <cmath>

#include "physics/simulate.h"

/// A free particle beside a spring falls g t^2 / 2.
int main() {
  using namespace furrow::physics;
  Cloth cloth;
  cloth.particles = {{{0, 0, 0}, {1, 0, 0}}, {{0, 0, 0}, {0, 0, 0}}, {1, 1}, {1, 1}};
  cloth.structural = {{0, 1, 1.0, 100.0}};
  SimulateOptions options;
  options.seconds = 1;
  options.air_drag = 0;
  simulate(cloth, nullptr, options);
  return std::abs(cloth.particles.x[0].y() + 9.81 / 2) < 1e-9 ? 0 : 1;
}
