// SPDX-License-Identifier: MIT
#pragma once
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "physics/base/arrays.h"

namespace furrow::physics {

class FreeStiffness;
class ThreadPool;

/// How stiff friction is along the way of what slides: not at all, as its force is the limit whatever the
/// way; or by limit over way. Moves are shorter then, and where much slides they lower the energy.
enum class SlipStiffness { none, secant };

/// Where a stage of a step begins, for friction of what comes to touch in it.
struct StageStart {
  std::span<const Vec3> x;        ///< [m]
  std::span<const Vec3> on_body;  ///< StepContact::move_body() of x; empty without a body
};

/// One contact of a search for rest or of an implicit step: an energy of the particles' positions that is
/// added to the elements'. Answers are for the positions of the last look(). Nothing changes where nothing is
/// near, bit by bit.
///
/// \details A search calls look() at its start. It then repeats: add_stiffness() where it factorises,
/// expect() with the next move, safe_share() of that move, and look() wherever a share of the move leads.
/// Each look() is followed by energy() and add_forces(). `settle` calls move_anchors() where it begins and
/// after every step that it takes. An implicit step calls hold_new() after its first move and while friction
/// follows the push, and move_anchors() where its search ends.
class ContactTerm {
 public:
  virtual ~ContactTerm() = default;
  /// Particles move where inv_mass > 0. The results do not depend on the pool's threads; null: one.
  virtual void look(std::span<const Vec3> x, std::span<const double> inv_mass, ThreadPool* pool) = 0;
  virtual double energy() const = 0;                         ///< [J]
  virtual void add_forces(std::span<Vec3> force) const = 0;  ///< [N]
  /// Positive semidefinite. A block of two particles has a place only where elements couple them
  /// (FreeStiffness::couples()), or where the search called FreeStiffness::couple() before it assembled.
  virtual void add_stiffness(FreeStiffness& stiffness, SlipStiffness of_slip) const = 0;

  virtual bool rubs() const { return false; }  ///< it has friction
  /// Limits of friction become those of the push after a move [m]; `again`: of a second move in one search.
  virtual void expect(std::span<const Vec3>, bool /*again*/ = false) {}
  /// Friction takes hold at x, which was looked at last.
  virtual void move_anchors(std::span<const Vec3>) {}
  /// What has come to touch on the way to x has friction, too. Whether its limits are worth an expect().
  virtual bool hold_new(const StageStart&, std::span<const Vec3>) { return false; }

  /// The largest share, at most `most`, that may be made of the move `way` [m] that begins at `from` [m].
  virtual double safe_share(std::span<const Vec3> /*from*/, std::span<const Vec3> /*way*/, double most,
                            ThreadPool*) {
    return most;
  }
  virtual double longest_move() const { return std::numeric_limits<double>::infinity(); }  ///< of a step [m]
  /// The particles that it pushes. The factors of one search serve the next only while this list stays the
  /// same. None: they serve one search alone.
  virtual std::optional<std::vector<int>> pushed() const { return std::nullopt; }
};

}  // namespace furrow::physics
