// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "geometry/fold/wrinkle.h"

namespace furrow::geometry {

/// wrinkle() under rule fold. Strokes become smooth curves with a width (prepare_strokes.h); the mesh around
/// them is refined to a band with a vertex chain on each (band/refine_band.h); new vertices are laid on a
/// curved surface over the facets, unless options.flat_base (fold_base.h); all are raised by the joined
/// heights of the folds (fold_heights.h) along averaged normals; edges that became too long are split again;
/// Taubin's filter with the cotangents of the unraised cloth takes what roughness is left, but nowhere so
/// that a face becomes thin; and the rest state follows (rest/fold_rest.h). Held vertices stay. Throws as
/// wrinkle() does.
WrinkleReport fold_lines(Mesh& mesh, std::span<const Stroke> strokes, const WrinkleOptions& options,
                         const StageObserver& observer);

}  // namespace furrow::geometry
