// SPDX-License-Identifier: MIT
#include "physics/base/check_particles.h"

#include <cmath>
#include <stdexcept>

namespace furrow::physics {

void check_particles(const Particles& p, const std::string& caller) {
  const auto fail = [&](const std::string& what) { throw std::invalid_argument(caller + ": " + what); };
  if (p.v.size() != p.size() || p.mass.size() != p.size() || p.inv_mass.size() != p.size())
    fail("the particles' arrays differ in length");
  for (std::size_t i = 0; i < p.size(); ++i) {
    for (const double x : p.x[i])
      if (!std::isfinite(x)) fail("a position = " + std::to_string(x) + " is not finite");
    const double m = p.mass[i];
    if (p.inv_mass[i] > 0 && !(m > 0 && std::isfinite(m)))
      fail("mass of a free particle = " + std::to_string(m) + " is not > 0");
  }
}

}  // namespace furrow::physics
