// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <vector>

#include "jobs/base/inputs.h"
#include "jobs/draw/drawn_round.h"

namespace furrow::jobs {

/// Of a mesh without the lines of this round.
ShapeQuality quality_before(const geometry::Mesh& mesh);

/// Of the mesh with the lines, from what wrinkle() reports of them. A small part of wrinkle()'s own time.
ShapeQuality quality_of_lines(const geometry::Mesh& mesh, const geometry::WrinkleReport& report);
/// The same at other places of its vertices; rest lengths do not count then.
ShapeQuality quality_of_lines(const geometry::Mesh& mesh, const std::vector<geometry::Point>& places,
                              const geometry::WrinkleReport& report);

Json to_json(const DrawnQuality& quality);

}  // namespace furrow::jobs
