// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <cstddef>

#include "geometry/band/band_mesh.h"
#include "geometry/band/band_sizing.h"

namespace furrow::geometry {

/// One round of better places for the band's new vertices, and Delaunay flips after it. A free vertex goes
/// 0.7 of the way to the mean of its faces' centroids, weighted by area over the square of the sizing; one on
/// a curve slides along it, one on the border along that, to the middle of its two neighbours there. A step
/// that turns a face over, or makes the worst face of a star worse where it is bad, is refused. Vertices of
/// the mesh given stay, except those that were moved onto a curve: they slide with it. Keeps the rest metric.
/// Returns how many moved. O(vertices of the band).
std::size_t relax_band(BandMesh& band, const BandSizing& sizing);

/// Where relaxation takes the centre of a star: 0.7 of the way to the mean of its faces' centroids, weighted
/// by area over the square of `size`, the sizing by vertex; (0, 0) for a star without area.
Place2 relaxed_place(const Mesh& mesh, const Star& star, const std::vector<double>& size);

}  // namespace furrow::geometry
