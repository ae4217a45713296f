// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/mesh/carry_attributes.h"

#include <algorithm>

#include "geometry/mesh/struts.h"

namespace furrow::geometry {

SavedAttributes::SavedAttributes(const Mesh& mesh) : old_vertices_(mesh.number_of_vertices()) {
  const auto texture = find_map(mesh, attribute::texture);
  const auto group = find_map(mesh, attribute::group), material = find_map(mesh, attribute::material);
  for (Face f : mesh.faces()) {
    std::array<Halfedge, 3> h = {mesh.halfedge(f)};
    h[1] = mesh.next(h[0]);
    h[2] = mesh.next(h[1]);
    corners_.push_back({mesh.target(h[0]), mesh.target(h[1]), mesh.target(h[2])});
    if (texture) texture_.push_back({(*texture)[h[0]], (*texture)[h[1]], (*texture)[h[2]]});
    if (group) group_.push_back((*group)[f]);
    if (material) material_.push_back((*material)[f]);
  }
}

std::size_t SavedAttributes::corner(Face face, Vertex v) const {
  const auto& c = corners_[face.idx()];
  return static_cast<std::size_t>(std::find(c.begin(), c.end(), v) - c.begin());
}

TextureCoordinate SavedAttributes::texture_at(const Origin& at) const {
  TextureCoordinate sum{0, 0};
  for (std::size_t i = 0; i < 3; ++i) {
    if (at.weights[i] == 0)
      continue;  // a corner without a coordinate (NaN) spoils only what it has a part in
    const TextureCoordinate& t = texture_[at.face.idx()][i];
    sum = {sum[0] + at.weights[i] * t[0], sum[1] + at.weights[i] * t[1]};
  }
  return sum;
}

void SavedAttributes::restore(Mesh& mesh, const std::function<Face(Face)>& parent,
                              const std::function<Origin(Vertex, Face)>& origin) const {
  const auto texture = find_map(mesh, attribute::texture);
  const auto group = find_map(mesh, attribute::group), material = find_map(mesh, attribute::material);
  const VertexBlend blend(mesh);
  if (texture)
    for (Halfedge h : mesh.halfedges()) (*texture)[h] = attribute::texture.default_value;
  for (Face f : mesh.faces()) {
    const Face from = parent(f);
    if (group) (*group)[f] = group_[from.idx()];
    if (material) (*material)[f] = material_[from.idx()];
    for (Halfedge h : mesh.halfedges_around_face(mesh.halfedge(f))) {
      const Vertex v = mesh.target(h);
      const Origin at = origin(v, from);
      if (texture) (*texture)[h] = texture_at(at);
      if (v.idx() >= old_vertices_) blend.set(v, corners_[at.face.idx()], at.weights);
    }
  }
}

void unset_rest_state(Mesh& mesh) {
  for (const auto* name : {&attribute::rest_length, &attribute::bending_rest_length, &attribute::rest_angle,
                           &attribute::stiffness, &attribute::bending_stiffness, &attribute::hinge_stiffness,
                           &attribute::tension})
    if (const auto map = find_map(mesh, *name))
      for (Edge e : mesh.edges()) (*map)[e] = name->default_value;
  if (const auto count = find_map(mesh, attribute::bending_count))
    for (Edge e : mesh.edges()) (*count)[e] = attribute::bending_count.default_value;
  if (const auto rest = find_map(mesh, attribute::triangle_rest_length))
    for (Halfedge h : mesh.halfedges()) (*rest)[h] = attribute::triangle_rest_length.default_value;
  set_struts(mesh, {});
  if (const auto mass = find_map(mesh, attribute::mass))
    for (Vertex v : mesh.vertices()) (*mass)[v] = attribute::mass.default_value;
}

}  // namespace furrow::geometry
