// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <optional>

#include "io/mesh/mesh_file.h"
#include "jobs/base/inputs.h"
#include "physics/body/collider.h"

namespace furrow::jobs {

/// Lines that the body leaves no room for as they were drawn: less than 80 % of their height is farther from
/// it than the gap [m], on the mean of where a line is full. Names each with the height for which there is
/// room; none: no such line, or the mesh does not say where its lines lay before. Cost: a distance for each
/// vertex of a line.
std::optional<Warning> lines_without_room(const io::MeshFile& drawn, const physics::Collider& body,
                                          double gap);

}  // namespace furrow::jobs
