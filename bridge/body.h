// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "geometry/figure/repair_body.h"
#include "physics/base/triangle_mesh.h"

namespace furrow::bridge {

/// A repaired body as the plain triangles that distance queries take.
physics::TriangleMesh to_triangle_mesh(const geometry::Body& body);

}  // namespace furrow::bridge
