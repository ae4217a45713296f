// SPDX-License-Identifier: MIT
#include "physics/dihedral.h"

#include <Eigen/Geometry>
#include <cmath>

namespace furrow::physics {
namespace {

constexpr double least = 1e-280;

/// Triangle (p, q, r) over the edge p-q: the share of theta's derivatives that its tip r makes.
struct Flap {
  Vec3 edge, side, normal;  // q - p, r - p, edge x side
  double l2, n2, foot;      // squares; foot of r: p + foot edge
  Vec3 tip;                 // dtheta/dr

  Flap(const Vec3& p, const Vec3& q, const Vec3& r) : edge(q - p), side(r - p), normal(edge.cross(side)) {
    l2 = edge.squaredNorm(), n2 = normal.squaredNorm();
    foot = l2 > 0 ? side.dot(edge) / l2 : 0;
    tip = exists() ? Vec3(-(std::sqrt(l2) / n2) * normal) : Vec3::Zero();
  }
  bool exists() const { return l2 * n2 > least; }
};

Mat3 cross_matrix(const Vec3& v) {
  Mat3 m;
  m << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0;
  return m;
}

double angle_between(const Flap& a, const Flap& b) {
  if (!a.exists() || !b.exists()) return 0;
  return std::atan2(a.normal.cross(b.normal).dot(a.edge) / std::sqrt(a.l2), a.normal.dot(b.normal));
}

/// Adds the derivative of the flap's gradients to the blocks of its vertices p, q, r.
void add_derivative(const Flap& f, const std::array<int, 3>& vertex, Matrix12& hessian) {
  const double l = std::sqrt(f.l2);
  // d tip = -n/|n|^2 dl - l (1/|n|^2 - 2 n n^T/|n|^4) dn
  const Mat3 by_normal = -(l / f.n2) * (Mat3::Identity() - (2 / f.n2) * f.normal * f.normal.transpose());
  const Mat3 by_length = -f.normal * f.edge.transpose() / (f.n2 * l);
  std::array<Mat3, 3> tip;
  tip[0] = by_normal * cross_matrix(f.side - f.edge) - by_length;
  tip[1] = by_normal * cross_matrix(-f.side) + by_length;
  tip[2] = by_normal * cross_matrix(f.edge);
  std::array<Vec3, 3> foot;
  foot[2] = f.edge / f.l2;
  foot[1] = (f.side - 2 * f.foot * f.edge) / f.l2;
  foot[0] = -foot[1] - foot[2];
  for (int c = 0; c < 3; ++c) {
    const Mat3 shift = f.tip * foot[c].transpose();
    hessian.block<3, 3>(3 * vertex[0], 3 * vertex[c]) += shift - (1 - f.foot) * tip[c];
    hessian.block<3, 3>(3 * vertex[1], 3 * vertex[c]) -= shift + f.foot * tip[c];
    hessian.block<3, 3>(3 * vertex[2], 3 * vertex[c]) += tip[c];
  }
}

}  // namespace

double dihedral_angle(const Vec3& x0, const Vec3& x1, const Vec3& x2, const Vec3& x3) {
  return angle_between(Flap(x0, x1, x2), Flap(x1, x0, x3));
}

Dihedral dihedral(const Vec3& x0, const Vec3& x1, const Vec3& x2, const Vec3& x3) {
  const Flap a(x0, x1, x2), b(x1, x0, x3);
  Dihedral d{angle_between(a, b), {Vec3::Zero(), Vec3::Zero(), Vec3::Zero(), Vec3::Zero()}};
  if (!a.exists() || !b.exists()) return d;
  d.gradient = {Vec3(-(1 - a.foot) * a.tip - b.foot * b.tip), Vec3(-a.foot * a.tip - (1 - b.foot) * b.tip),
                a.tip, b.tip};
  return d;
}

Matrix12 dihedral_hessian(const Vec3& x0, const Vec3& x1, const Vec3& x2, const Vec3& x3) {
  Matrix12 hessian = Matrix12::Zero();
  const Flap a(x0, x1, x2), b(x1, x0, x3);
  if (!a.exists() || !b.exists()) return hessian;
  add_derivative(a, {0, 1, 2}, hessian);
  add_derivative(b, {1, 0, 3}, hessian);
  return hessian;
}

}  // namespace furrow::physics
