// SPDX-License-Identifier: MIT
#pragma once
#include <memory>

#include "physics/base/thread_pool.h"
#include "physics/linear/block_matrix.h"

namespace furrow::physics {

/// Cholesky factors L L^T of a BlockMatrix, by dense fronts (multifrontal method): particles whose columns of
/// L look alike are eliminated together, so that nearly all work is products of dense matrices. Against
/// Eigen's SimplicialLDLT it is several times faster from 1,000 particles of a sheet on. It tells only
/// whether the matrix is positive definite; negative_pivots() counts its negative eigenvalues.
/// Same input, same bits, for any number of threads; on processors without fused multiply-add other ones than
/// on those with it. Source: see FrontTree.
class BlockCholesky {
 public:
  using Sparse = BlockMatrix::Sparse;  ///< BlockMatrix::lower()
  BlockCholesky();
  ~BlockCholesky();
  BlockCholesky(BlockCholesky&&) noexcept;
  BlockCholesky& operator=(BlockCholesky&&) noexcept;

  /// Finds order and fronts. Cost: two to four factorisations; the order takes most of it.
  /// Throws Cancelled as nested_dissection().
  void analyse(const Sparse& lower);
  /// The same for another matrix with as many rows, with the order that is there. false, and nothing is
  /// changed: a factorisation would take more than half as much again as of the matrix that it was found for.
  /// Needs analyse(). Cost: that of analyse() without its order.
  bool analyse_like(const Sparse& lower);
  /// Factorises matrix + shift I; false if it is not positive definite or not finite. Needs the pattern of
  /// analyse(). pool: threads that share the work (null: the caller alone). Asks between fronts whether it is
  /// cancelled (cancel_scope.h): then it throws Cancelled, and there are no factors until the next call.
  bool factorise(const Sparse& lower, double shift, ThreadPool* pool = nullptr);
  /// The same of the matrix in single precision, in half the room and up to half the time: where it is
  /// positive definite it solves to about its condition times 1e-7, and what is nearly singular may fail.
  bool factorise_single(const Sparse& lower, ThreadPool* pool = nullptr);
  /// b becomes the solution, with the factors made last. Needs factorise() true. Cost: reads the factor
  /// twice.
  void solve(Eigen::VectorXd& b, ThreadPool* pool = nullptr) const;

 private:
  struct Factors;
  std::unique_ptr<Factors> factors_;
};

}  // namespace furrow::physics
