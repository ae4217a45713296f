// SPDX-License-Identifier: MIT
#pragma once
#include <vector>

#include "physics/cloth/cloth.h"

namespace furrow::physics {

/// Internal friction of bending: a real hysteresis loop (method S2.4; the option is ours). Beside each hinge
/// of a cloth stands a second one, at the end of cloth.hinges, whose rest angle theta_p creeps along:
///   moment = k_f (theta - theta_p),  |moment| <= limit,
/// elastic up to the limit, then sliding without hardening (Prandtl's element). So elements, integrators and
/// solvers know it as hinges with theta_p fixed; only update_friction() moves theta_p. The rest angles of
/// these hinges are the state: keep them, not this list, from run to run.
/// A hinge of stiffness k beside it has the loop of width  2 limit  in the moment, of area
///   4 limit (theta_m - limit / k_f)  [J]  a cycle between -theta_m and theta_m >= limit / k_f,
/// and, let go from theta_m, keeps the angle  k_f / (k + k_f) (theta_m - limit / k_f), at least 0 and at most
/// limit / k.
struct HingeFriction {
  int first = 0;              ///< cloth.hinges[first + i] is the friction of hinge i
  std::vector<double> limit;  ///< of each [N m]; >= 0
};

struct HingeFrictionOptions {
  double stiffness = 1;  ///< k_f over the hinge's own stiffness [-]; > 0
  double moment = 1e-5;  ///< limit a metre of edge [N]; >= 0; Kawabata's 2HB is twice that, in N
};

/// Adds the hinges, at rest where the others are; edges as long as they lie. Without calling it nothing
/// changes. O(hinges). Throws std::invalid_argument, nothing changed, if an option is out of its range, the
/// law is not linear, or as the elements do.
HingeFriction add_hinge_friction(Cloth& cloth, const HingeFrictionOptions& options);

/// The return mapping at the cloth's positions: where |moment| is above the limit, theta_p follows until it
/// is the limit. Call it after each converged state, or each step; for rest with friction settle() and this
/// in turns, until no theta_p moves (a round leaves about k_f / (k + k_f) of the slip; the state depends on
/// the path). Returns the largest move of a theta_p [rad]. O(hinges). Throws std::invalid_argument if the
/// friction is not this cloth's.
double update_friction(Cloth& cloth, const HingeFriction& friction);

}  // namespace furrow::physics
