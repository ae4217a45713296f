// SPDX-License-Identifier: MIT
#pragma once
#include <memory>
#include <vector>

#include "physics/base/vec4.h"
#include "physics/cloth/cloth.h"
#include "physics/cloth/packed_energy.h"
#include "physics/packed/packed_elements.h"
#include "physics/packed/sweep_order.h"

namespace furrow::physics {

/// A cloth laid out for speed: particles in breadth-first order; springs (structural and bending alike) in
/// the order of a sweep, with them the dashpots of the membrane's edges and of tension (springs with k = 0
/// that only damp); membrane, tension and hinges after PackedElements. Only this layout is its own: it holds
/// no rule of motion.
struct PackedCloth {
  std::vector<int> particle;      ///< for each place the index in the cloth
  std::vector<Vec4> x, v, force;  ///< [m], [m/s], [N]; force: of elements alone
  std::vector<double> inv_mass;   ///< [1/kg]; 0 does not move
  std::vector<int> a, b;          ///< ends of each spring (places), a < b
  std::vector<double> k, kL;      ///< stiffness [N/m], stiffness times rest length [N]
  std::vector<double>
      damping_k;  ///< stiffness that damping goes by [N/m]: k, edge_stiffness(), tension_slope()
  std::vector<double> inv_length2;  ///< 1/l^2 [1/m^2] at x
  SweepOrder sweep;                 ///< groups and blocks of the springs; `pairs` is empty (already applied)
  int dashpots = 0;                 ///< how many of the springs
  PackedElements elements;
  /// All but springs and particles, with places for vertices, for the functions of elements.h; its energies
  /// take positions by place, too.
  Cloth shell;
  std::vector<std::shared_ptr<const PackedEnergy>> energies;  ///< of shell.energies; null: has no such form

  int particles() const { return int(x.size()); }
  int springs() const { return int(a.size()); }  ///< with dashpots
};

/// Throws std::invalid_argument if arrays differ in length, an element names a
/// particle out of range or one twice, or a mass, stiffness, rest length or rest angle is not in its range.
/// dashpots: whether the membrane's edges and tension get one each.
PackedCloth pack(const Cloth& cloth, bool dashpots = true);

/// Adds the forces at x of what PackedElements does not hold: kinds without a layout, and Cloth::energies, by
/// one thread. Cost: nothing where there are none; else their own, and a copy of positions and forces if one
/// of them takes no vectors of four.
void add_other_forces(PackedCloth& packed);

/// Writes positions and velocities back; pinned particles keep theirs bit by bit.
void unpack(const PackedCloth& packed, Particles& particles);

}  // namespace furrow::physics
