// SPDX-License-Identifier: MIT
#include "physics/rest/invert_elements.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "physics/cloth/hinge_forces.h"

namespace furrow::physics {
namespace {

constexpr int most_steps = 40;
constexpr double least_stretch2 = 0.05, largest_stretch2 = 20;  // what no cloth reaches

/// Squared stretches less 1 along the axes of the stress sigma [N/m].
std::optional<Eigen::Vector2d> stretches(double lambda, double mu, const Eigen::Vector2d& sigma) {
  Eigen::Vector2d h(0, 0);
  for (int step = 0; step < most_steps; ++step) {
    const double ratio = std::sqrt((1 + h[0]) / (1 + h[1]));
    const Eigen::Vector2d root(ratio, 1 / ratio);
    const Eigen::Vector2d g = (0.5 * lambda * h.sum() + mu * h.array()).matrix();
    Eigen::Matrix2d slope;
    for (int a = 0; a < 2; ++a) {
      const int b = 1 - a;
      slope(a, a) = root[a] * (0.5 * g[a] / (1 + h[a]) + 0.5 * lambda + mu);
      slope(a, b) = root[a] * (-0.5 * g[a] / (1 + h[b]) + 0.5 * lambda);
    }
    if (!(slope.determinant() > 0) || !(slope.trace() > 0)) return std::nullopt;
    const Eigen::Vector2d move = slope.inverse() * (sigma - root.cwiseProduct(g));
    h += move;
    if (!((1 + h.array()).minCoeff() > least_stretch2) || !((1 + h.array()).maxCoeff() < largest_stretch2)) {
      return std::nullopt;
    }
    if (move.cwiseAbs().maxCoeff() <= 1e-16) return h;
    if (step >= 8 && move.cwiseAbs().maxCoeff() <= 1e-14) return h;  // round-off
  }
  return std::nullopt;
}

}  // namespace

std::optional<double> rest_length_for(double length, double stiffness, double tension) {
  if (stiffness == 0) return tension == 0 ? std::optional(length) : std::nullopt;
  const double rest = length - tension / stiffness;
  return rest > 0 ? std::optional(rest) : std::nullopt;
}

std::optional<double> rest_length_for(const Tension& law, double length, double tension) {
  if (tension == 0) return length;
  const double c = tension > 0 ? law.stretch : law.compress;
  if (!(c > 0)) return std::nullopt;
  const double rest = length / (1 + std::copysign(std::sqrt(std::abs(tension) / c), tension));
  return rest > 0 && std::isfinite(rest) ? std::optional(rest) : std::nullopt;
}

std::optional<double> rest_angle_for(HingeLaw law, double stiffness, double theta, double moment) {
  if (stiffness == 0) return moment == 0 ? std::optional(theta) : std::nullopt;
  const double share = std::abs(moment) / stiffness;
  double phi = share;
  if (law == HingeLaw::cosine) {
    if (!(share <= 2)) return std::nullopt;
    phi = 2 * std::asin(std::sqrt(0.5 * share));  // acos(1 - share) without cancellation
  }
  if (!(phi < std::numbers::pi) && law == HingeLaw::linear) return std::nullopt;
  return bend(theta, std::copysign(phi, moment));
}

std::optional<std::array<double, 3>> rest_lengths_for(const std::array<Vec3, 3>& corners, double lambda,
                                                      double mu, const Eigen::Vector3d& tension) {
  const Vec3 first = corners[1] - corners[0], normal = first.cross(corners[2] - corners[0]);
  const double area = 0.5 * normal.norm();
  const Vec3 along = first.normalized(), across = normal.cross(along).normalized();
  Eigen::Matrix<double, 2, 3> edge;
  for (int i = 0; i < 3; ++i) {
    const Vec3 e = corners[(i + 2) % 3] - corners[(i + 1) % 3];
    edge.col(i) = Eigen::Vector2d(e.dot(along), e.dot(across));
  }
  const Eigen::Matrix2d stress = 2 / area * edge * tension.asDiagonal() * edge.transpose();
  if (!stress.allFinite()) return std::nullopt;
  Eigen::Vector2d h = Eigen::Vector2d::Zero();
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> axes(stress);
  if (!stress.isZero(0)) {
    const auto found = stretches(lambda, mu, axes.eigenvalues());
    if (!found) return std::nullopt;
    h = *found;
  }
  std::array<double, 3> rest;
  for (int i = 0; i < 3; ++i) {
    const Eigen::Vector2d parts = axes.eigenvectors().transpose() * edge.col(i);
    rest[i] = std::sqrt((parts.array().square() / (1 + h.array())).sum());
  }
  return rest;
}

}  // namespace furrow::physics
