// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>

#include "meshes/garments.h"
#include "meshes/implicit_shapes.h"
#include "meshes/surfaces.h"

namespace furrow::meshes {
namespace {

constexpr double waist_level = 1.055, hem_level = 0.49;  // heights [m]

/// A little beyond the waist and the hem, where it is cut.
const Loft skirt({0, 0, 0}, {0, 1, 0}, {1, 0, 0}, {0, 0, 1},
                 {{0.44, 0.218, 0.194, -0.010},
                  {0.52, 0.215, 0.191, -0.010},
                  {0.62, 0.211, 0.187, -0.010},
                  {0.72, 0.207, 0.182, -0.011},
                  {0.84, 0.199, 0.174, -0.012},
                  {0.92, 0.183, 0.156, -0.010},
                  {1.00, 0.153, 0.122, 0.000},
                  {1.055, 0.131, 0.101, 0.005},
                  {1.12, 0.131, 0.101, 0.005}});

}  // namespace

geometry::Mesh make_skirt() {
  const geometry::Mesh tube = mesh_surface(skirt, {-0.3, 0.42, -0.3}, {0.3, 1.14, 0.3}, 0.012);
  geometry::Mesh mesh =
      cut(tube, [](const Vec& p) { return std::min(p.y() - hem_level, waist_level - p.y()); });
  remesh(mesh, 0.021);
  return mesh;
}

}  // namespace furrow::meshes
