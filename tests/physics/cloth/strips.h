// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <cstdint>
#include <vector>

#include "physics/cloth/cloth.h"

namespace furrow::tests {

/// A strip along +x from its clamp at x = 0, width along y, normal z, of equilateral triangles with one
/// family of edges across; the sides are straight. One more row behind a clamp is held together with the
/// clamp's. Membrane with Poisson's ratio 1/3, linear hinges B l^2/(A1 + A2).
struct StripOptions {
  double length = 0.1;      ///< L [m]
  int rows = 16;            ///< cells along
  int columns = 4;          ///< edges across
  double rigidity = 1e-5;   ///< B [N m]
  double young = 2000;      ///< times thickness [N/m]
  double density = 0.1;     ///< [kg/m^2]
  double jitter = 0;        ///< free particles move by up to so many edges in x and y; sides and ends stay
  std::uint64_t seed = 1;   ///< of the jitter
  double clamp_factor = 2;  ///< of the hinges on a clamp: they stand for half a cell
  bool far_clamp = false;   ///< clamp x = L, too
};
struct Strip {
  physics::Cloth cloth;
  std::vector<std::vector<int>> rows;  ///< particles of each row, the one behind the clamp first
  std::vector<int> clamped;            ///< those at x = 0 and, with far_clamp, at x = L
  double length, width, rigidity;      ///< [m], [m], [N m]

  physics::Vec3 middle(std::size_t row) const;  ///< mean position of a row
  physics::Vec3 tip() const { return middle(rows.size() - 1); }
};
Strip equilateral_strip(const StripOptions& options);

/// The hinges become springs of the same stiffness k [N/m] across the edges; those over a clamp count
/// eightfold (half a cell turns by half the angle, and the moment goes with its third power).
void replace_hinges_by_springs(Strip& strip, double stiffness);

/// A strip that bends in one way only: rigid cells between rungs, each a tetrahedron of six stiff springs
/// pressed flat, and over each rung two hinges that mirror each other, together B b/h; rungs halve their
/// cells' mass. `stiffness` of the springs in N/m.
struct LadderOptions {
  double length = 0.1, width = 0.01;  ///< [m]
  int links = 40;                     ///< as many hinges
  double rigidity = 1e-5;             ///< [N m]
  double density = 0.1;               ///< [kg/m^2]
  double stiffness = 1e4;             ///< [N/m]
  double clamp_factor = 2;
  double bending = 0;  ///< k [N/m]; > 0: no hinges, but springs along both sides over each rung, 8 k at the
                       ///< clamp: moment B_3 curvature^3 a width, B_3 = k h^5 / (4 b), h = length / links
};
Strip ladder(const LadderOptions& options);

/// Gamma = density g L^3 / B as a size of gravity [m/s^2].
double gravity_for(double gamma, double density, double length, double rigidity);

/// The heavy elastica, clamped horizontally, moment B_n curvature^n a width, Gamma_n = density g L^(n+2) /
/// B_n; L = 1. Shooting from the tip, Runge and Kutta's method of order four in `steps` steps.
struct Elastica {
  double width, height;  ///< W/L, H/L (drop)
  double tip_angle;      ///< below the horizontal [rad]
};
Elastica heavy_elastica(double gamma, int n = 1, int steps = 4000);

/// Gamma at which the strip under gravity along `direction` loses its stability, between two bounds, bisected
/// to 1e-4 relative; gravity is what grows.
double critical_gamma(const Strip& strip, const physics::Vec3& direction, double below, double above);

}  // namespace furrow::tests
