// SPDX-License-Identifier: MIT
#include "physics/base/check_particles.h"

#include <cmath>

#include "physics/base/require.h"

namespace furrow::physics {

void check_particles(const Particles& p, const std::string& caller) {
  if (p.v.size() != p.size() || p.mass.size() != p.size() || p.inv_mass.size() != p.size())
    refuse(caller, "the particles' arrays differ in length");
  for (std::size_t i = 0; i < p.size(); ++i) {
    for (const double x : p.x[i])
      if (!std::isfinite(x)) refuse(caller, "a position = " + std::to_string(x) + " is not finite");
    const double m = p.mass[i];
    if (p.inv_mass[i] > 0 && !(m > 0 && std::isfinite(m)))
      refuse(caller, "mass of a free particle = " + std::to_string(m) + " is not > 0");
  }
}

void check_loaded_particles(const Particles& p, std::span<const Vec3> loads, const std::string& caller) {
  if (p.mass.size() != p.size() || p.inv_mass.size() != p.size())
    refuse(caller, "the particles' arrays differ in length");
  if (!loads.empty() && loads.size() != p.size())
    refuse(caller, loads.size(), " loads for ", p.size(), " particles");
  for (std::size_t i = 0; i < p.size(); ++i) {
    if (!p.x[i].allFinite()) refuse(caller, "position ", i, " is not finite");
    if (!loads.empty() && !loads[i].allFinite()) refuse(caller, "load ", i, " is not finite");
    if (p.inv_mass[i] > 0 && !(p.mass[i] > 0 && std::isfinite(p.mass[i])))
      refuse(caller, "mass of free particle ", i, " = ", std::to_string(p.mass[i]), " is not > 0");
  }
}

}  // namespace furrow::physics
