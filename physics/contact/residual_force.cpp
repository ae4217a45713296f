// SPDX-License-Identifier: MIT
#include "physics/contact/residual_force.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

#include "physics/cloth/elements.h"

namespace furrow::physics {
namespace {

/// Length of what is left of f after the best contact force along n within the cone.
double after_contact(const Vec3& f, const Vec3& n, double friction) {
  const double w_n = -f.dot(n), w_t = (f + w_n * n).norm();
  if (w_t <= friction * w_n) return 0;
  if (w_n <= -friction * w_t) return f.norm();
  return (w_t - friction * w_n) / std::sqrt(1 + friction * friction);
}

}  // namespace

double residual_of(std::span<const Vec3> force, const Particles& p, const Vec3& gravity,
                   const Collider* collider, double friction, double gap) {
  const double g = gravity.norm() > 0 ? gravity.norm() : standard_gravity;
  if (!std::isfinite(g)) return std::numeric_limits<double>::quiet_NaN();  // no force is small beside it
  double largest = 0;
  for (std::size_t i = 0; i < p.size(); ++i) {
    if (p.inv_mass[i] == 0) continue;
    const double mass = 1 / p.inv_mass[i];
    const Vec3 f = force[i] + mass * gravity;
    double rest = f.norm();
    if (collider && p.x[i].allFinite()) {
      const SignedDistance field = collider->smooth_at(p.x[i]);
      if (field.value <= gap + contact_tolerance && field.gradient.norm() > 0) {
        rest = after_contact(f, field.gradient.normalized(), friction);
      }
    }
    largest = std::isnan(rest) ? rest : std::max(largest, rest / (mass * g));
    if (std::isnan(largest)) return largest;
  }
  return largest;
}

double residual_force(const Cloth& cloth, const Vec3& gravity, const Collider* collider, double friction,
                      double gap, std::span<const Vec3> loads) {
  const Particles& p = cloth.particles;
  std::vector<Vec3> force(p.size(), Vec3::Zero());
  if (!loads.empty() && loads.size() != p.size()) {
    throw std::invalid_argument("residual_force: " + std::to_string(p.size()) + " particles, but " +
                                std::to_string(loads.size()) + " loads");
  }
  std::copy(loads.begin(), loads.end(), force.begin());
  add_forces(cloth, p.x, force);
  return residual_of(force, p, gravity, collider, friction, gap);
}

}  // namespace furrow::physics
