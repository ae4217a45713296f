// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <optional>

#include "geometry/insert/insertion.h"
#include "geometry/insert/mesh_editor.h"

namespace furrow::geometry {

/// Why this edge must not be flipped; none: it may. The paper's rule asks only what would break the
/// half-edges (border, duplicate edge). The safe rule asks besides: seam, line edge, both faces after the
/// flip at least 1e-3 of the pair's area in the rest metric and in the texture chart, at least three edges
/// left at an inner vertex and two at a border vertex, and InsertionOptions::may_flip. O(valence).
std::optional<Refusal> refusal_of_flip(const MeshEditor& editor, Edge edge, const InsertionOptions& options);

/// Whether a flip would fold a face over in the rest metric.
bool folds_over(const MeshEditor& editor, Edge edge);

}  // namespace furrow::geometry
