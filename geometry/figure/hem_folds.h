// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <span>

#include "geometry/mesh/border_loops.h"

namespace furrow::geometry {

/// Peaks of a closed sequence of values that stand out: from each to the next one the values fall by
/// `prominence` or more, and rise again by as much. 0 where the whole range is less. Throws
/// std::invalid_argument if the prominence is not > 0 or a value is not finite. O(values).
int count_peaks(std::span<const double> values, double prominence);

/// How many folds a hem has: count_peaks() of the horizontal (x, z) distance of its vertices from its centre,
/// the mean over its length. `prominence` [m] > 0. An oval hem without folds has two.
int count_folds(const Mesh& mesh, const BorderLoop& hem, double prominence = 0.002);

}  // namespace furrow::geometry
