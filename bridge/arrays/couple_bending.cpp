// SPDX-License-Identifier: GPL-3.0-or-later
#include "bridge/arrays/couple_bending.h"

#include <cmath>
#include <optional>
#include <stdexcept>
#include <string>

#include "geometry/figure/attached_parts.h"
#include "geometry/fold/line_press.h"
#include "geometry/mesh/edge_metric.h"
#include "geometry/mesh/errors.h"
#include "geometry/mesh/property_names.h"
#include "geometry/rest/warp_directions.h"
#include "physics/cloth/pins.h"

namespace furrow::bridge {
namespace {

using namespace geometry;

/// Of the edges opposite the corners of each triangle, in the order of triangles_of().
std::vector<std::array<double, 3>> opposite_lengths(const Mesh& mesh, Membrane membrane) {
  const std::vector<double> rest = rest_lengths(mesh);
  std::optional<HalfedgeMap<double>> own;
  if (membrane == Membrane::triangles || membrane == Membrane::patches)
    own = find_map(mesh, attribute::triangle_rest_length);
  const auto length = [&](Halfedge h) {
    const double l = own && !std::isnan((*own)[h]) ? (*own)[h] : rest[mesh.edge(h).idx()];
    if (!(l > 0) || !std::isfinite(l))
      throw ContentError("the edge between vertices " + std::to_string(mesh.source(h).idx()) + " and " +
                         std::to_string(mesh.target(h).idx()) + " has rest length " + std::to_string(l) +
                         "; remove it (`furrow info` counts degenerate faces)");
    return l;
  };
  std::vector<std::array<double, 3>> result;
  result.reserve(mesh.number_of_faces());
  for (Face f : mesh.faces()) {
    const Halfedge h = mesh.halfedge(f);
    result.push_back({length(mesh.next(h)), length(mesh.prev(h)), length(h)});
  }
  return result;
}

/// Of each face, to the edge from its corner 0 to its corner 1 (triangles_of()).
std::vector<double> warp_angles(const Mesh& mesh) {
  const std::vector<double> rest = rest_lengths(mesh);
  std::vector<double> angles;
  for (Face f : mesh.faces()) angles.push_back(known_warp_angle(mesh, mesh.halfedge(f), rest));
  return angles;
}

physics::PlateRigidity rigidity_of(const Weave& w) { return {w.bend_warp, w.bend_weft, w.twist, 0}; }

Edge edge_of(const Mesh& mesh, const physics::Hinge& hinge) {
  using Index = Vertex::size_type;
  const Halfedge h = mesh.halfedge(Vertex(Index(hinge.vertices[0])), Vertex(Index(hinge.vertices[1])));
  if (h == Mesh::null_halfedge()) throw std::invalid_argument("couple_bending: a hinge is not of this mesh");
  return mesh.edge(h);
}

}  // namespace

physics::CoupledHinges couple_bending(const Mesh& mesh, const GatherOptions& options, physics::Cloth& cloth) {
  if (options.bending != Bending::plate) return {};
  const auto lengths = of_cloth(mesh, opposite_lengths(mesh, options.membrane));
  if (cloth.particles.size() != mesh.number_of_vertices() || cloth.triangles.size() != lengths.size())
    throw std::invalid_argument("couple_bending: the cloth is not of this mesh");
  const std::vector<double> presses = hinge_presses(mesh, options.line_presses, options.line_widths);
  const auto own = find_map(mesh, attribute::hinge_stiffness);
  std::vector<char> apart;
  std::vector<double> press;
  for (const physics::Hinge& hinge : cloth.hinges) {
    const Edge e = edge_of(mesh, hinge);
    apart.push_back(own && !std::isnan((*own)[e]));
    press.push_back(presses.empty() ? 1 : presses[e.idx()]);
  }
  const std::vector<double> warp = options.weave ? of_cloth(mesh, warp_angles(mesh)) : std::vector<double>{};
  const physics::PlateRigidity rigidity =
      options.weave ? rigidity_of(*options.weave) : physics::isotropic_plate(options.rigidity);
  // Clamps stay doubled where hinges stay plain; the plate's count as they were.
  return physics::couple_hinges(cloth, lengths, {rigidity, warp}, apart, press);
}

}  // namespace furrow::bridge
