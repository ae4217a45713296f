// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <span>

#include "geometry/band/band_mesh.h"
#include "geometry/band/band_sizing.h"

namespace furrow::geometry {

/// The faces of the band: those that hang together with the faces that the curves run over, through faces
/// near a curve or with an edge longer than the sizing wants. Other layers of cloth, however near, are none.
/// By face index. O(faces of the band).
std::vector<bool> band_faces(const Mesh& mesh, const EdgeMap<double>& rest, std::span<const FoldCurve> curves,
                             const BandSizing& sizing);

/// Splits edges of the band, the longest first, until none is longer at rest than 1.33 of the sizing at its
/// middle. Where a side of its two faces is longer than 1.25 of it, that side is split first (Rivara's
/// longest edge), so that angles stay bounded. Returns how many. O(n log n).
std::size_t split_band(BandMesh& band, const BandSizing& sizing);

}  // namespace furrow::geometry
