// SPDX-License-Identifier: MIT
#include "physics/cloth/membrane.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "physics/base/require.h"

namespace furrow::physics {
namespace {

/// The three edges of a triangle, edge i opposite corner i, from corner i + 1 to corner i + 2.
struct Edges {
  std::array<Vec3, 3> vector;
  Eigen::Vector3d longer;   // d = l^2 - L^2 [m^2]
  Eigen::Vector3d tension;  // dW/dd [N/m]
  double energy() const { return 0.5 * longer.dot(tension); }
};

Edges edges_of(std::span<const Vec3> x, const MembraneTriangle& t, const MembraneConstants& c) {
  Edges e;
  for (int i = 0; i < 3; ++i) {
    e.vector[i] = x[t.vertices[(i + 2) % 3]] - x[t.vertices[(i + 1) % 3]];
    e.longer[i] = e.vector[i].squaredNorm() - c.length2[i];
  }
  e.tension = c.quadratic * e.longer;
  return e;
}

/// Heron's. Throws std::invalid_argument if the lengths make no triangle.
double rest_area(const MembraneTriangle& t) {
  const Eigen::Vector3d l(t.rest_lengths[0], t.rest_lengths[1], t.rest_lengths[2]);
  const double half = l.sum() / 2, area = std::sqrt(half * (half - l[0]) * (half - l[1]) * (half - l[2]));
  if (!(l.minCoeff() > 0) || !(half - l.maxCoeff() > 0) || !(area > 0) || !std::isfinite(area)) {
    throw std::invalid_argument("membrane triangle: rest lengths " + std::to_string(l[0]) + ", " +
                                std::to_string(l[1]) + ", " + std::to_string(l[2]) + " make no triangle");
  }
  return area;
}

/// Of a sheet with threads, too: C11, C22 >= 0 and C11 C22 >= C12^2.
bool is_semidefinite(const MembraneTriangle& t) {
  const double plane = t.lambda + 2 * t.mu, c11 = plane + t.threads.warp, c22 = plane + t.threads.weft;
  return t.mu >= 0 && c11 >= 0 && c22 >= 0 && c11 * c22 >= t.lambda * t.lambda &&
         std::isfinite(t.threads.angle) && std::isfinite(c11 + c22);
}

void check_parameters(const MembraneTriangle& t) {
  if (t.threads.any()) {
    if (is_semidefinite(t)) return;
    throw std::invalid_argument("membrane triangle: lambda = " + std::to_string(t.lambda) + ", mu = " +
                                std::to_string(t.mu) + " with threads of " + std::to_string(t.threads.warp) +
                                " and " + std::to_string(t.threads.weft) + " are no stable sheet");
  }
  if (!(t.mu >= 0) || !(t.lambda + t.mu >= 0) || !std::isfinite(t.lambda + t.mu)) {
    throw std::invalid_argument("membrane triangle: lambda = " + std::to_string(t.lambda) +
                                " and mu = " + std::to_string(t.mu) + " are not mu >= 0, lambda + mu >= 0");
  }
}

/// p of  n^T E n = sum d_i p_i  for a unit vector n in the triangle laid flat, its edge 0 -> 1 along x.
Eigen::Vector3d strain_along(const Eigen::Vector3d& l, double area, const Eigen::Vector2d& n) {
  // Turned edges dotted with n: edges crossed with it.
  const Eigen::Vector2d b(l[2], 0),
      c((l[2] * l[2] + l[1] * l[1] - l[0] * l[0]) / (2 * l[2]), 2 * area / l[2]);
  const auto cross = [&](const Eigen::Vector2d& e) { return e.x() * n.y() - e.y() * n.x(); };
  const double t0 = cross(c - b), t1 = cross(-c), t2 = cross(b);
  return Eigen::Vector3d(t1 * t2, t2 * t0, t0 * t1) / (-8 * area * area);
}

/// The tensions t whose quadratic form  sum 2 t_i |u_{i+2} - u_{i+1}|^2  is the positive part of these'. In
/// the basis (1, -1, 0) / sqrt 2, (1, 1, -2) / sqrt 6, as (1, 1, 1) does not count, it is a 2 x 2 matrix.
Eigen::Vector3d positive_part(const Eigen::Vector3d& t) {
  const double p = t[0] + t[1] + 4 * t[2], q = std::sqrt(3.0) * (t[1] - t[0]), r = 3 * (t[0] + t[1]);
  const double mean = 0.5 * (p + r), apart = std::hypot(0.5 * (p - r), q);
  if (mean >= apart) return t;
  if (mean <= -apart) return Eigen::Vector3d::Zero();
  // Eigenvalues mean +- apart: the positive part is (M - low I) high / (high - low).
  const double low = mean - apart, share = (mean + apart) / (2 * apart);
  const double p1 = share * (p - low), q1 = share * q, r1 = share * (r - low);
  return {0.5 * (r1 / 3 - q1 / std::sqrt(3.0)), 0.5 * (r1 / 3 + q1 / std::sqrt(3.0)), 0.25 * (p1 - r1 / 3)};
}

}  // namespace

PlaneLame plane_stress(double young_times_thickness, double poisson) {
  const double y = young_times_thickness;
  require("plane_stress", "young_times_thickness", y, y >= 0, ">= 0");
  require("plane_stress", "poisson", poisson, poisson > -1 && poisson < 1, "in (-1, 1)");
  return {y * poisson / (1 - poisson * poisson), y / (2 * (1 + poisson))};
}

WovenSheet woven_sheet(const WovenModuli& m) {
  require("woven_sheet", "warp", m.warp, m.warp > 0 && std::isfinite(m.warp), "> 0");
  require("woven_sheet", "weft", m.weft, m.weft > 0 && std::isfinite(m.weft), "> 0");
  require("woven_sheet", "shear", m.shear, m.shear > 0 && std::isfinite(m.shear), "> 0");
  const double q = 1 - m.poisson * m.poisson * m.weft / m.warp;
  require("woven_sheet", "poisson", m.poisson, q > 0, "such that poisson^2 < warp / weft");
  const double c12 = m.poisson * m.weft / q;
  return {{c12, m.shear}, m.warp / q - c12 - 2 * m.shear, m.weft / q - c12 - 2 * m.shear};
}

double strip_modulus(const WovenModuli& m, double angle) {
  const double c2 = std::cos(angle) * std::cos(angle), s2 = std::sin(angle) * std::sin(angle);
  return 1 / (c2 * c2 / m.warp + s2 * s2 / m.weft + (1 / m.shear - 2 * m.poisson / m.warp) * c2 * s2);
}

MembraneConstants membrane_constants(const MembraneTriangle& t) {
  const double area = rest_area(t);
  check_parameters(t);
  const Eigen::Vector3d l(t.rest_lengths[0], t.rest_lengths[1], t.rest_lengths[2]);
  MembraneConstants c{area, l.cwiseAbs2(), {}};
  // cot a_i / (4 A),  cot a_i = (sum L^2 - 2 L_i^2) / (4 A)
  const Eigen::Vector3d trace = (c.length2.sum() - 2 * c.length2.array()) / (16 * area * area);
  Eigen::Matrix3d determinant = Eigen::Matrix3d::Constant(2);
  determinant.diagonal().setConstant(-2);
  determinant /= 64 * area * area;
  c.quadratic = area * ((t.lambda + 2 * t.mu) * trace * trace.transpose() - 2 * t.mu * determinant);
  if (t.threads.any()) {
    const Eigen::Vector2d along(std::cos(t.threads.angle), std::sin(t.threads.angle));
    const Eigen::Vector3d p = strain_along(l, area, along),
                          q = strain_along(l, area, {-along.y(), along.x()});
    c.quadratic += area * (t.threads.warp * p * p.transpose() + t.threads.weft * q * q.transpose());
  }
  return c;
}

double edge_stiffness(const MembraneConstants& c, int edge) {
  return 4 * c.length2[edge] * c.quadratic(edge, edge);
}

std::array<double, 3> edge_stiffness(const MembraneTriangle& t) {
  const MembraneConstants c = membrane_constants(t);
  return {edge_stiffness(c, 0), edge_stiffness(c, 1), edge_stiffness(c, 2)};
}

void check(const MembraneTriangle& t, std::size_t n) {
  for (int i = 0; i < 3; ++i) {
    const int v = t.vertices[i];
    if (v < 0 || std::size_t(v) >= n || v == t.vertices[(i + 1) % 3]) {
      throw std::invalid_argument("membrane triangle: names particle " + std::to_string(v) + " of " +
                                  std::to_string(n) + ", or one twice");
    }
  }
  rest_area(t);
  check_parameters(t);
}

double energy(std::span<const Vec3> x, const MembraneTriangle& t) {
  return edges_of(x, t, membrane_constants(t)).energy();
}

double add_forces(std::span<const Vec3> x, const MembraneTriangle& t, const MembraneConstants& c,
                  std::span<Vec3> force) {
  const Edges e = edges_of(x, t, c);
  for (int j = 0; j < 3; ++j) {
    const Vec3 f = 2 * e.tension[j] * e.vector[j];
    force[t.vertices[(j + 1) % 3]] += f;
    force[t.vertices[(j + 2) % 3]] -= f;
  }
  return e.energy();
}

double add_forces(std::span<const Vec3> x, const MembraneTriangle& t, std::span<Vec3> force) {
  return add_forces(x, t, membrane_constants(t), force);
}

void stiffness_blocks(std::span<const Vec3> x, const MembraneTriangle& t, Stiffness stiffness, Mat3* lower) {
  const MembraneConstants constants = membrane_constants(t);
  const Edges e = edges_of(x, t, constants);
  Eigen::Vector3d tension = e.tension;
  if (stiffness.clamped > 0 && tension.minCoeff() < 0)  // else it is semidefinite
    tension += stiffness.clamped * (positive_part(tension) - tension);
  // Columns: dd_i/dx of a corner.
  std::array<Mat3, 3> slope;
  for (int j = 0; j < 3; ++j) {
    slope[(j + 1) % 3].col(j) = -2 * e.vector[j];
    slope[(j + 2) % 3].col(j) = 2 * e.vector[j];
    slope[j].col(j).setZero();
  }
  std::array<Mat3, 3> pair;  // of the corners of each edge, the lower row first
  for (int i = 0; i < 3; ++i) {
    const int r = i == 2 ? 1 : 2, c = i == 0 ? 1 : 0;
    const Mat3 half = slope[r] * constants.quadratic;
    pair[i].noalias() = half * slope[c].transpose();
    pair[i].diagonal().array() -= 2 * tension[i];
  }
  // A displacement of all alike changes nothing.
  lower[lower_block(1, 0)] = pair[2];
  lower[lower_block(2, 0)] = pair[1];
  lower[lower_block(2, 1)] = pair[0];
  lower[lower_block(0, 0)] = -(pair[2] + pair[1]).transpose();
  lower[lower_block(1, 1)] = -(pair[2] + pair[0].transpose());
  lower[lower_block(2, 2)] = -(pair[1] + pair[0]);
}

}  // namespace furrow::physics
