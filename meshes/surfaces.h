// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "geometry/mesh/mesh.h"
#include "meshes/marching.h"

/// From functions of a point to triangles. The same input gives the same mesh.
namespace furrow::meshes {

/// The surface of a solid in triangles of about this edge [m], closed, wound outward: marching tetrahedra,
/// remeshed, with each vertex moved onto the surface. The box from `low` to `high` must hold all of it.
geometry::Mesh mesh_surface(const Solid& solid, const Vec& low, const Vec& high, double edge);

/// The part of the mesh where `keep` > 0. Triangles that its zero crosses are cut, by a straight line in
/// each.
geometry::Mesh cut(const geometry::Mesh& mesh, const Solid& keep);

/// Triangles of about this edge [m] on the same surface; the borders stay the curves that they are.
void remesh(geometry::Mesh& mesh, double edge, int rounds = 3);

/// Moves the mesh upwards or downwards until its lowest vertex is at y = 0.
void stand_on_ground(geometry::Mesh& mesh);

}  // namespace furrow::meshes
