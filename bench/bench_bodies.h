// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <string>

#include "physics/base/arrays.h"

namespace furrow::bench {

/// Geodesic sphere of 20 * frequency^2 triangles, radius about 1 m, with low bumps and a radial noise of 0.3
/// edge lengths: the body that other distance libraries were measured with. It is the same in every run.
physics::TriangleMesh noisy_sphere(int frequency);

/// Reads `v` and `f` of an OBJ file; polygons are cut from their first corner.
physics::TriangleMesh read_obj(const std::string& path);

/// One round of CGAL's Loop subdivision.
physics::TriangleMesh loop_once(const physics::TriangleMesh& mesh);

}  // namespace furrow::bench
