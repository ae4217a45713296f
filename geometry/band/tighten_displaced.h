// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <cstddef>
#include <vector>

#include "geometry/band/band_mesh.h"

namespace furrow::geometry {

/// Flips edges of the band by which the displaced shape has less of a false Gaussian curvature: cloth has
/// next to none, but a fold cut into triangles anyhow has knobs, however short its edges. A flip lessens the
/// sum of the absolute angle defects at the four corners, with a small share of the bends of the five edges,
/// which decides where the cloth is a dome already. No face gets an angle below 17 degrees in the displaced
/// shape or below 13.5 in the rest metric, but where one was as small before. Largest gain first; no vertex
/// moves, and a shape without heights keeps its edges. `displaced` is by vertex. Returns how many were
/// flipped; O(n log n).
///
/// \details Alboul and van Damme, Polyhedral metrics in surface reconstruction: tight triangulations (1997),
/// and Dyn, Hormann, Kim and Levin, Optimizing 3D triangulations using discrete curvature analysis (2001),
/// describe such flips for triangulated points. The angle defect of points on a cylinder does not go to zero
/// with their distance unless edges lie along its rulings.
std::size_t tighten_displaced(BandMesh& band, const std::vector<Point>& displaced);

}  // namespace furrow::geometry
