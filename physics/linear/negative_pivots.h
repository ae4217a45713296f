// SPDX-License-Identifier: MIT
#pragma once
#include "physics/linear/block_matrix.h"

namespace furrow::physics {

/// The number of negative pivots of A = L D L^T, which is that of A's negative eigenvalues (Sylvester's law
/// of inertia); -1 if a pivot is 0 or not finite. lower: BlockMatrix::lower(). Pivots are not permuted: next
/// to a pivot near 0 the number may be off. Asks within each front whether it is cancelled (cancel_scope.h)
/// and throws Cancelled then. Cost: one factorisation by fronts (FrontTree) in one thread, which keeps none
/// of L; 1 s for 26,000 particles of a sheet. Source: Liu, The multifrontal method for sparse matrix
/// solution, SIAM Review 34(1), 1992.
int negative_pivots(const BlockMatrix::Sparse& lower);

}  // namespace furrow::physics
