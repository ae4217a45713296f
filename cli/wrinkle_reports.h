// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "cli/common.h"
#include "geometry/wrinkle.h"

namespace furrow::cli {

/// What an insertion did and what the rest metric is after it, as `subdivide` and `wrinkle` report it.
Json to_json(const geometry::InsertionReport& report, const geometry::Mesh& mesh);
Json to_json(const geometry::WrinkleReport& report, const geometry::Mesh& mesh);

}  // namespace furrow::cli
