// SPDX-License-Identifier: MIT
#pragma once
#include <vector>

#include "physics/base/particles.h"

namespace furrow::physics {

/// Where a cloth lies on a body: the body may push along the normal n and hold sideways.
struct SagContact {
  int particle;
  Vec3 normal;  ///< unit, away from the body
};
struct SagLimits {
  double strain;       ///< largest (l - L) / L of springs and tension, of triangles see SagSystem [-]
  double compression;  ///< largest (L - l) / L of springs and tension [-]
  double angle;        ///< largest |theta - theta0| of hinges [rad]
  double friction;     ///< Coulomb coefficient [-]
};

/// What elements and contacts answer to a sag w, as prestress() wants it.
struct SagForces {
  std::vector<double> structural, bending, tension;  ///< pull [N]
  std::vector<Eigen::Vector3d> membrane;             ///< dW/d(l^2) of the edges [N/m]
  std::vector<double> hinges;                        ///< moment dE/dtheta [N m]
  std::vector<Vec3> contact;                         ///< the body's on the cloth [N]
  std::vector<double> scale;  ///< of each spring, bending spring, tension, triangle, hinge, then contact: 1
                              ///< free, less on its limit
  double potential = 0;       ///< [J]; its derivative by w is what elements and contacts answer
};

}  // namespace furrow::physics
