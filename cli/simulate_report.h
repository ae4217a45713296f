// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "cli/body.h"
#include "io/mesh/wrinkle_record.h"
#include "physics/motion/simulate.h"

namespace furrow::cli {

/// What a simulation reached: the work done, strain, rest, penetration by exact distance, self-intersections,
/// and the height of each line against what it was (`before`, by line id).
Json to_json(const physics::SimulateReport& report, const io::MeshFile& file, const io::WrinkleRecord& record,
             const std::vector<double>& before, const WorldBody* body, double contact_gap);

/// The border loops, longest first: lengths at rest and in space, mean height, mean horizontal radius [m].
Json borders_to_json(const geometry::Mesh& mesh);

/// Heights of the lines of a mesh by id; NaN where a line has no vertices [m].
std::vector<double> line_heights_by_id(const io::MeshFile& file);

}  // namespace furrow::cli
