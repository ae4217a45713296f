// SPDX-License-Identifier: MIT
#pragma once
#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <vector>

#include "physics/base/thread_pool.h"
#include "physics/linear/dense_front.h"
#include "physics/linear/divide_fronts.h"
#include "physics/linear/front_tree.h"

namespace furrow::physics {

/// Cholesky factors L L^T of a sparse symmetric matrix of 3 x 3 blocks, by dense fronts (multifrontal
/// method): particles whose columns of L look alike are eliminated together, so that nearly all work is
/// products of dense matrices. Against Eigen's SimplicialLDLT it is several times faster from 1,000 particles
/// of a sheet on. It tells only whether the matrix is positive definite, not how many negative eigenvalues it
/// has.
///
/// The matrix is its lower triangle, column by column; columns 3 c, 3 c + 1, 3 c + 2 hold from the diagonal
/// down the block (c, c) and whole blocks below it, the same ones, ascending (FreeStiffness).
/// Same input, same bits, for any number of threads; on processors without fused multiply-add other ones than
/// on those with it. Source: see FrontTree.
class BlockCholesky {
 public:
  using Sparse = FrontTree::Sparse;
  /// Finds order and fronts. Cost: two to four factorisations; the order takes most of it.
  void analyse(const Sparse& lower);
  /// Factorises matrix + shift I; false if it is not positive definite or not finite. Needs the pattern of
  /// analyse(). pool: threads that share the work (null: the caller alone).
  bool factorise(const Sparse& lower, double shift, ThreadPool* pool = nullptr);
  /// b becomes the solution. Needs factorise() true. Cost: reads the factor twice.
  void solve(Eigen::VectorXd& b, ThreadPool* pool = nullptr) const;

 private:
  /// Numbers in whole lines of the cache.
  struct alignas(64) Line {
    double number[8];
  };
  using Store = std::vector<Line>;
  /// Where a front's numbers begin [lines]: its columns of L; what it leaves to its parent, lower triangle,
  /// in held_ or in the stack of the thread that does its branch.
  struct Place {
    std::size_t panel = 0, update = 0;
    bool held = false;
  };
  struct Values {  // of the matrix
    const double* value;
    double shift;
  };
  DenseFront dense(int front) const;
  void place_updates();
  double* update(int front, Store& stack);
  void assemble(int front, const Values& values, Store& stack, int begin, int end);
  void add_children(int front, Store& stack, double* target, int stride, int begin, int end);
  bool eliminate(int front, const Values& values, Store& stack, ThreadPool* pool);
  void forward(int front, Eigen::VectorXd& x, std::vector<double>& left) const;
  void backward(int front, Eigen::VectorXd& x) const;

  FrontTree tree_;
  FrontDivision division_;
  int threads_ = 0;  // of division_
  std::vector<Place> places_;
  std::vector<std::size_t> left_;  // of each front what its rows keep during a solution: where it begins
  Store factor_, held_;
  std::vector<Store> stacks_;  // one a thread
};

}  // namespace furrow::physics
