// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <functional>

#include "geometry/mesh.h"
#include "meshes/implicit_shapes.h"

/// From functions of a point to triangles. The same input gives the same mesh.
namespace furrow::meshes {

using Solid = std::function<double(const Vec&)>;  ///< < 0 inside

struct SurfaceOptions {
  double radius = 0.012;    ///< largest circumradius of a triangle [m]
  double distance = 0.001;  ///< largest distance of its circumcentre from the surface [m]
};

/// The surface of a solid by Delaunay refinement (CGAL's Surface_mesher; Boissonnat & Oudot 2005): closed,
/// wound outward, no angle below 25 degrees. The ball around `center`, a point inside, of `reach` [m] must
/// hold it all.
geometry::Mesh mesh_surface(const Solid& solid, const Vec& center, double reach,
                            const SurfaceOptions& options);

/// Where `keep` > 0; triangles that its zero crosses are cut, the cut being straight in each of them.
geometry::Mesh cut(const geometry::Mesh& mesh, const Solid& keep);

/// Triangles of about this edge [m] on the same surface; the borders stay the curves that they are.
void remesh(geometry::Mesh& mesh, double edge);

/// Moves the mesh upwards or downwards until its lowest vertex is at y = 0.
void stand_on_ground(geometry::Mesh& mesh);

}  // namespace furrow::meshes
