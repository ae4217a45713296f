// SPDX-License-Identifier: GPL-3.0-or-later
#include "bridge/gather.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "bridge/convert.h"
#include "geometry/bending_springs.h"
#include "geometry/errors.h"
#include "geometry/property_names.h"
#include "geometry/stiffness.h"

namespace furrow::bridge {
namespace {

using namespace geometry;

void check(const Mesh& mesh, const GatherOptions& o) {
  const auto fail = [](const std::string& what) { throw std::invalid_argument("gather: " + what); };
  const auto range = [&](const char* name, double value, bool fine) {
    if (!fine) fail(std::string(name) + " = " + std::to_string(value) + " is out of its range");
  };
  range("structural_stiffness", o.structural_stiffness, o.structural_stiffness > 0);
  range("bending_stiffness", o.bending_stiffness, o.bending_stiffness >= 0);
  range("mean_structural_length", o.mean_structural_length, o.mean_structural_length > 0);
  range("mean_bending_length", o.mean_bending_length, o.mean_bending_length >= 0);
  if (mesh.has_garbage()) fail("the mesh has removed elements");
  if (!find_map(mesh, kMass)) fail(std::string("the mesh has no map ") + kMass.name);
  if (!find_map(mesh, kRestLength)) fail(std::string("the mesh has no map ") + kRestLength.name);
}

/// The spring between two vertices, stiff by S1.7's law, as `count` springs side by side.
physics::Spring spring(Vertex a, Vertex b, double rest, double r_avg, double k_std, int count = 1) {
  const int i = static_cast<int>(a), j = static_cast<int>(b);
  if (!(rest > 0) || !std::isfinite(rest))
    throw ContentError("the spring between vertices " + std::to_string(i) + " and " + std::to_string(j) +
                       " has rest length " + std::to_string(rest) +
                       "; remove the edge (furrow info counts degenerate faces)");
  return {std::min(i, j), std::max(i, j), rest, count * spring_stiffness(rest, r_avg, k_std)};
}

void sort_by_pair(std::vector<physics::Spring>& springs) {
  std::sort(springs.begin(), springs.end(), [](const physics::Spring& s, const physics::Spring& t) {
    return s.a != t.a ? s.a < t.a : s.b < t.b;
  });
}

physics::Particles particles_of(const Mesh& mesh) {
  const auto mass = *find_map(mesh, kMass);
  const auto velocity = find_map(mesh, kVelocity);
  physics::Particles p;
  for (Vertex v : mesh.vertices()) {
    const double m = mesh.is_isolated(v) ? 0 : mass[v];
    if (!(m >= 0) || (m == 0 && !mesh.is_isolated(v)))
      throw ContentError("vertex " + std::to_string(v) + " has mass " + std::to_string(m) +
                         "; remove its faces (furrow info counts degenerate ones)");
    p.x.push_back(to_eigen(mesh.point(v)));
    p.v.push_back(velocity ? to_eigen(CGAL::ORIGIN + (*velocity)[v]) : physics::Vec3::Zero());
    p.mass.push_back(m);
    p.inv_mass.push_back(m > 0 ? 1 / m : 0);
  }
  return p;
}

}  // namespace

physics::Cloth gather(const Mesh& mesh, const GatherOptions& o) {
  check(mesh, o);
  physics::Cloth cloth;
  cloth.particles = particles_of(mesh);
  const auto rest = *find_map(mesh, kRestLength);
  for (Edge e : mesh.edges())
    cloth.structural.push_back(spring(mesh.vertex(e, 0), mesh.vertex(e, 1), rest[e], o.mean_structural_length,
                                      o.structural_stiffness));
  for (const BendingSpring& b : bending_springs(mesh))
    cloth.bending.push_back(
        spring(b.a, b.b, b.rest_length, o.mean_bending_length, o.bending_stiffness, b.count));
  sort_by_pair(cloth.structural);
  sort_by_pair(cloth.bending);
  cloth.triangles = triangles_of(mesh);
  return cloth;
}

}  // namespace furrow::bridge
