// SPDX-License-Identifier: MIT
#include "physics/cloth/dihedral.h"

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

/// The derivatives of the flap's gradients, by the vertices p and q, as far as symmetry does not tell them.
struct FlapHessian {
  Mat3 tip_p, tip_q, p_q, q_p;  // (row, column)

  explicit FlapHessian(const Flap& f) {
    // d tip = -n/|n|^2 dl - l (1/|n|^2 - 2 n n^T/|n|^4) dn,  dn = w x dx,  n^T (w x dx) = (n x w) . dx
    const double l = std::sqrt(f.l2), skew = -l / f.n2;
    const Vec3 p = f.side - f.edge, q = -f.side, length = f.edge / (f.n2 * l);
    tip_p = skew * cross_matrix(p);
    tip_p += f.normal * ((-2 * skew / f.n2) * f.normal.cross(p) + length).transpose();
    tip_q = skew * cross_matrix(q);
    tip_q += f.normal * ((-2 * skew / f.n2) * f.normal.cross(q) - length).transpose();
    const Vec3 foot_q = (f.side - 2 * f.foot * f.edge) / f.l2, foot_p = -foot_q - f.edge / f.l2;
    p_q = f.tip * foot_q.transpose() - (1 - f.foot) * tip_q;
    q_p = -f.tip * foot_p.transpose() - f.foot * tip_p;
  }
};

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

std::array<Mat3, lower_blocks(4)> dihedral_hessian(const Vec3& x0, const Vec3& x1, const Vec3& x2,
                                                   const Vec3& x3) {
  std::array<Mat3, lower_blocks(4)> h;
  h.fill(Mat3::Zero());
  const Flap a(x0, x1, x2), b(x1, x0, x3);
  if (!a.exists() || !b.exists()) return h;
  const FlapHessian of_a(a), of_b(b);
  Mat3 &h10 = h[lower_block(1, 0)], &h20 = h[lower_block(2, 0)], &h21 = h[lower_block(2, 1)],
       &h30 = h[lower_block(3, 0)], &h31 = h[lower_block(3, 1)];  // (3, 2): tips do not know each other
  h10 = of_a.q_p + of_b.p_q;
  h20 = of_a.tip_p, h21 = of_a.tip_q;
  h30 = of_b.tip_q, h31 = of_b.tip_p;
  // A displacement of all alike changes nothing.
  h[lower_block(0, 0)] = -(h10 + h20 + h30).transpose();
  h[lower_block(1, 1)] = -(h10 + (h21 + h31).transpose());
  h[lower_block(2, 2)] = -(h20 + h21);
  h[lower_block(3, 3)] = -(h30 + h31);
  return h;
}

}  // namespace furrow::physics
