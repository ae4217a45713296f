// SPDX-License-Identifier: MIT
// The physics alone, which is MIT and needs only Eigen and METIS: two particles and a spring fall as Galileo
// says.
#include <cmath>

#include "furrow/version.h"
#include "physics/motion/simulate.h"

static_assert(FURROW_VERSION_MAJOR >= 0 && FURROW_VERSION_MINOR >= 0);

int main() {
  using namespace furrow::physics;
  Cloth cloth;
  cloth.particles = {{{0, 0, 0}, {1, 0, 0}}, {{0, 0, 0}, {0, 0, 0}}, {1, 1}, {1, 1}};
  cloth.structural = {{0, 1, 1.0, 100.0}};  // particles, rest length [m], stiffness [N/m]
  SimulateOptions options;
  options.seconds = 1;
  options.air_drag = 0;
  const Collider* no_body = nullptr;
  simulate(cloth, no_body, options);
  return std::abs(cloth.particles.x[0].y() + 9.81 / 2) < 1e-9 ? 0 : 1;  // g t^2 / 2
}
