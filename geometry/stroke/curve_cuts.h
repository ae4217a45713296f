// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "geometry/mesh/mesh.h"
#include "geometry/stroke/fold_curve.h"

namespace furrow::geometry {

/// Takes loops out of a curve that are shorter than half its width there, as a jittering hand draws them: no
/// fold can follow them. Arc lengths are not measured again. Returns how many points went. O(n log n) for
/// curves that do not lie close to themselves.
std::size_t drop_small_loops(const Mesh& mesh, FoldCurve& curve);

/// Sets FoldCurve::cuts: the points at which the curve is cut so that no arc crosses itself, or comes nearer
/// to itself than 0.03 widths on the same layer of cloth. Cuts lie as far from the crossings as they can. Of
/// a closed curve that meets itself the first cut opens it. None: it does not meet itself.
void cut_where_it_meets_itself(const Mesh& mesh, FoldCurve& curve);

}  // namespace furrow::geometry
