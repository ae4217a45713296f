// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <span>

#include "jobs/rest/drape.h"

namespace furrow::jobs {

/// What is told of parts of the garment as it was given; seeds: a vertex of each.
LooseParts loose_parts_of(const io::MeshFile& given, std::span<const int> seeds);

/// Which cloth a loose part goes with.
enum class LooseCarry {
  as_one,   ///< rigid, with the triangle that lay nearest to its middle: a button, a belt
  by_place  ///< each vertex as far off and on the same side of what lay nearest to it: a pocket, a patch
};

/// Moves each loose part of a garment that was draped with the other parts. given: before, not refined yet.
/// Without another part they stay. Cost: O(faces) a part; by place O(log faces) a vertex.
void carry_loose_parts(geometry::Mesh& draped, const geometry::Mesh& given, int refinements,
                       std::span<const int> seeds, LooseCarry carry = LooseCarry::as_one);

/// Takes parts out of a file; seeds: a vertex of each. What struts and lines name goes with its vertices. The
/// order of the other vertices stays where the parts are the file's last. Cost: O(vertices + faces).
void drop_parts(io::MeshFile& file, std::span<const int> seeds);

}  // namespace furrow::jobs
