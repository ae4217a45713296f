// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <vector>

#include "geometry/mesh/mesh.h"
#include "io/picture/render.h"

namespace furrow::io {

inline constexpr Colour warp_colour{0.80f, 0.16f, 0.10f};
inline constexpr Colour weft_colour{0.10f, 0.32f, 0.70f};

/// The threads of a garment as crosses on its faces, some `spacing` [m] apart, > 0: a long stroke along the
/// warp, a short one along the weft, of the lengths 0.7 and 0.35 spacing, on the outer side. Faces without
/// a direction (geometry/rest/warp_directions.h) get none. O(area / spacing^2 + faces).
std::vector<RenderLine> weave_lines_from(const geometry::Mesh& mesh, double spacing);

/// A spacing that shows some 40 crosses along the diagonal of the garment's box [m].
double weave_spacing(const geometry::Mesh& mesh);

}  // namespace furrow::io
