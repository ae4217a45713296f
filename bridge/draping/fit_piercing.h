// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <vector>

#include "bridge/draping/fit_report.h"

namespace furrow::bridge {

/// `distances`: of the vertices to the body, by index. Inside a pierced face the depth is sampled every 5 mm
/// (256 times along an edge longer than 1.25 m), elsewhere at the vertices: a face that is not pierced lies
/// on one side of a closed body. Height and side of zones are not set. Throws as pierced_faces(),
/// std::invalid_argument for too few distances, and physics::Cancelled (cancel_scope.h). Cost: that of
/// pierced_faces(), and a query (1 us) a sample.
FitPiercing measure_piercing(const geometry::Mesh& garment, const physics::TriangleMesh& body,
                             const physics::ExactDistance& distance, const std::vector<double>& distances);

}  // namespace furrow::bridge
