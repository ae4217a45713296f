// SPDX-License-Identifier: MIT
#pragma once
#include <Eigen/SparseCore>
#include <array>
#include <span>
#include <vector>

#include "physics/base/arrays.h"

namespace furrow::physics {

/// A sparse symmetric matrix of 3 x 3 blocks, a row of blocks for each particle that may move, of a pattern
/// that is found once. What is stored is its lower triangle, column by column: columns 3 c, 3 c + 1, 3 c + 2
/// hold from the diagonal down the block (c, c) and whole blocks below it, the same ones, ascending.
class BlockMatrix {
 public:
  using Sparse = Eigen::SparseMatrix<double>;
  /// Where a block goes.
  struct Place {
    int value = -1;         ///< first of its first column; -1: nowhere
    int column_length = 0;  ///< of that column
    int column = -1;        ///< of blocks
    enum { diagonal, below, above } part = diagonal;
  };

  /// No blocks.
  BlockMatrix() = default;
  /// Particles with inv_mass > 0 have rows, in their order. pairs: of particles that share a block, in either
  /// order, with repeats; diagonal blocks are there without. All is zero. Throws std::invalid_argument if one
  /// is out of range. Cost: O(pairs log pairs).
  BlockMatrix(std::span<const double> inv_mass, std::span<const std::array<int, 2>> pairs);

  /// The blocks of another matrix and those of more pairs. All is zero. Throws as above.
  /// Cost: O(blocks + pairs log pairs).
  BlockMatrix(const BlockMatrix& fewer, std::span<const std::array<int, 2>> more);

  int rows() const { return rows_; }  ///< of blocks
  /// Row of a particle; -1: it has none.
  int row(int particle) const { return row_[std::size_t(particle)]; }
  /// Of the block (i, j) of particles, nowhere if one has no row. Throws std::invalid_argument for a pair
  /// that was not announced.
  Place place(int i, int j) const;
  /// Where what has that place in a matrix that this one has all blocks of has its own. O(1) where the column
  /// has no more blocks than there.
  Place carried(const Place& place, const BlockMatrix& fewer) const;
  /// Whether place(i, j) is somewhere or nowhere, and does not throw.
  bool has(int i, int j) const;

  void set_zero() { std::fill_n(lower_.valuePtr(), lower_.nonZeros(), 0.0); }
  /// Adds the block (i, j) of that place(i, j) to the matrix, which is that and its mirror image at once. Of
  /// a diagonal block the lower triangle counts.
  void add(const Place& place, const Mat3& block);
  const Sparse& lower() const { return lower_; }

  /// The rows' part of a vector with one entry a particle.
  Eigen::VectorXd gather(std::span<const Vec3> v) const;
  /// Back; 0 for particles without a row.
  void scatter(const Eigen::VectorXd& rows, std::span<Vec3> v) const;

 private:
  using Lists = std::vector<std::vector<int>>;
  Lists below_by(std::span<const std::array<int, 2>> pairs) const;
  void lay_out(std::span<const int> outer, std::span<const int> inner);
  int begin_of(int column) const { return lower_.outerIndexPtr()[3 * column]; }
  int length_of(int column) const { return lower_.outerIndexPtr()[3 * column + 1] - begin_of(column); }
  /// Where the block (r, column) of rows begins, r > column; -1: there is none.
  int find_below(int column, int r) const;

  int rows_ = 0;
  std::vector<int> row_;  ///< of each particle
  Sparse lower_;
};

/// A column is one number shorter than that before it.
inline void BlockMatrix::add(const Place& place, const Mat3& block) {
  if (place.value < 0) return;
  const int n = place.column_length;
  double* v = lower_.valuePtr() + place.value;
  if (place.part == Place::diagonal) {
    v[0] += block(0, 0), v[1] += block(1, 0), v[2] += block(2, 0);
    v[n] += block(1, 1), v[n + 1] += block(2, 1);
    v[2 * n - 1] += block(2, 2);
    return;
  }
  for (int e = 0; e < 3; v += n - ++e) {
    for (int f = 0; f < 3; ++f) v[f] += place.part == Place::below ? block(f, e) : block(e, f);
  }
}

}  // namespace furrow::physics
