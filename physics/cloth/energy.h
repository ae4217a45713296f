// SPDX-License-Identifier: MIT
#pragma once
#include <functional>
#include <span>

#include "physics/base/particles.h"

namespace furrow::physics {

/// Which part of the second derivative of an energy counts: the Hessian itself, which is indefinite where
/// springs are compressed or hinges bent; a semidefinite part of it (springs without the transverse part of
/// compressed ones; see each element); or what lies between.
struct Stiffness {
  double clamped;  ///< share of the way from the Hessian to the semidefinite part [-]; in [0, 1]
  static const Stiffness exact, positive_part;
  bool operator==(const Stiffness&) const = default;
};
inline constexpr Stiffness Stiffness::exact{0}, Stiffness::positive_part{1};

/// Takes what one element adds to the block of the stiffness matrix K [N/m] in the rows of particle i and the
/// columns of particle j. K is the second derivative of the energy, so forces change by -K u.
using BlockSink = std::function<void(int i, int j, const Mat3& block)>;

/// A caller's own energy or force on a cloth: put into Cloth::energies it counts wherever elements do. Each
/// function is called once a pass, with one position a particle [m] in the order of Cloth::particles; it must
/// not change the object, and may be called by one thread after another.
/// \details Equal arguments must give equal results, or runs do not repeat. What each part of the library
/// asks:
///  - simulate: forces. It gets no dashpots of its own. Backward Euler takes the force as that of the step's
///    beginning where there is no stiffness, and is stable only as far as it is soft then. XPBD refuses it:
///    it knows constraints alone.
///  - The limit of a step: the positive part of the stiffness, or, without, differences of forces.
///  - settle: energy and forces; without stiffness Newton's method does not see how the force changes: the
///    same rest, by more iterations.
///  - certify refuses an energy without stiffness; prestress refuses any (it has no rest state to change).
///  - A saved state's fingerprint counts how many energies there are, and cannot tell one from another.
class Energy {
 public:
  virtual ~Energy() = default;

  /// E at x [J].
  virtual double energy(std::span<const Vec3> x) const = 0;

  /// Adds the forces -dE/dx [N]. A force that has no energy may do so, too, in simulate(); settle() compares
  /// energies and stops where they do not fit.
  virtual void add_forces(std::span<const Vec3> x, std::span<Vec3> force) const = 0;

  /// Hands out the blocks of K = d2E/dx2 [N/m] as add_stiffness() of elements.h does: both (i, j) and (j, i),
  /// in a sequence of (i, j) that never changes; semidefinite with Stiffness::positive_part. Returns false,
  /// with nothing handed out, if there is none.
  virtual bool add_stiffness(std::span<const Vec3> /*x*/, Stiffness, const BlockSink&) const { return false; }
};

}  // namespace furrow::physics
