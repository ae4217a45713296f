// SPDX-License-Identifier: MIT
#pragma once
#include <span>
#include <vector>

#include "physics/body/collider.h"
#include "physics/cloth/cloth.h"

namespace furrow::physics {

struct StiffnessWork;

struct PrestressOptions {
  Vec3 gravity{0, -9.81, 0};  ///< [m/s^2]; finite
  double friction = 0.3;      ///< Coulomb coefficient with the body [-]; >= 0; 0: without friction
  double gap = 0.003;         ///< a body at most this far (and 1e-5 m) carries [m]; > 0
  double max_strain = 0.1;    ///< bound of |l - L| / L, see ClampedElements for triangles [-]; in (0, 0.15]
  /// Bound of (L - l) / L of springs and tension, where less than max_strain, for cloth that buckles [-]; in
  /// [0, 0.15]
  double max_compression = 0.15;
  double max_angle = 1.5707963267948966;  ///< bound of |theta - theta0| of hinges [rad]; in (0, 3]
  double tolerance = 1e-9;                ///< net force relative to weight at which it is done [-]; > 0
  int max_iterations = 200;               ///< Newton steps; >= 1
  StiffnessWork* work = nullptr;          ///< shared with solves before and after; null: none
};

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

struct PrestressReport {
  double residual = 0;                   ///< residual_force() of the result [-]
  double max_strain = 0;                 ///< |l - L| / L of springs, tension, triangles' edges [-]
  double max_angle = 0;                  ///< |theta - theta0| of hinges [rad]
  std::vector<int> structural, bending;  ///< springs on a bound
  std::vector<int> tension;              ///< tension on a bound
  std::vector<int> membrane, hinges;     ///< triangles, hinges on a bound
  std::vector<int> coupled;         ///< hinges of plates that would have turned beyond it, plate by plate
  std::vector<int> touching;        ///< particles that the body may carry
  std::vector<Vec3> contact_force;  ///< on each of these [N]; in the friction cone
  std::vector<RigidImbalance> imbalance;  ///< what no bound and no stiffness can help: see below
  int iterations = 0, factorisations = 0;

  std::size_t active_bounds() const {
    return structural.size() + bending.size() + tension.size() + membrane.size() + hinges.size() +
           coupled.size();
  }
};

/// Sets the rest state (rest lengths of springs, tension and triangles, rest angles of hinges) with which the
/// cloth is in equilibrium as it lies: forces of elements, weight, `loads` and a contact force in the
/// friction cone balance on each free particle. Stiffnesses and positions stay. Of all such states it takes
/// the one whose elements store least energy. loads: further forces that act whatever moves [N], one a
/// particle; may be empty. Cost: a symbolic and, without bounds and body, one numeric factorisation, O(n^1.5)
/// for n particles of a sheet. Same input, same bits. Throws std::invalid_argument, nothing changed, if an
/// option is out of its range, arrays differ in length, a position or load is not finite, a free particle has
/// no mass, or elements are broken or have no area.
///
/// \details With each element's own stiffness,
///   min 1/2 z^T C z  subject to  A z + f = 0  and the bounds,  z = -C^-1 A^T u,  (A C^-1 A^T) u = f,
/// where A C^-1 A^T is the stiffness matrix of a cloth at rest as it lies; then each element's law is
/// inverted (invert_elements.h); a plate's bends at z are what its rest angles change by. As a plate is made
/// of rest lengths, it is made anew (plate/recouple.h) and balanced again until it fits them. Threads stay
/// where they lie in the cloth. Bounds and the cone make it a convex problem without equations
/// (balance_forces()): where they leave no equilibrium it comes as near as they allow, and `residual` and the
/// lists tell. The rest state that the cloth had does not count; one that is relaxed and bears no load is at
/// rest as it lies. Whether the equilibrium is stable is not asked here: certificate.h.
///
/// `imbalance`: pieces that pins leave free to move as rigid bodies while the load moves them by more than
/// 1e-9 g (balance_rigidly() helps if they hang), and pieces for which also the body's contact cannot prevent
/// it. Where the body is nearer than the gap, a simulation will push the cloth out; that motion is not
/// foreseen. A triangle with Poisson's ratio near 1 may bear less than its bound; it then gets the largest
/// share of the stress that it can.
/// Source: Hsu, Truong, Yuksel, Wu 2022, A general two-stage initialization for sag-free deformable
/// simulations, ACM TOG 41(4); bounds as Takahashi and Batty do for rods.
PrestressReport prestress(Cloth& cloth, const PrestressOptions& options = {},
                          const Collider* collider = nullptr, std::span<const Vec3> loads = {});

}  // namespace furrow::physics
