// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <optional>

#include "geometry/fold/wrinkle.h"
#include "jobs/base/ends.h"
#include "jobs/base/inputs.h"

namespace furrow::jobs {

/// Lines that raised one layer of cloth through another: pairs of faces that cross, neither of which would
/// cross any if the lines had no height, and that no short way along the cloth joins, so that they do not
/// gather in one bend. None: they did not. `now`: of the mesh. About the cost of two measure_crossings(),
/// where there are new ones.
std::optional<Warning> layers_crossed(const geometry::Mesh& mesh, const geometry::WrinkleReport& lines,
                                      const ClothCrossings& now);

/// Lines on cloth that is inside out, so that ridges go in and valleys come out: on parts with several
/// openings, or none, whose faces enclose less than nothing once the openings are closed. None: no line is.
std::optional<Warning> lines_inside_out(const geometry::Mesh& mesh, const geometry::WrinkleReport& lines);

}  // namespace furrow::jobs
