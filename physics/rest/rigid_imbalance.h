// SPDX-License-Identifier: MIT
#pragma once
#include <span>
#include <vector>

#include "physics/cloth/cloth.h"

namespace furrow::physics {

/// A piece of cloth (particles that elements join) whose pins leave rigid motions free, and what of a load no
/// force inside the piece can balance: with nothing else to hold it, the piece would start to move with these
/// accelerations as a rigid body.
struct RigidImbalance {
  std::vector<int> piece;  ///< its free particles, ascending
  int freedoms = 0;        ///< 1: about an axis through its pins; 3: about its only pin; 6: no pins
  Vec3 point{0, 0, 0};     ///< on the axis; the pin; the centre of mass [m]
  Vec3 axis{0, 0, 0};      ///< unit; of that freedom, else of the moment; 0 if there is none
  Vec3 force{0, 0, 0};     ///< unbalanced [N]; 0 with pins
  Vec3 moment{0, 0, 0};    ///< unbalanced, about the point [N m]
  Vec3 acceleration{0, 0, 0}, angular_acceleration{0, 0, 0};  ///< of the point [m/s^2]; [1/s^2]
  double largest = 0;                                         ///< acceleration of a particle by them [m/s^2]
};

/// One for each piece with free particles whose pins leave a freedom, in the order of their first particles.
/// load: force on each particle [N]; that on pins does not count. Pins are on one line if none is farther
/// from it than 1e-6 of the piece's size. Cost: one pass over the elements. Throws std::invalid_argument if
/// lengths differ or an element names a particle out of range.
std::vector<RigidImbalance> rigid_imbalances(const Cloth& cloth, std::span<const Vec3> load);

/// Takes the load off that would move the piece: mass times the acceleration at each of its particles.
void remove_rigid_load(const Cloth& cloth, const RigidImbalance& imbalance, std::span<Vec3> load);

/// Turns each piece that hangs on a line of pins or on one pin, rigidly about it, until the centre of its
/// free mass hangs lowest; particles at rest keep their pins, elements their state. Pieces without a pin,
/// pieces whose pins hold them, and axes along gravity stay. Returns the largest turn [rad]. gravity [m/s^2].
/// Errors as rigid_imbalances().
double balance_rigidly(Cloth& cloth, const Vec3& gravity);

}  // namespace furrow::physics
