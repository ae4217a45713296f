// SPDX-License-Identifier: GPL-3.0-or-later
#include "bridge/arrays/gather_particles.h"

#include <stdexcept>
#include <string>

#include "bridge/arrays/convert.h"
#include "geometry/mesh/errors.h"
#include "geometry/mesh/property_names.h"
#include "geometry/mesh/struts.h"

namespace furrow::bridge {
namespace {

/// The same mass for all that have any.
void share_equally(physics::Particles& p) {
  double total = 0, count = 0;
  for (const double m : p.mass) total += m, count += m > 0;
  for (std::size_t i = 0; i < p.size(); ++i) {
    if (!(p.mass[i] > 0)) continue;
    p.mass[i] = total / count;
    p.inv_mass[i] = count / total;
  }
}

}  // namespace

physics::Particles gather_particles(const geometry::Mesh& mesh, MassRule rule) {
  using namespace geometry;
  const auto mass = find_map(mesh, attribute::mass);
  if (!mass) throw std::invalid_argument(std::string("gather: the mesh has no map ") + attribute::mass.name);
  const auto velocity = find_map(mesh, attribute::velocity);
  const std::vector<char> loose = loose_vertices(mesh);
  physics::Particles p;
  for (Vertex v : mesh.vertices()) {
    const double m = loose[v] ? 0 : (*mass)[v];
    if (!(m >= 0) || (m == 0 && !loose[v]))
      throw ContentError("vertex " + std::to_string(v) + " has mass " + std::to_string(m) +
                         (is_chain(mesh) ? "; a vertex with links needs one, or say `line_density`"
                                         : "; remove its faces (`furrow info` counts degenerate ones)"));
    p.x.push_back(to_eigen(mesh.point(v)));
    p.v.push_back(velocity ? to_eigen(CGAL::ORIGIN + (*velocity)[v]) : physics::Vec3::Zero());
    p.mass.push_back(m);
    p.inv_mass.push_back(m > 0 ? 1 / m : 0);
  }
  if (rule == MassRule::equal) share_equally(p);
  return p;
}

}  // namespace furrow::bridge
