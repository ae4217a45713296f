// SPDX-License-Identifier: MIT
#include "physics/plate/plate_rigidity.h"

#include <cmath>

#include "physics/base/require.h"

namespace furrow::physics {
namespace {

bool is_nothing(const PlateRigidity& p) { return p.warp == 0 && p.weft == 0 && p.twist == 0; }

void check(const PlateRigidity& p) {
  const char* const me = "plate_rigidity";
  if (is_nothing(p)) return;
  require(me, "warp", p.warp, p.warp > 0, "> 0");
  require(me, "weft", p.weft, p.weft > 0, "> 0");
  require(me, "twist", p.twist, p.twist > 0, "> 0");
  require(me, "poisson", p.poisson, p.poisson * p.poisson < p.warp / p.weft, "within sqrt(warp / weft)");
}

}  // namespace

PlateRigidity isotropic_plate(double rigidity, double poisson) {
  const char* const me = "isotropic_plate";
  require(me, "rigidity", rigidity, rigidity >= 0, ">= 0");
  require(me, "poisson", poisson, poisson > -1 && poisson < 1, "in (-1, 1)");
  return {rigidity, rigidity, rigidity / (2 * (1 + poisson)), poisson};
}

double twist_of_bias(double warp, double weft, double bias, double poisson) {
  const char* const me = "twist_of_bias";
  require(me, "warp", warp, warp > 0, "> 0");
  require(me, "weft", weft, weft > 0, "> 0");
  require(me, "bias", bias, bias > 0, "> 0");
  const double inverse = 4 / bias - 1 / warp - 1 / weft + 2 * poisson / warp;
  require(me, "bias", bias, inverse > 0, "that of a plate with this warp and weft");
  return 1 / inverse;
}

Eigen::Matrix3d plate_matrix(const PlateRigidity& p, double angle) {
  check(p);
  if (is_nothing(p)) return Eigen::Matrix3d::Zero();
  const double q = 1 - p.poisson * p.poisson * p.weft / p.warp, d12 = p.poisson * p.weft / q;
  Eigen::Matrix3d d, turn;
  d << p.warp / q, d12, 0, d12, p.weft / q, 0, 0, 0, p.twist;
  // The curvatures in the axes of warp and weft, of those in axes that the warp leads by the angle.
  const double c = std::cos(angle), s = std::sin(angle);
  turn << c * c, s * s, c * s, s * s, c * c, -c * s, -2 * c * s, 2 * c * s, c * c - s * s;
  return turn.transpose() * d * turn;
}

}  // namespace furrow::physics
