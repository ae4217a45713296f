// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <array>
#include <vector>

#include "physics/cloth/cloth.h"

namespace furrow::cases {

/// Cloths at rest whose frequencies are known, and these frequencies [Hz]. g = 9.81 m/s^2.

/// `masses` particles of `mass` [kg] between two walls on x, springs k [N/m] without tension.
physics::Cloth walled_chain(int masses, double mass, double k);
/// omega_j = 2 sqrt(k/m) sin(j pi / (2 (N + 1))), the lowest first.
std::vector<double> walled_chain_frequencies(int masses, double mass, double k);

/// `links` equal links of together `length` [m] under the pinned top, with a mass of 1/links kg below each,
/// at the exact static state: springs of k = 1e4 m g / link [N/m] are shorter at rest by as much as the
/// weight below stretches them. Swings along x as the inextensible chain does.
physics::Cloth hanging_chain(int links, double length);
/// omega^2 = g/l times the zeros of the Laguerre polynomial L_N, by its Jacobi matrix (Golub and Welsch).
std::vector<double> hanging_chain_frequencies(int links, double length, int count);

/// A rectangle of membrane triangles under the isotropic tension [N/m], density [kg/m^2] as it lies, border
/// pinned. columns: over the width.
physics::Cloth drum(double tension, double density, double width, double height, int columns,
                    double jitter = 0);
/// f_pq = 1/2 sqrt(T/rho) sqrt((p/a)^2 + (q/b)^2)
double drum_frequency(double tension, double density, double width, double height, int p, int q);

/// A square plate of hinges, border held but free to turn.
physics::Cloth supported_plate(double rigidity, double density, double side, int columns, double jitter = 0);
double supported_plate_frequency(double rigidity, double density, double side);  ///< pi/L^2 sqrt(D/rho)

/// A strip of hinges that stands out `length` from a clamp: one row behind the clamped edge is held, too, and
/// the hinges on that edge count twice.
physics::Cloth cantilever(double rigidity, double density, double length, double width, int rows,
                          double jitter = 0);
double cantilever_frequency(double rigidity, double density, double length);  ///< of a beam

/// Frequencies [Hz] of the motions along one axis (0, 1, 2), computed from the elements' stiffness.
std::vector<double> computed_frequencies(const physics::Cloth& cloth, int axis, int count);

/// What leapfrog does with x'' = -omega^2 x, run with z = omega dt for some steps from rest.
struct LeapfrogRun {
  double frequency_ratio;            ///< of the run over omega [-]; exact: 2 asin(z/2) / z
  double energy_least, energy_most;  ///< over that at the start [-]; exact: within [1 - z^2/4, 1]
};
LeapfrogRun run_oscillator(double z, int steps);

/// The step beyond which a run of `steps` steps from tiny noise grows 1e6-fold, over 2/omega_max [-], by
/// bisection to 1e-4. The cloth lies at rest, without weight. axes: along which the noise acts; omega_max
/// [1/s].
double located_limit(const physics::Cloth& cloth, double omega_max, int steps,
                     const std::array<bool, 3>& axes);

}  // namespace furrow::cases
