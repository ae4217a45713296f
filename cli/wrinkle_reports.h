// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "bridge/draw_more.h"
#include "cli/common.h"
#include "geometry/fold/wrinkle.h"
#include "io/mesh/wrinkle_record.h"
#include "io/picture/render.h"

namespace furrow::cli {

/// What an insertion did and what the rest metric is after it, as `subdivide` and `wrinkle` report it.
Json to_json(const geometry::InsertionReport& report, const geometry::Mesh& mesh);
/// `first_line` is the id of the first line.
Json to_json(const geometry::WrinkleReport& report, const geometry::Mesh& mesh, int first_line);

/// What drawing into a cloth in motion did to it, at a time [s].
Json to_json(const bridge::DrawMoreReport& report, double time);

/// A mesh at the stage of inserted vertices as a picture, before anything is displaced; `before` is the mesh
/// without the lines.
io::RenderScene preview_of(const geometry::Mesh& inserted, const geometry::Mesh& before,
                           const geometry::WrinkleReport& report, const io::WrinkleRecord& record);

/// The first id above those of the lines that a mesh has.
int next_line(const geometry::Mesh& mesh);

}  // namespace furrow::cli
