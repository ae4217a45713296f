// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <string>
#include <vector>

#include "io/picture/render.h"
#include "jobs/draw/quality.h"

namespace furrow::jobs {

/// B1 to B9 with their targets (docs/quality.md). `why`: lines could not be measured; `is_fine`: the mesh was
/// made with detail "fine".
std::vector<QualityMeasure> judged(const QualityReport& report, const std::string& why, bool is_fine);

/// The cloth coloured by its angle defects, red where it is a dome, blue where it is a saddle, full at
/// `quality_colour_limit`, with a ball at the worst places.
io::RenderScene quality_scene(const QualityReport& report);
inline constexpr double quality_colour_limit = 400;  ///< [rad/m^2]

}  // namespace furrow::jobs
