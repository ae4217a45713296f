// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <span>
#include <string>

namespace furrow::io {

/// What was measured of a fabric along its threads. All 0: it is taken as the same in all directions.
struct FabricThreads {
  double warp = 0, weft = 0, shear = 0;  ///< Y1, Y2, G: moduli times thickness at small strain [N/m]
  double poisson = 0;                    ///< nu12 [-]
  double bend_warp = 0, bend_bias = 0, bend_weft = 0;  ///< B of strips at 0, 45 and 90 degrees [N m]
  double drape = 0;  ///< measured coefficient of a 30 cm disc on 18 cm [-]; 0: not measured
  bool any() const { return warp > 0; }
};

/// What was measured of a fabric; the means are for laws that are the same in all directions. SI units.
struct Fabric {
  const char* name;
  double density;    ///< [kg/m^2]
  double stretch;    ///< Young's modulus times thickness, mean of warp and weft at small strain [N/m]
  double shear;      ///< shear modulus times thickness [N/m]; for the record: an isotropic sheet has its own
  double rigidity;   ///< B, mean over the directions at the lowest curvature [N m]
  double thickness;  ///< [m]
  double friction;   ///< Coulomb's with skin [-]
  const char* source;   ///< of what was measured
  const char* assumed;  ///< which of the numbers are ours
  FabricThreads threads = {};
  double bending_friction = 0;  ///< half of Kawabata's 2HB, measured [N]; 0: not measured
  double damping = 0.02;        ///< share of critical damping of each edge [-]
};

std::span<const Fabric> fabrics();
/// Throws std::invalid_argument if there is none of this name.
const Fabric& fabric_named(const std::string& name);

/// c [N/m] of tension (bridge::GatherOptions) that stretches by physics::working_strain, 2 %, at the load at
/// which the linear `stretch` Y does: c e^2 = Y e there, so c = 50 Y. Below that load the quadratic law is
/// softer, beyond it stiffer.
double tension_constant(double stretch);
/// Of diagonals over threads [-] in [0, 1]: with which the diagonal of a cell, strained by 2 % at a shear of
/// 4 %, answers as the shear modulus G does: c s g^2 / 8 = G g, so s = 4 G / Y; knits, where that is more, 1.
double shear_ratio(const Fabric& fabric);

}  // namespace furrow::io
