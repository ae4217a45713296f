// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <vector>

#include "bridge/fit_zones.h"
#include "geometry/mesh/mesh.h"
#include "physics/base/triangle_mesh.h"
#include "physics/body/exact_distance.h"

namespace furrow::bridge {

/// Where a body comes through a garment.
struct FitPiercing {
  std::size_t faces = 0;       ///< that cross or touch the body's surface (geometry/stroke/pierced_faces.h)
  double deepest = 0;          ///< of all points of the garment inside the body, as sampled [m], >= 0
  std::vector<FitZone> zones;  ///< of pierced faces and those with all corners inside; peak: their depth [m]
};

/// `distances`: of the vertices to the body, by index. Inside a pierced face the depth is sampled every 5 mm
/// (256 times along an edge longer than 1.25 m), elsewhere at the vertices: a face that is not pierced lies
/// on one side of a closed body. Height and side of zones are not set. Throws as pierced_faces(), and
/// std::invalid_argument for too few distances. Cost: that of pierced_faces(), and a query (1 us) a sample.
FitPiercing measure_piercing(const geometry::Mesh& garment, const physics::TriangleMesh& body,
                             const physics::ExactDistance& distance, const std::vector<double>& distances);

}  // namespace furrow::bridge
