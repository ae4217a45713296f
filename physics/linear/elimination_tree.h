// SPDX-License-Identifier: MIT
#pragma once
#include <span>
#include <vector>

namespace furrow::physics {

/// The elimination tree of a sparse symmetric matrix: the parent of a column is the first row below the
/// diagonal in its column of the Cholesky factor, -1 if there is none (a root). below: of each column the
/// rows below the diagonal, in range. Cost: nearly linear in them. Source: Liu, The role of elimination trees
/// in sparse factorization, SIAM J. Matrix Anal. Appl. 11(1), 1990.
std::vector<int> elimination_tree(std::span<const std::vector<int>> below);

/// The place of each node in an order where each node comes right behind its descendants; children keep their
/// order. Every parent has a higher index than its children, or is -1.
std::vector<int> postorder(std::span<const int> parent);

}  // namespace furrow::physics
