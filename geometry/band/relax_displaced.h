// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <vector>

#include "geometry/band/band_mesh.h"
#include "geometry/band/band_sizing.h"
#include "geometry/band/refine_displaced.h"

namespace furrow::geometry {

/// One round of better places for the band's new vertices, as relax_band() gives, but in the displaced shape:
/// splits halve edges, and a mesh of halves has corners of four faces, at which even a smooth fold looks
/// knobbly. Only free vertices move, that lie on no curve, seam or border; the rest metric is kept. A step
/// that turns a face over in either shape, or makes the worst face of a star worse where it is bad, is
/// refused. `displaced` follows. Returns how many moved. O(vertices of the band).
std::size_t relax_displaced(BandMesh& band, const BandSizing& sizing, std::vector<Point>& displaced,
                            const Displacing& displacing);

}  // namespace furrow::geometry
