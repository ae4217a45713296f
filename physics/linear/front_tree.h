// SPDX-License-Identifier: MIT
#pragma once
#include <Eigen/SparseCore>
#include <array>
#include <span>
#include <vector>

#include "physics/linear/column_rows.h"

namespace furrow::physics {

/// The fronts of a multifrontal Cholesky factorisation of a BlockMatrix: particles whose columns of the
/// factor look alike are eliminated together. A front's parent is that of its first row below its columns.
/// Sources: Liu, The multifrontal method for sparse matrix solution, SIAM Review 34(1), 1992; order of
/// elimination: nested_dissection(); small fronts join their parents: relaxed supernodes, Ashcraft and Grimes
/// 1989.
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
  double work = 0;            // of a factorisation: products, and numbers that are moved ten times [-]
};

/// order: the place of each row of blocks, as `position` of a tree for a like pattern; empty:
/// nested_dissection(). Cost: that order, 0.1 s for 12,000 vertices, and less for the fronts. Asks in between
/// whether it is cancelled; throws as nested_dissection().
FrontTree front_tree(const FrontTree::Sparse& lower, std::vector<int> order = {});

/// How threads share a tree of fronts: branches, each done by one thread, and the trunk that they grow from,
/// done by all together.
struct FrontDivision {
  std::vector<std::array<int, 2>> branches;  ///< ranges of fronts, the most work first
  std::vector<int> trunk;                    ///< children before parents
};

/// The division with the least expected time. One thread: no trunk. Cost: of the order of the fronts.
FrontDivision divide_fronts(const std::vector<FrontTree::Front>& fronts, int threads);

/// The elimination tree of a sparse symmetric matrix: the parent of a column is the first row below the
/// diagonal in its column of the Cholesky factor, -1 if there is none (a root). Cost: nearly linear in the
/// rows. Source: Liu, The role of elimination trees in sparse factorization, SIAM J. Matrix Anal. Appl.
/// 11(1), 1990.
std::vector<int> elimination_tree(const ColumnRows& below);

/// The place of each node in an order where each node comes right behind its descendants; children keep their
/// order. Every parent has a higher index than its children, or is -1.
std::vector<int> postorder(std::span<const int> parent);

}  // namespace furrow::physics
