// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "cli/common.h"
#include "geometry/wrinkle.h"

namespace furrow::cli {

/// What an insertion did and what the rest metric is after it, as `subdivide` and `wrinkle` report it.
Json to_json(const geometry::InsertionReport& report, const geometry::Mesh& mesh);
/// `first_line` is the id of the first line.
Json to_json(const geometry::WrinkleReport& report, const geometry::Mesh& mesh, int first_line);

/// The first id above those of the lines that a mesh has.
int next_line(const geometry::Mesh& mesh);

}  // namespace furrow::cli
