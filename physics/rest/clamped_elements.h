// SPDX-License-Identifier: MIT
#pragma once
#include <array>
#include <memory>
#include <span>
#include <vector>

#include "physics/linear/free_stiffness.h"
#include "physics/plate/plate_bending.h"
#include "physics/rest/stiffness_work.h"

namespace furrow::physics {

/// Where a cloth lies on a body, which may push along the normal and hold sideways.
struct ContactPoint {
  int particle;
  Vec3 normal;  ///< unit, away from the body
};
struct ElementLimits {
  double strain;       ///< largest (l - L) / L of springs and tension, of triangles see ClampedElements [-]
  double compression;  ///< largest (L - l) / L of springs and tension [-]
  double angle;        ///< largest |theta - theta0| of hinges [rad]
  double friction;     ///< Coulomb coefficient [-]
};

/// What elements and contacts answer to a displacement w, as prestress() wants it.
struct ClampedForces {
  std::vector<double> structural, bending, tension;  ///< pull [N]
  std::vector<Eigen::Vector3d> membrane;             ///< dW/d(l^2) of the edges [N/m]
  std::vector<double> hinges;                        ///< moment dE/dtheta [N m]
  std::vector<std::vector<double>> coupled;          ///< of each plate's hinges, how far they bend [rad]
  std::vector<Vec3> contact;                         ///< the body's on the cloth [N]
  std::vector<double> scale;  ///< of each spring, bending spring, tension, triangle, hinge, then contact: 1
                              ///< free, less on its limit
  double potential = 0;       ///< [J]; its derivative by w is what elements and contacts answer
};

/// A cloth that is at rest as it lies, and the forces of its elements to first order in a displacement w,
/// each clamped to what its limits allow: the projection z = P(C^-1 A^T w) of keep-as-drawn's linear problem,
/// in the norm of the element's own stiffness. So the potential is convex with a continuous derivative, and
/// Newton's method with a line search finds its minimum: there the load is met as well as the limits allow.
///
/// \details Hinges count by their stiffness k, whatever their law; a cosine hinge's moment is at most
/// k (1 - cos angle). Tension, without stiffness at rest, counts with that at the working strain
/// (tension_forces.h), within what its own law bears. A triangle's stress is at most that of the energy of
/// the strain limit along one axis, 1/2 A Y strain^2 (with threads, Y of the softest direction): then no
/// principal strain is beyond the limit, to first order. A contact's force lies in Coulomb's cone; its
/// stiffness is high (10 times K's mean diagonal), so that the body carries what it can and the cloth the
/// rest. Plates have no limit: a plate that answers with other moments than its own bends call forth has no
/// rest angles.
class ClampedElements {
 public:
  /// Cost: one pass, and the symbolic factorisation. Throws std::invalid_argument as elements do, and if a
  /// triangle has lambda but no mu, or an energy is no PlateBending.
  /// work: left by the solve before and to the next (null: none).
  ClampedElements(const Cloth& cloth, const ElementLimits& limits, std::span<const ContactPoint> contacts,
                  StiffnessWork* work = nullptr);

  /// Answers to w [m], one a particle; 0 on pins. Adds what elements and contacts exert at first order, to
  /// force [N]. Cost: one pass.
  ClampedForces respond(std::span<const Vec3> w, std::span<Vec3> force) const;
  /// Factorises the derivative of that answer with mass times shift [1/s^2] added, more if round-off asks for
  /// it; a triangle on its limit counts with the secant, which is stiffer. Throws std::invalid_argument if a
  /// stiffness is not finite.
  void factorise(const ClampedForces& at, std::span<const Vec3> w, double shift);
  void solve(std::span<Vec3> b) const { stiffness_->solve(b); }

 private:
  struct Bar {
    int a, b;
    Vec3 direction;
    double stiffness, low, high;  // tensions
  };
  struct Bend {
    std::array<int, 4> vertices;
    std::array<Vec3, 4> gradient;
    double stiffness, high;
  };
  struct Plate {
    std::array<int, 3> vertices;
    std::array<Vec3, 3> edge;
    Eigen::Matrix3d quadratic;
    double reach;  // sqrt of twice the largest energy
  };
  void add_bars(std::span<const Spring> springs, const ElementLimits& limits);
  struct Coupled {
    const PlateBending* plate;  // one of the energies of rest_
    std::vector<std::array<Vec3, 4>> gradient;
  };
  void add_tension(const Cloth& cloth, const ElementLimits& limits);
  void add_coupled();
  void add_bends(const Cloth& cloth, double angle);
  void add_plates(const Cloth& cloth, double strain);
  void respond_bars(std::span<const Vec3> w, std::span<Vec3> force, ClampedForces& f) const;
  void respond_plates(std::span<const Vec3> w, std::span<Vec3> force, ClampedForces& f) const;
  void respond_bends(std::span<const Vec3> w, std::span<Vec3> force, ClampedForces& f) const;
  void respond_coupled(std::span<const Vec3> w, std::span<Vec3> force, ClampedForces& f) const;
  void respond_contacts(std::span<const Vec3> w, std::span<Vec3> force, ClampedForces& f) const;
  Mat3 contact_stiffness(const ContactPoint& contact, const Vec3& w) const;

  Cloth rest_;  // at rest as it lies; linear hinges; tension as springs behind those of bending
  Cloth now_;   // the same with the stiffness that elements have at their limits
  std::vector<Bar> bars_;
  std::size_t tension_begin_;  // first of the bars that are tension
  std::vector<Plate> plates_;
  std::vector<Bend> bends_;
  std::vector<Coupled> coupled_;
  std::vector<ContactPoint> contacts_;
  double friction_, contact_stiffness_ = 0;
  std::shared_ptr<FreeStiffness> stiffness_;
};

}  // namespace furrow::physics
