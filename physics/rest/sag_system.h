// SPDX-License-Identifier: MIT
#pragma once
#include <array>
#include <span>
#include <vector>

#include "physics/linear/free_stiffness.h"
#include "physics/rest/sag_forces.h"

namespace furrow::physics {

/// A cloth that is at rest as it lies, and the forces of its elements to first order in a displacement w (the
/// sag), each clamped to what its limits allow: the projection z = P(C^-1 A^T w) of keep-as-drawn's linear
/// problem, in the norm of the element's own stiffness. So the potential is convex with a continuous
/// derivative, and Newton's method with a line search finds its minimum, from where the load is met as well
/// as the limits allow. Hinges count by their stiffness k, whatever their law; a cosine hinge's moment is at
/// most k (1 - cos angle). Tension, without stiffness at rest, counts with that at the working strain
/// (tension_forces.h), within what its own law bears. A triangle's stress is at most that of the energy of
/// the strain limit along one axis, 1/2 A Y strain^2: then no principal strain is beyond the limit, to first
/// order. A contact's force lies in Coulomb's cone; its stiffness is high (10 times K's mean diagonal), so
/// that the body carries what it can and the cloth the rest.
class SagSystem {
 public:
  /// Cost: one pass, and the symbolic factorisation. Throws std::invalid_argument as elements do, and if a
  /// triangle has lambda but no mu.
  SagSystem(const Cloth& cloth, const SagLimits& limits, std::span<const SagContact> contacts);

  /// Answers to w [m], one a particle; 0 on pins. Adds what elements and contacts exert at first order, to
  /// force [N]. Cost: one pass.
  SagForces respond(std::span<const Vec3> w, std::span<Vec3> force) const;
  /// Factorises the derivative of that answer with mass times shift [1/s^2] added, more if round-off asks for
  /// it; a triangle on its limit counts with the secant, which is stiffer. Throws std::invalid_argument if a
  /// stiffness is not finite.
  void factorise(const SagForces& at, std::span<const Vec3> w, double shift);
  void solve(std::span<Vec3> b) const { stiffness_.solve(b); }

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
  void add_bars(std::span<const Spring> springs, const SagLimits& limits);
  void add_tension(const Cloth& cloth, const SagLimits& limits);
  void add_bends(const Cloth& cloth, double angle);
  void add_plates(const Cloth& cloth, double strain);
  void respond_bars(std::span<const Vec3> w, std::span<Vec3> force, SagForces& f) const;
  void respond_plates(std::span<const Vec3> w, std::span<Vec3> force, SagForces& f) const;
  void respond_bends(std::span<const Vec3> w, std::span<Vec3> force, SagForces& f) const;
  void respond_contacts(std::span<const Vec3> w, std::span<Vec3> force, SagForces& f) const;
  Mat3 contact_stiffness(const SagContact& contact, const Vec3& w) const;

  Cloth rest_;  // at rest as it lies; linear hinges; tension as springs behind those of bending
  Cloth now_;   // the same with the stiffness that elements have at their limits
  std::vector<Bar> bars_;
  std::size_t tension_begin_;  // first of the bars that are tension
  std::vector<Plate> plates_;
  std::vector<Bend> bends_;
  std::vector<SagContact> contacts_;
  double friction_, contact_stiffness_ = 0;
  FreeStiffness stiffness_;
};

}  // namespace furrow::physics
