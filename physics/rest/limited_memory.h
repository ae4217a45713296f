// SPDX-License-Identifier: MIT
#pragma once
#include <deque>
#include <functional>
#include <span>
#include <vector>

#include "physics/base/arrays.h"

namespace furrow::physics {

/// The inverse of a Hessian H as the last steps showed it, on top of a factorisation of an older or simpler
/// one (L-BFGS): with it a factorisation serves for many steps. Positive definite if the base is.
/// Source: Nocedal and Wright, Numerical Optimization, 2nd ed., algorithm 7.4; with an elastic base Liu,
/// Bouaziz and Kavan 2017, Quasi-Newton methods for real-time simulation of hyperelastic materials.
class LimitedMemory {
 public:
  /// Applies the base's inverse in place.
  using Base = std::function<void(std::span<Vec3>)>;

  /// pairs: how many steps it remembers; >= 0, throws std::invalid_argument otherwise.
  LimitedMemory(Base base, int pairs);

  /// A step s [m] along which the force fell by y = f(x) - f(x + s) [N]. false: left out, as H is not
  /// positive along it (s . y <= 0) and would not be afterwards. Throws std::invalid_argument if the lengths
  /// of s and y differ from each other's or from those of the steps before.
  bool add(std::vector<Vec3> s, std::vector<Vec3> y);
  /// f [N] becomes H^-1 f [m]. Cost: the base's, and 4 products of vectors a pair.
  void apply(std::span<Vec3> f) const;
  /// Forgets all pairs: for another base.
  void clear() { pairs_.clear(); }

 private:
  struct Pair {
    std::vector<Vec3> s, y;
    double inverse;  // 1 / (s . y)
  };
  Base base_;
  std::size_t most_;
  std::deque<Pair> pairs_;  // the oldest first
};

}  // namespace furrow::physics
