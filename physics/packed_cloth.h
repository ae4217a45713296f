// SPDX-License-Identifier: MIT
#pragma once
#include <vector>

#include "physics/springs.h"
#include "physics/sweep_order.h"

namespace furrow::physics {

/// Four doubles that fill a vector register; w is 0 in all arrays here.
struct alignas(32) Vec4 {
  double x = 0, y = 0, z = 0, w = 0;
};

/// A cloth's particles and springs laid out for speed: particles in breadth-first order, springs (structural
/// and bending alike) in the order of a sweep. Only this layout is its own: it holds no rule of motion.
struct PackedCloth {
  std::vector<int> particle;        ///< for each place the index in the cloth
  std::vector<Vec4> x, v, force;    ///< [m], [m/s], [N]; force: of the springs alone
  std::vector<double> inv_mass;     ///< [1/kg]; 0 does not move
  std::vector<int> a, b;            ///< ends of each spring (places), a < b
  std::vector<double> k, kL;        ///< stiffness [N/m], stiffness times rest length [N]
  std::vector<double> inv_length2;  ///< 1/l^2 [1/m^2] at x
  SweepOrder sweep;                 ///< groups and blocks of the springs; `pairs` is empty (already applied)

  int particles() const { return int(x.size()); }
  int springs() const { return int(a.size()); }
};

/// Throws std::invalid_argument if arrays differ in length, a spring names a particle out of range or joins
/// one to itself, or a mass, stiffness or rest length is not in its range.
PackedCloth pack(const Cloth& cloth);

/// Writes positions and velocities back; pinned particles keep theirs bit by bit.
void unpack(const PackedCloth& packed, Particles& particles);

}  // namespace furrow::physics
