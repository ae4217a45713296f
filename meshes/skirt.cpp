// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>

#include "meshes/garments.h"
#include "meshes/implicit_shapes.h"
#include "meshes/surfaces.h"

namespace furrow::meshes {
namespace {

constexpr double kWaist = 1.055, kHem = 0.49;  // heights [m]

/// A little beyond the waist and the hem, where it is cut.
const Loft kSkirt({0, 0, 0}, {0, 1, 0}, {1, 0, 0}, {0, 0, 1},
                  {{0.44, 0.271, 0.249, -0.006},
                   {0.52, 0.258, 0.236, -0.006},
                   {0.60, 0.246, 0.224, -0.008},
                   {0.72, 0.226, 0.203, -0.010},
                   {0.84, 0.202, 0.178, -0.012},
                   {0.92, 0.183, 0.157, -0.010},
                   {1.00, 0.153, 0.122, 0.000},
                   {1.055, 0.131, 0.101, 0.005},
                   {1.12, 0.131, 0.101, 0.005}});

}  // namespace

geometry::Mesh make_skirt() {
  const geometry::Mesh tube = mesh_surface(kSkirt, {-0.3, 0.42, -0.3}, {0.3, 1.14, 0.3}, 0.010);
  geometry::Mesh mesh = cut(tube, [](const Vec& p) { return std::min(p.y() - kHem, kWaist - p.y()); });
  remesh(mesh, 0.0145);
  return mesh;
}

}  // namespace furrow::meshes
