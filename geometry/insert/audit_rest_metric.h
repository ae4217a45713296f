// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <cstddef>

#include "geometry/mesh/mesh.h"

namespace furrow::geometry {

struct RestMetricAudit {
  std::size_t inverted_faces =
      0;  ///< triangle inequality fails, or Heron area < 1e-12 of the longest edge squared
  std::size_t duplicate_edges = 0;  ///< edges beyond the first between two vertices
  double min_angle_deg = 0;         ///< smallest angle of all faces; 0 if a face is inverted [degrees]
  double area = 0;                  ///< of all faces [m^2]
};

/// Measures a triangle mesh by e:rest_length (by lengths in space where that is not set). O(edges log edges).
RestMetricAudit audit_rest_metric(const Mesh& mesh);

}  // namespace furrow::geometry
