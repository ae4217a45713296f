// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "geometry/band/band_mesh.h"
#include "geometry/band/curve_arcs.h"
#include "geometry/band/refine_band.h"

namespace furrow::geometry {

/// What a band has become; min_angle_before_deg is the caller's. O(faces).
BandReport report_on(const BandMesh& band, const CurveArcs& arcs);

/// Of the band's faces, in the rest metric [degrees].
double smallest_angle_of(const BandMesh& band);

}  // namespace furrow::geometry
