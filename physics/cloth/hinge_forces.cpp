// SPDX-License-Identifier: MIT
#include "physics/cloth/hinge_forces.h"

#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>

#include "physics/base/require.h"
#include "physics/cloth/dihedral.h"

namespace furrow::physics {
namespace {

Dihedral dihedral_of(std::span<const Vec3> x, const Hinge& h) {
  const auto& v = h.vertices;
  return dihedral(x[v[0]], x[v[1]], x[v[2]], x[v[3]]);
}

/// curvature g g^T + moment d2theta/dx2, on and below the diagonal.
void make_blocks(std::span<const Vec3> x, const Hinge& h, const Dihedral& d, double curvature, double moment,
                 Mat3* lower) {
  for (int r = 0; r < 4; ++r) {
    const Vec3 g = curvature * d.gradient[r];
    for (int c = 0; c <= r; ++c) lower[lower_block(r, c)] = g * d.gradient[c].transpose();
  }
  if (moment == 0) return;
  const auto& v = h.vertices;
  const auto hessian = dihedral_hessian(x[v[0]], x[v[1]], x[v[2]], x[v[3]]);
  for (int b = 0; b < lower_blocks(4); ++b) lower[b] += moment * hessian[b];
}

/// p - sin p without cancellation, p >= 0.
double above_sine(double p) {
  if (p > 0.1) return p - std::sin(p);
  const double q = p * p;
  return p * q / 6 * (1 - q / 20 * (1 - q / 42 * (1 - q / 72)));
}

}  // namespace

void check(const Hinge& h, std::size_t n) {
  for (int i = 0; i < 4; ++i) {
    const int v = h.vertices[i];
    if (v < 0 || std::size_t(v) >= n) {
      throw std::invalid_argument("hinge: names particle " + std::to_string(v) + " of " + std::to_string(n));
    }
    for (int j = 0; j < i; ++j) {
      if (h.vertices[j] == v) {
        throw std::invalid_argument("hinge: particle " + std::to_string(v) + " stands in it twice");
      }
    }
  }
  if (!(std::abs(h.rest_angle) <= std::numbers::pi)) {
    throw std::invalid_argument("hinge: rest angle " + std::to_string(h.rest_angle) + " is not in [-pi, pi]");
  }
  if (!(h.stiffness >= 0) || !std::isfinite(h.stiffness)) {
    throw std::invalid_argument("hinge: stiffness " + std::to_string(h.stiffness) + " is not >= 0");
  }
}

double bend(double theta, double rest_angle) {
  const double phi = theta - rest_angle;
  if (phi > std::numbers::pi) return phi - 2 * std::numbers::pi;
  return phi <= -std::numbers::pi ? phi + 2 * std::numbers::pi : phi;
}

HingeMoment hinge_moment(HingeLaw law, double k, double phi) {
  if (law == HingeLaw::linear) return {0.5 * k * phi * phi, k * phi, k};
  const double p = std::abs(phi), s = std::sin(0.5 * p);
  return {k * above_sine(p), std::copysign(2 * k * s * s, phi), k * std::abs(std::sin(p))};
}

double hinge_stiffness(double rigidity, double length, double area1, double area2, double factor) {
  const char* const operation = "hinge_stiffness";
  require(operation, "rigidity", rigidity, rigidity >= 0, ">= 0");
  require(operation, "length", length, length > 0, "> 0");
  require(operation, "area1", area1, area1 >= 0, ">= 0");
  require(operation, "area2", area2, area2 >= 0, ">= 0");
  require(operation, "area1 + area2", area1 + area2, area1 + area2 > 0, "> 0");
  require(operation, "factor", factor, factor >= 0, ">= 0");
  return factor * rigidity * length * length / (area1 + area2);
}

double energy(std::span<const Vec3> x, const Hinge& h, HingeLaw law) {
  const auto& v = h.vertices;
  const double theta = dihedral_angle(x[v[0]], x[v[1]], x[v[2]], x[v[3]]);
  return hinge_moment(law, h.stiffness, bend(theta, h.rest_angle)).energy;
}

double add_forces(std::span<const Vec3> x, const Hinge& h, HingeLaw law, std::span<Vec3> force) {
  const Dihedral d = dihedral_of(x, h);
  const HingeMoment m = hinge_moment(law, h.stiffness, bend(d.angle, h.rest_angle));
  for (int i = 0; i < 4; ++i) force[h.vertices[i]] -= m.moment * d.gradient[i];
  return m.energy;
}

void stiffness_blocks(std::span<const Vec3> x, const Hinge& h, HingeLaw law, Stiffness stiffness,
                      Mat3* lower) {
  const Dihedral d = dihedral_of(x, h);
  const HingeMoment m = hinge_moment(law, h.stiffness, bend(d.angle, h.rest_angle));
  make_blocks(x, h, d, m.curvature, (1 - stiffness.clamped) * m.moment, lower);
}

void stiffness_bound_blocks(std::span<const Vec3> x, const Hinge& h, HingeLaw law, Mat3* lower) {
  const Dihedral d = dihedral_of(x, h);
  const double moment = hinge_moment(law, h.stiffness, bend(d.angle, h.rest_angle)).moment;
  make_blocks(x, h, d, h.stiffness, moment, lower);
}

}  // namespace furrow::physics
