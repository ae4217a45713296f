// SPDX-License-Identifier: GPL-3.0-or-later
// Apart from the other meshes: CGAL's remeshing takes long to compile.
#include <CGAL/Polygon_mesh_processing/remesh.h>

#include "tests/geometry/insert/insertion_meshes.h"

namespace furrow::tests {

using namespace geometry;

Mesh irregular_sheet(int columns) {
  Mesh mesh = regular_sheet(columns, 0.3, 7);
  CGAL::Polygon_mesh_processing::isotropic_remeshing(
      faces(mesh), 0.9 / columns, mesh,
      CGAL::parameters::number_of_iterations(2).number_of_relaxation_steps(1).protect_constraints(false));
  mesh.collect_garbage();
  return mesh;
}

}  // namespace furrow::tests
