// SPDX-License-Identifier: MIT
#include "physics/rest/invert_elements.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

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

/// In the triangle's plane, the first axis along its edge from corner 0 to corner 1.
struct PlaneState {
  Eigen::Matrix<double, 2, 3> edge;  // opposite each corner [m]
  Eigen::Matrix2d stress;            // [N/m]
};

PlaneState edges_and_stress(const std::array<Vec3, 3>& corners, const Eigen::Vector3d& tension) {
  const Vec3 first = corners[1] - corners[0], normal = first.cross(corners[2] - corners[0]);
  const double area = 0.5 * normal.norm();
  const Vec3 along = first.normalized(), across = normal.cross(along).normalized();
  PlaneState state;
  for (int i = 0; i < 3; ++i) {
    const Vec3 e = corners[(i + 2) % 3] - corners[(i + 1) % 3];
    state.edge.col(i) = Eigen::Vector2d(e.dot(along), e.dot(across));
  }
  state.stress = 2 / area * state.edge * tension.asDiagonal() * state.edge.transpose();
  return state;
}

/// C11, C22, C12, C33 of a triangle with threads [N/m].
struct WovenLaw {
  double warp, weft, both, shear;
};

/// sigma of F = (a, b; 0, c) as (warp, across, shear) [N/m], and its derivatives by a, b, c.
std::pair<Eigen::Vector3d, Eigen::Matrix3d> woven_stress(const WovenLaw& law, const Eigen::Vector3d& f) {
  using Eigen::Vector3d;
  const double a = f[0], b = f[1], c = f[2];
  // E11, E22 and E12 of Green's strain, and their gradients.
  const double e11 = 0.5 * (a - 1) * (a + 1), e22 = 0.5 * ((c - 1) * (c + 1) + b * b), e12 = 0.5 * a * b;
  const Vector3d g11(a, 0, 0), g22(0, b, c), g12(0.5 * b, 0.5 * a, 0);
  const double s11 = law.warp * e11 + law.both * e22, s22 = law.both * e11 + law.weft * e22,
               s12 = 2 * law.shear * e12;
  const Vector3d d11 = law.warp * g11 + law.both * g22, d22 = law.both * g11 + law.weft * g22,
                 d12 = 2 * law.shear * g12;
  const double along = a * s11 / c + 2 * b * s12 / c + b * b * s22 / (a * c), across = c * s22 / a,
               shear = s12 + b * s22 / a;
  Eigen::Matrix3d slope;
  slope.row(0) =
      (a / c * d11 + 2 * b / c * d12 + b * b / (a * c) * d22 +
       Vector3d(s11 / c - b * b * s22 / (a * a * c), 2 * s12 / c + 2 * b * s22 / (a * c), -along / c))
          .transpose();
  slope.row(1) = (c / a * d22 + Vector3d(-c * s22 / (a * a), 0, s22 / a)).transpose();
  slope.row(2) = (d12 + b / a * d22 + Vector3d(-b * s22 / (a * a), s22 / a, 0)).transpose();
  return {{along, across, shear}, slope};
}

/// F = (a, b; 0, c) of the stress sigma.
std::optional<Eigen::Vector3d> woven_stretches(const WovenLaw& law, const Eigen::Vector3d& sigma) {
  Eigen::Vector3d f(1, 0, 1);
  for (int step = 0; step < most_steps; ++step) {
    const auto [stress, slope] = woven_stress(law, f);
    if (!(slope(0, 0) > 0) || !(slope(1, 2) > 0)) return std::nullopt;  // threads give way
    const Eigen::Vector3d move = slope.partialPivLu().solve(sigma - stress);
    f += move;
    const double least = std::min(f[0], f[2]), most = std::max({f[0], f[2], std::abs(f[1])});
    if (!(least > std::sqrt(least_stretch2)) || !(most * most < largest_stretch2)) return std::nullopt;
    if (move.cwiseAbs().maxCoeff() <= 1e-16) return f;
    if (step >= 8 && move.cwiseAbs().maxCoeff() <= 1e-12) return f;  // round-off
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
  const auto [edge, stress] = edges_and_stress(corners, tension);
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

std::optional<WovenRest> rest_of_woven(const std::array<Vec3, 3>& corners, const MembraneTriangle& law,
                                       double along, const Eigen::Vector3d& tension) {
  const auto [edge, stress] = edges_and_stress(corners, tension);
  if (!stress.allFinite()) return std::nullopt;
  const Eigen::Rotation2Dd turn(along);
  const Eigen::Matrix2d axes = turn.toRotationMatrix(), turned = axes.transpose() * stress * axes;
  const double plane = law.lambda + 2 * law.mu;
  const auto f = woven_stretches({plane + law.threads.warp, plane + law.threads.weft, law.lambda, law.mu},
                                 {turned(0, 0), turned(1, 1), turned(0, 1)});
  if (!f) return std::nullopt;
  Eigen::Matrix2d back;  // F^-1
  back << 1 / (*f)[0], -(*f)[1] / ((*f)[0] * (*f)[2]), 0, 1 / (*f)[2];
  WovenRest rest;
  for (int i = 0; i < 3; ++i) rest.lengths[i] = (back * (axes.transpose() * edge.col(i))).norm();
  const Eigen::Vector2d first = back * (axes.transpose() * edge.col(2));
  rest.angle = -std::atan2(first.y(), first.x());
  return rest;
}

}  // namespace furrow::physics
