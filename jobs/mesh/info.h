// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "io/mesh/mesh_file.h"
#include "jobs/base/inputs.h"

namespace furrow::jobs {

/// What a mesh is: counts, topology, lengths [m], areas, faults, borders, groups, lines, and what was
/// repaired when it was read; of a mesh without faces its links (cloth/chain.h). Cost: that of
/// geometry::count_self_intersections().
Json info(const io::MeshFile& file);

}  // namespace furrow::jobs
