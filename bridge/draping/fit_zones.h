// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <vector>

#include "bridge/draping/fit_report.h"

namespace furrow::bridge {

struct FitZones {
  std::vector<FitZone> zones;  ///< largest first; height_share and side are not set
  std::size_t left_out = 0;    ///< too small
};

/// Zones of faces whose corners have a mean value over the threshold, joined through edges. Zones of less
/// than `smallest` [m^2] are left out. `values` are by vertex index. The faces are triangles. O(faces).
/// Throws std::invalid_argument if there are fewer values than vertices.
FitZones fit_zones(const geometry::Mesh& mesh, const std::vector<double>& values, double threshold,
                   double smallest);
/// The same for chosen faces (by face index: not 0), whose peaks are given by face index.
FitZones fit_zones(const geometry::Mesh& mesh, std::vector<char> chosen, const std::vector<double>& peaks,
                   double smallest);

}  // namespace furrow::bridge
