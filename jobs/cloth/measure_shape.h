// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "jobs/body/world_body.h"
#include "jobs/cloth/shape_report.h"

namespace furrow::jobs {

/// The borders of a mesh with rest lengths, longest first.
std::vector<BorderReport> measure_borders(const geometry::Mesh& mesh);
/// Heights of the lines of a mesh by id; NaN where a line has no vertices [m].
std::vector<double> line_heights_by_id(const io::MeshFile& file);
/// Its lines, if its file notes any; `before`: as for measure_shape().
std::vector<LineReport> measure_lines(const io::MeshFile& file, const std::vector<double>& before);
/// Measures a garment, but not its crossings; `before`: heights by line id at the run's start [m]; `body`:
/// null: none.
ReachedShape measure_shape(const io::MeshFile& file, const std::vector<double>& before, const WorldBody* body,
                           double contact_gap, double time);

}  // namespace furrow::jobs
