// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "geometry/mesh/parts.h"
#include "geometry/mesh/self_intersections.h"
#include "jobs/base/ends.h"

namespace furrow::jobs {

/// Of a mesh, as it is known after so many Loop refinements. Costs a count, and where cloth crosses the
/// refinements, too. Throws as geometry::find_crossings().
CrossedStart crossed_start(const geometry::Mesh& mesh, int refinements = 0);

/// Counts and places what crosses in a garment now; `start` (null: only one state is known) tells old
/// crossings from new ones: parts that ride on cloth as one, and crossed it then, are left out. `memory`
/// (null: none) has what changed little looked at in places. Throws as geometry::find_crossings(). Cost: some
/// 3 us a face.
ClothCrossings measure_crossings(const io::MeshFile& file, const CrossedStart* start = nullptr,
                                 geometry::CrossingMemory* memory = nullptr);

}  // namespace furrow::jobs
