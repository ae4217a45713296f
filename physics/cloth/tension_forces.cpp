// SPDX-License-Identifier: MIT
#include "physics/cloth/tension_forces.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "physics/base/require.h"

namespace furrow::physics {
namespace {

/// T' n n^T + T/l (I - n n^T), on and below the diagonal.
void make_blocks(const Vec3& d, double along, double across, Mat3* lower) {
  Mat3 block = Mat3::Zero();
  const double l2 = d.squaredNorm();
  if (l2 > 0) {
    block = ((along - across) / l2) * d * d.transpose();
    block.diagonal().array() += across;
  }
  lower[0] = lower[2] = block;
  lower[1] = -block;
}

double strain_of(const Tension& t, double length) { return (length - t.rest_length) / t.rest_length; }

}  // namespace

TensionLaw tension_law(const Tension& t, double e) {
  const double c = e > 0 ? t.stretch : t.compress, size = std::abs(e);
  return {c * t.rest_length * size * size * size / 3, c * e * size, 2 * c * size / t.rest_length};
}

double remaining_strain(double stretch, double force) {
  require("remaining_strain", "stretch", stretch, stretch > 0, "> 0");
  require("remaining_strain", "force", std::min(force, 1e300), force >= 0, ">= 0");
  return std::sqrt(force / stretch);
}

double tension_slope(const Tension& tension, double strain) { return tension_law(tension, strain).slope; }

double energy(std::span<const Vec3> x, const Tension& t) {
  return tension_law(t, strain_of(t, (x[t.b] - x[t.a]).norm())).energy;
}

double add_forces(std::span<const Vec3> x, const Tension& t, std::span<Vec3> force) {
  const Vec3 d = x[t.b] - x[t.a];
  const double l = d.norm();
  const TensionLaw law = tension_law(t, strain_of(t, l));
  if (l != 0) {
    const Vec3 f = law.force / l * d;
    force[t.a] += f;
    force[t.b] -= f;
  }
  return law.energy;
}

void stiffness_blocks(std::span<const Vec3> x, const Tension& t, Stiffness stiffness, Mat3* lower) {
  const Vec3 d = x[t.b] - x[t.a];
  const double l = d.norm();
  const TensionLaw law = tension_law(t, strain_of(t, l));
  double across = l > 0 ? law.force / l : 0;
  if (across < 0) across *= 1 - stiffness.clamped;
  make_blocks(d, law.slope, across, lower);
}

void stiffness_bound_blocks(std::span<const Vec3> x, const Tension& t, Mat3* lower, double margin) {
  const Vec3 d = x[t.b] - x[t.a];
  const double e = strain_of(t, d.norm()), more = e + margin;
  const double along = tension_slope(t, std::abs(e) + margin);
  const double across = more > 0 ? tension_law(t, more).force / ((1 + more) * t.rest_length) : 0;
  make_blocks(d, along, across, lower);
}

void check(const Tension& t, std::size_t particles) {
  const auto fail = [&](const std::string& what) {
    throw std::invalid_argument("tension (" + std::to_string(t.a) + ", " + std::to_string(t.b) +
                                "): " + what);
  };
  const auto inside = [&](int i) { return i >= 0 && std::size_t(i) < particles; };
  if (!inside(t.a) || !inside(t.b)) fail("of " + std::to_string(particles) + " particles");
  if (t.a == t.b) fail("joins a particle with itself");
  if (!(t.rest_length > 0) || !std::isfinite(t.rest_length))
    fail("rest length " + std::to_string(t.rest_length) + " is not > 0");
  if (!(t.compress >= 0) || !(t.stretch >= t.compress) || !std::isfinite(t.stretch)) {
    fail("stretch = " + std::to_string(t.stretch) + ", compress = " + std::to_string(t.compress) +
         " are not 0 <= compress <= stretch");
  }
}

}  // namespace furrow::physics
