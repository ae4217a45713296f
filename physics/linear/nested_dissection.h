// SPDX-License-Identifier: MIT
#pragma once
#include <vector>

#include "physics/linear/column_rows.h"

namespace furrow::physics {

/// An order of elimination for a sparse symmetric matrix that keeps its Cholesky factor small: the place of
/// each column. Separators come last, so that the elimination tree has balanced branches. Same input, same
/// order; one call at a time (METIS draws from rand(): it is seeded anew here). Asks every 0.2 s at most
/// whether it is cancelled (cancel_scope.h) and throws Cancelled then. Cost: O(n log n); 0.1 s for 12,000
/// vertices of a garment. Throws std::bad_alloc. Source: METIS_NodeND; Karypis and Kumar, A fast and high
/// quality multilevel scheme for partitioning irregular graphs, SIAM J. Sci. Comput. 20(1), 1998.
std::vector<int> nested_dissection(const ColumnRows& below);

}  // namespace furrow::physics
