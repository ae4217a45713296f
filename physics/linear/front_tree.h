// SPDX-License-Identifier: MIT
#pragma once
#include <Eigen/SparseCore>
#include <array>
#include <vector>

namespace furrow::physics {

/// The fronts of a multifrontal Cholesky factorisation of a sparse symmetric matrix of 3 x 3 blocks
/// (BlockCholesky says how it is stored): particles whose columns of the factor look alike are eliminated
/// together. A front has a parent: that of its first row below its columns.
/// Source: Liu, The multifrontal method for sparse matrix solution, SIAM Review 34(1), 1992; order of
/// elimination: nested_dissection(); small fronts join their parents (relaxed supernodes, Ashcraft and Grimes
/// 1989).
struct FrontTree {
  using Sparse = Eigen::SparseMatrix<double>;
  struct Block {               // of the matrix in a front
    int row, column;           // in the front
    bool transposed;           // it stands above the diagonal there
    std::array<int, 3> value;  // where its columns begin among the values
  };
  /// Rows from `from` of what a front leaves, and where they stand in the parent.
  struct Run {
    int from, to, length;  // of numbers, not blocks
  };
  struct Front {
    int first = 0, width = 0;  // its columns, in the order of elimination
    int parent = -1;
    std::vector<int> rows;  // below its columns, ascending
    std::vector<Run> runs;
    std::vector<int> children;
    std::vector<Block> blocks;
  };
  std::vector<int> position;  // of each row of blocks in the order of elimination
  std::vector<Front> fronts;  // children before parents, a branch in one piece
};

/// Cost: the order of elimination, 0.1 s for 12,000 vertices, and about half of that. Throws as
/// nested_dissection().
FrontTree front_tree(const FrontTree::Sparse& lower);

}  // namespace furrow::physics
