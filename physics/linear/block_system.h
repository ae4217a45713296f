// SPDX-License-Identifier: MIT
#pragma once
#include <array>
#include <memory>
#include <span>
#include <vector>

#include "physics/base/particles.h"

namespace furrow::physics {

/// A symmetric positive definite matrix of 3 x 3 blocks and its sparse Cholesky factor. The order of
/// elimination (approximate minimum degree) and the factor's pattern are found once.
class BlockSystem {
 public:
  /// Rows that are not free are left out. pairs: the blocks besides the diagonal ones, in either order, with
  /// repeats. Throws std::invalid_argument if one is out of range. Cost: that of the symbolic factorisation.
  BlockSystem(std::span<const char> is_free, std::span<const std::array<int, 2>> pairs);
  ~BlockSystem();

  /// Where add() finds the block (i, j); -1 if it is not stored: out of a free row's or column's reach, or
  /// the mirror image of one that is. Of (i, j) and (j, i) exactly one is stored. Throws
  /// std::invalid_argument for a pair that was not announced.
  int place(int i, int j) const;
  void set_zero();
  /// Adds to the block at a place; -1 does nothing.
  void add(int place, const Mat3& block);
  /// Whether it was positive definite.
  bool factorise();
  /// b becomes the solution in free rows, 0 in the others. Needs factorise().
  void solve(std::vector<Vec3>& b) const;

 private:
  struct Matrix;
  std::unique_ptr<Matrix> matrix_;
};

}  // namespace furrow::physics
