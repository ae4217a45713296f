// SPDX-License-Identifier: GPL-3.0-or-later
#include "bridge/scatter.h"

#include <stdexcept>
#include <string>

#include "bridge/convert.h"

namespace furrow::bridge {

void scatter(const physics::Particles& particles, geometry::Mesh& mesh) {
  if (particles.size() != mesh.number_of_vertices())
    throw std::invalid_argument("scatter: " + std::to_string(particles.size()) + " particles for " +
                                std::to_string(mesh.number_of_vertices()) + " vertices");
  for (geometry::Vertex v : mesh.vertices()) mesh.point(v) = to_cgal(particles.x[v]);
}

}  // namespace furrow::bridge
