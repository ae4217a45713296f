// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <span>

#include "jobs/rest/drape.h"

namespace furrow::jobs {

/// What is told of parts of the garment as it was given; seeds: a vertex of each.
LooseParts loose_parts_of(const io::MeshFile& given, std::span<const int> seeds);

/// Moves each loose part of a garment that was draped as a rigid body, with the triangle of the other parts
/// that lay nearest to its middle. given: before, not refined yet. Without another part they stay. Cost:
/// O(faces) a part.
void carry_loose_parts(geometry::Mesh& draped, const geometry::Mesh& given, int refinements,
                       std::span<const int> seeds);

/// Takes parts out of a file; seeds: a vertex of each. What struts and lines name goes with its vertices. The
/// order of the other vertices stays where the parts are the file's last. Cost: O(vertices + faces).
void drop_parts(io::MeshFile& file, std::span<const int> seeds);

}  // namespace furrow::jobs
