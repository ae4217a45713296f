// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "bridge/keeping/draw_more.h"
#include "geometry/fold/wrinkle.h"
#include "geometry/rest/rest_state.h"
#include "io/mesh/mesh_file.h"
#include "jobs/base/inputs.h"
#include "jobs/draw/drawn_round.h"

namespace furrow::jobs {

/// What an insertion did and what the rest metric is after it, as `subdivide` and `wrinkle` report it.
Json to_json(const geometry::InsertionReport& report, const geometry::Mesh& mesh);
Json to_json(const geometry::InsertionReport& report, const geometry::RestMetricAudit& rest);
/// `first_line` is the id of the first line.
Json to_json(const geometry::WrinkleReport& report, const geometry::Mesh& mesh, int first_line);
Json to_json(const geometry::WrinkleReport& report, const geometry::RestMetricAudit& rest, int first_line);

/// What drawing into a cloth in motion did to it, at a time [s].
Json to_json(const bridge::DrawMoreReport& report, double time);

/// A round of lines, with what drawing it in motion and keeping its shape did.
Json to_json(const DrawnRound& round);

/// The first id above those of the lines that a mesh has.
int next_line(const geometry::Mesh& mesh);

}  // namespace furrow::jobs
