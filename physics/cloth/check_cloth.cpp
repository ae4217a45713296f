// SPDX-License-Identifier: MIT
#include "physics/cloth/check_cloth.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "physics/base/require.h"
#include "physics/cloth/elements.h"

namespace furrow::physics {
namespace {

bool is_not_negative(double value) { return value >= 0 && std::isfinite(value); }

void check_arrays(const Particles& p, std::string_view operation) {
  const auto check = [&](const char* name, std::size_t n) {
    if (n != p.size()) refuse(operation, p.size(), " particles, but ", n, " of their ", name);
  };
  check("velocities", p.v.size());
  check("masses", p.mass.size());
  check("inverse masses", p.inv_mass.size());
}

void check_particle(const Particles& p, std::size_t i, std::string_view operation) {
  if (!p.x[i].allFinite()) refuse(operation, "the position of particle ", i, " is not finite");
  if (!p.v[i].allFinite()) refuse(operation, "the velocity of particle ", i, " is not finite");
  if (!is_not_negative(p.mass[i]))
    refuse(operation, "the mass of particle ", i, " = ", p.mass[i], " is not >= 0");
  if (!is_not_negative(p.inv_mass[i]))
    refuse(operation, "the inverse mass of particle ", i, " = ", p.inv_mass[i], " is not >= 0");
  if (p.inv_mass[i] > 0 && !(p.mass[i] > 0))
    refuse(operation, "the mass of free particle ", i, " = ", p.mass[i], " is not > 0");
  if (p.inv_mass[i] > 0 && !(std::abs(p.inv_mass[i] * p.mass[i] - 1) <= 1e-6))
    refuse(operation, "the inverse mass of particle ", i, " = ", p.inv_mass[i], " is neither 0 nor 1 / ",
           p.mass[i]);
}

void check_triangles(const Cloth& cloth, std::string_view operation) {
  const int n = int(cloth.particles.size());
  for (const auto& [a, b, c] : cloth.triangles)
    if (std::min({a, b, c}) < 0 || std::max({a, b, c}) >= n || a == b || b == c || c == a)
      refuse(operation, "triangle (", a, ", ", b, ", ", c, ") is not of three of ", n, " particles");
}

}  // namespace

void check_cloth(const Cloth& cloth, std::string_view operation) {
  const Particles& p = cloth.particles;
  check_arrays(p, operation);
  for (std::size_t i = 0; i < p.size(); ++i) check_particle(p, i, operation);
  check_triangles(cloth, operation);
  try {
    check_elements(cloth, p.size());
  } catch (const std::invalid_argument& fault) {
    refuse(operation, fault.what());
  }
}

void check_loads(const Cloth& cloth, std::span<const Vec3> loads, std::string_view operation) {
  const std::size_t n = cloth.particles.size();
  if (!loads.empty() && loads.size() != n) refuse(operation, loads.size(), " loads for ", n, " particles");
  for (std::size_t i = 0; i < loads.size(); ++i)
    if (!loads[i].allFinite()) refuse(operation, "load ", i, " is not finite");
}

}  // namespace furrow::physics
