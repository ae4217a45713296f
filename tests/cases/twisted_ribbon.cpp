// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/cases/twisted_ribbon.h"

#include <Eigen/Geometry>
#include <cmath>

#include "tests/cases/flat_meshes.h"
#include "tests/cases/modes.h"

namespace furrow::cases {
namespace {

using physics::Cloth;
using physics::Vec3;

constexpr double youngs_modulus = 100;  // N/m

/// Where a point x beside the axis, at height y of a ribbon of length 1, comes to.
Vec3 on_helicoid(const Twist& twist, double width, double x, double y) {
  const double angle = 2 * twist.tau / width * (y - 0.5);
  return {x * std::cos(angle), y * (1 + twist.end_strain), x * std::sin(angle)};
}

/// Force [N] and torque [N m] about y that the forces on the chosen particles come to.
RibbonLoad total(const Cloth& cloth, const std::vector<Vec3>& force, double width, bool (*chosen)(double)) {
  RibbonLoad load{0, 0};
  for (std::size_t i = 0; i < force.size(); ++i) {
    const Vec3 &x = cloth.particles.x[i], &f = force[i];
    if (!chosen(x.y())) continue;
    load.force += f.y() / (youngs_modulus * width);
    load.torque += (x.x() * f.z() - x.z() * f.x()) / (youngs_modulus * width * width / 2);
  }
  return load;
}

}  // namespace

RibbonLoad fibre_ribbon(const Twist& t, FibreStrain strain) {
  constexpr int steps = 2000;  // Simpson; the integrands are smooth but for s = 0 at no strain
  RibbonLoad load{0, 0};
  for (int i = 0; i <= steps; ++i) {
    const double s = double(i) / steps, weight = (i == 0 || i == steps ? 1 : i % 2 ? 4 : 2) / (3.0 * steps);
    const double lambda = std::hypot(1 + t.end_strain, t.tau * s);
    const double share = strain == FibreStrain::green ? (lambda * lambda - 1) / 2 : 1 - 1 / lambda;
    load.force += weight * share * (1 + t.end_strain);
    load.torque += weight * share * t.tau * s * s;
  }
  return load;
}

RibbonLoad spring_ribbon(const Twist& twist, int fibres, int rows) {
  constexpr double width = 0.1;
  Cloth cloth;
  for (int c = 0; c < fibres; ++c) {
    const double x = width * ((c + 0.5) / fibres - 0.5);
    for (int r = 0; r <= rows; ++r) {
      const int i = c * (rows + 1) + r;
      cloth.particles.x.push_back(on_helicoid(twist, width, x, double(r) / rows));
      if (r < rows)
        cloth.structural.push_back({i, i + 1, 1.0 / rows, youngs_modulus * width / fibres * rows});
    }
  }
  std::vector<Vec3> force(cloth.particles.size(), Vec3::Zero());
  physics::add_forces(cloth, cloth.particles.x, force);
  // On the helix the springs' pulls along it cancel, so a part of the ribbon is pulled by what one section
  // carries.
  return total(cloth, force, width, [](double y) { return y < 0.25; });
}

RibbonLoad membrane_ribbon(const Twist& twist, double width, int columns, int rows) {
  Cloth cloth = right_sheet(width, 1, columns, rows, 0.1, true);
  cloth.structural.clear();
  add_flat_membrane(cloth, youngs_modulus, 0);
  add_flat_hinges(cloth, 1e-6 * youngs_modulus * width * width);
  for (std::size_t i = 0; i < cloth.particles.size(); ++i) {
    Vec3& x = cloth.particles.x[i];
    if (x.y() < 1e-9 || x.y() > 1 - 1e-9) cloth.particles.inv_mass[i] = 0;
    x = on_helicoid(twist, width, x.x() - width / 2, x.y());
  }
  find_rest(cloth, Unknowns(cloth, {true, true, true}), Vec3::Zero(), 1e-9 * youngs_modulus * width);
  std::vector<Vec3> force(cloth.particles.size(), Vec3::Zero());
  physics::add_forces(cloth, cloth.particles.x, force);
  return total(cloth, force, width, [](double y) { return y < 1e-9; });
}

}  // namespace furrow::cases
