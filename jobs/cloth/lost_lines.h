// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <vector>

#include "io/scene/scene.h"
#include "jobs/cloth/shape_report.h"

namespace furrow::jobs {

/// A line that keeps less of its height is lost [-].
inline constexpr double lost_below = 0.5;

/// Lines that lost more than half of their height, or turned over to the other side, and those that their
/// thread did not draw in as asked, with figures and what helps.
std::vector<Warning> lost_lines(const io::Scene& scene, const std::vector<LineReport>& lines);

}  // namespace furrow::jobs
