// SPDX-License-Identifier: GPL-3.0-or-later
#include <stdexcept>
#include <string>

#include "bridge/arrays/convert.h"
#include "bridge/arrays/gather.h"
#include "geometry/mesh/property_names.h"

namespace furrow::bridge {
namespace {

void check(const physics::Particles& particles, const geometry::Mesh& mesh) {
  if (particles.size() != mesh.number_of_vertices())
    throw std::invalid_argument("scatter: " + std::to_string(particles.size()) + " particles for " +
                                std::to_string(mesh.number_of_vertices()) + " vertices");
  if (mesh.has_garbage())
    throw std::invalid_argument("scatter: the mesh has removed elements; call its collect_garbage() first");
}

}  // namespace

void scatter(const physics::Particles& particles, geometry::Mesh& mesh) {
  check(particles, mesh);
  for (geometry::Vertex v : mesh.vertices()) mesh.point(v) = to_cgal(particles.x[v]);
}

void scatter_velocities(const physics::Particles& particles, geometry::Mesh& mesh) {
  check(particles, mesh);
  if (particles.v.size() != particles.size())
    throw std::invalid_argument("scatter: " + std::to_string(particles.v.size()) + " velocities of " +
                                std::to_string(particles.size()) + " particles");
  auto velocity = geometry::ensure_map(mesh, geometry::attribute::velocity);
  for (geometry::Vertex v : mesh.vertices()) velocity[v] = to_cgal(particles.v[v]) - CGAL::ORIGIN;
}

}  // namespace furrow::bridge
