// SPDX-License-Identifier: MIT
#pragma once
#include "physics/linear/block_cholesky.h"
#include "physics/motion/stepper.h"

namespace furrow::physics {

/// Backward (implicit) Euler:  x1 = x + dt v1,  M (v1 - v) = dt (f(x1) - D v1 + loads). Order one; stable for
/// any dt: an oscillator's amplitude shrinks by 1/sqrt(1 + z^2) a step, z = omega dt, whatever the damping.
///  - Linearised once about x (Baraff & Witkin 1998), with the positive part of the stiffness, or by Newton's
///    method to a tolerance, with halved steps where the incremental energy would rise.
///  - D: the dashpots of dashpots.h along the directions at x; drag is implicit, too, with the air at x and
///    the step's end; what compensates is that of its beginning.
///  - Contact acts after the solve, as a correction of the move: the solve does not know it, so that vertices
///    that a body holds pull at their neighbours from up to (load / stiffness) too deep.
/// Keeps momentum to rounding if nothing is pinned, touched or dragged; not angular momentum.
/// Cost of an iteration: assembly in one thread, and a sparse Cholesky factorisation (BlockCholesky, about
/// n^1.5 of n vertices) whose pattern is found once, by all threads of the motion; the same bits for any
/// number of them, and on every processor that has fused multiply-add. Sources: Baraff, Witkin, SIGGRAPH
/// 1998; Gast et al., TVCG 21 (2015) 1103-1115.
class BackwardEuler : public Stepper {
 public:
  /// Throws std::invalid_argument if an option is out of its range.
  explicit BackwardEuler(Motion& motion, const BackwardEulerOptions& options = {});
  void step(double dt) override;

 private:
  using Place = BlockMatrix::Place;
  void find_places();
  void take_step(double dt);
  void find_directions();
  void assemble(double dt, bool first);
  void add_springs(double dt, bool first);
  void add_shell(double dt, bool first);
  bool solve();
  void improve(double dt);
  double advance(double share, double dt);
  double energy(double dt) const;

  Motion& motion_;
  BackwardEulerOptions options_;
  std::vector<double> dashpots_;
  BlockMatrix system_;
  BlockCholesky factors_;
  bool analysed_ = false;
  std::vector<Place> diagonal_, off_diagonal_;  // of particles' and springs' blocks
  std::vector<Place> shell_;              // of the blocks of membrane, tension and hinges, in their sequence
  std::vector<Vec3> direction_;           // of each spring at x [-]
  std::vector<Vec3> change_;              // right-hand side, then the change of v
  std::vector<Vec4> x_, v_, air_, load_;  // at the beginning of the step; load_: what compensates
};

}  // namespace furrow::physics
