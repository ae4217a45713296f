// SPDX-License-Identifier: MIT
#pragma once
#include <Eigen/Core>
#include <array>
#include <optional>

#include "physics/cloth/cloth.h"

namespace furrow::physics {

/// The laws of elements turned round: which rest state makes an element answer its present shape with a
/// wanted force. Stiffnesses stay. Cost: constant; a triangle takes a few Newton steps in two unknowns. None,
/// if the law has no such rest state.

/// L [m] of a spring of length l [m] with the tension t [N]:  L = l - t / k.  None unless L > 0; without
/// stiffness only t = 0, L = l.
std::optional<double> rest_length_for(double length, double stiffness, double tension);

/// L [m] of a Tension of length l [m] that pulls with t [N] (< 0: pushes), whatever its rest length:
///   L = l / (1 + e),  e = sqrt(t / stretch), or  e = - sqrt(-t / compress).
/// None if |t| >= compress where it pushes, or without stretch; t = 0 gives l.
std::optional<double> rest_length_for(const Tension& law, double length, double tension);

/// theta0 [rad] in [-pi, pi] of a hinge at the angle theta [rad] with the moment dE/dtheta = tau [N m]:
/// linear  theta0 = theta - tau / k,  none if |tau| >= pi k;  cosine
///   theta0 = theta - phi,  sin(|phi| / 2) = sqrt(|tau| / (2 k)),  phi with the sign of tau;  none if |tau| >
///   2 k.
/// Without stiffness only tau = 0, theta0 = theta.
std::optional<double> rest_angle_for(HingeLaw law, double stiffness, double theta, double moment);

/// Rest lengths [m] of a membrane triangle with these corners [m], for the tensions s_i = dW/d(l_i^2) [N/m]
/// of the edges opposite them. s is the stress  sigma = sum 2 s_i e_i e_i^T / A  in the triangle's plane. The
/// law is isotropic: rest shape and stress share their axes, and with squared stretches c_1, c_2 along them
///   sigma_1 = sqrt(c_1 / c_2) (lambda/2 (c_1 + c_2 - 2) + mu (c_1 - 1)),  sigma_2 alike,
///   L_i^2 = sum_a (e_i . p_a)^2 / c_a.
/// None if Newton's method finds no c from 1 on with a positive definite slope: St. Venant and Kirchhoff's
/// law bears no compression beyond about 0.19 Y along one axis. Needs a triangle with area and mu > 0;
/// without stiffness (both 0) only s = 0.
std::optional<std::array<double, 3>> rest_lengths_for(const std::array<Vec3, 3>& corners, double lambda,
                                                      double mu, const Eigen::Vector3d& tension);

/// Rest lengths, and the angle of the warp in them.
struct WovenRest {
  std::array<double, 3> lengths;  ///< [m]
  double angle;                   ///< to the edge from corner 0 to corner 1 at rest [rad]
};
/// The same of a triangle with threads. `along`: the angle of the warp to the edge from corner 0 to corner 1
/// as the triangle lies [rad]: the thread stays there, its angle at rest follows. With warp and weft as axes
/// of rest and the warp as first axis now the deformation is triangular, F = (a, b; 0, c), and
///   sigma = F S F^T / (a c),  S = C E,  2 E = F^T F - 1,  L_i = |F^-1 e_i|.
/// None if Newton's method finds no (a, b, c) from (1, 0, 1) on at which either thread bears more for more.
std::optional<WovenRest> rest_of_woven(const std::array<Vec3, 3>& corners, const MembraneTriangle& law,
                                       double along, const Eigen::Vector3d& tension);

}  // namespace furrow::physics
