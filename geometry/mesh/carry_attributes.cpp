// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/mesh/carry_attributes.h"

#include <algorithm>

#include "geometry/mesh/struts.h"
#include "physics/base/cancel_scope.h"

namespace furrow::geometry {
namespace {

template <std::size_t n>
void add(std::array<double, n>& sum, double weight, const std::array<double, n>& value) {
  for (std::size_t k = 0; k < n; ++k) sum[k] += weight * value[k];
}
void add(Vector& sum, double weight, const Vector& value) { sum += weight * value; }
void add(double& sum, double weight, double value) { sum += weight * value; }

template <class Value>
concept Blendable = requires(Value sum) {
  add(sum, 0.0, sum);
};

/// The weighted sum of the values of three keys. One of weight 0 is left out: an unset value (NaN) spoils
/// only what it has a part in.
template <class Map, class Keys>
auto weighted(const Map& map, const Keys& keys, const std::array<double, 3>& weights) {
  auto sum = typename Map::value_type{};
  if constexpr (std::is_same_v<typename Map::value_type, Vector>) sum = Vector(0, 0, 0);
  for (int i = 0; i < 3; ++i)
    if (weights[i] != 0) add(sum, weights[i], map[keys[i]]);
  return sum;
}

template <class Key, class Value>
void set_all(const Mesh& mesh, Map<Key, Value> map, const Value& value) {
  if constexpr (std::is_same_v<Key, Vertex>)
    for (Vertex v : mesh.vertices()) map[v] = value;
  else if constexpr (std::is_same_v<Key, Edge>)
    for (Edge e : mesh.edges()) map[e] = value;
  else if constexpr (std::is_same_v<Key, Halfedge>)
    for (Halfedge h : mesh.halfedges()) map[h] = value;
  else
    for (Face f : mesh.faces()) map[f] = value;
}

}  // namespace

VertexBlend::VertexBlend(const Mesh& before, const Mesh& mesh, CarryRule Carry::*rule)
    : registered_(before, mesh),
      rule_(rule),
      others_before_(vertex_attributes(before)),
      others_(vertex_attributes(mesh)) {}

void VertexBlend::set(Vertex to, const std::array<Vertex, 3>& from, const Barycentrics& weights) const {
  registered_.for_each([&](const auto& attribute, const auto& before, auto map) {
    if constexpr (Blendable<typename decltype(map)::value_type>)
      if (attribute.carry.*rule_ == CarryRule::blend) map[to] = weighted(before, from, weights);
  });
  for (std::size_t i = 0; i < others_.size(); ++i) {
    VertexMap<double> map = others_[i].values;
    map[to] = weighted(others_before_[i].values, from, weights);
  }
}

EditedAttributes::EditedAttributes(const Mesh& mesh)
    : mesh_(mesh), vertices_(mesh, &Carry::insertion), faces_(mesh), edges_(mesh), halfedges_(mesh) {}

void EditedAttributes::copy(Face whole, Face part) const {
  faces_.for_each([&](const auto& attribute, const auto&, auto map) {
    if (attribute.carry.insertion == CarryRule::copy) map[part] = map[whole];
  });
}

void EditedAttributes::halve(Edge edge, Edge half) const {
  edges_.for_each([&](const auto& attribute, const auto&, auto map) {
    const CarryRule rule = attribute.carry.insertion;
    if (rule == CarryRule::halves) map[half] = map[edge];
    if (rule == CarryRule::fresh || rule == CarryRule::unset) map[edge] = map[half] = attribute.default_value;
  });
}

void EditedAttributes::flip(Edge edge) const {
  edges_.for_each([&](const auto& attribute, const auto&, auto map) {
    if (attribute.carry.insertion != CarryRule::computed) map[edge] = attribute.default_value;
  });
}

void EditedAttributes::change(Edge edge) const {
  edges_.for_each([&](const auto& attribute, const auto&, auto map) {
    if (attribute.carry.insertion == CarryRule::unset) map[edge] = attribute.default_value;
  });
}

void EditedAttributes::change(Face face) const {
  halfedges_.for_each([&](const auto& attribute, const auto&, auto map) {
    if (attribute.carry.insertion != CarryRule::unset) return;
    for (Halfedge h : halfedges_of(mesh_, face)) map[h] = attribute.default_value;
  });
}

SavedAttributes::SavedAttributes(const Mesh& mesh) : before_(mesh) {
  for (Face f : mesh.faces()) {
    const Halfedge h = mesh.halfedge(f), next = mesh.next(h);
    corners_.push_back({mesh.target(h), mesh.target(next), mesh.target(mesh.next(next))});
  }
}

std::size_t SavedAttributes::corner(Face face, Vertex v) const {
  const auto& c = corners_[face.idx()];
  return static_cast<std::size_t>(std::find(c.begin(), c.end(), v) - c.begin());
}

void SavedAttributes::restore_vertices(Mesh& mesh) const {
  AttributeMaps<Vertex>(mesh).for_each([&](const auto& attribute, const auto&, auto map) {
    if (attribute.carry.subdivision == CarryRule::unset) set_all(mesh, map, attribute.default_value);
  });
  set_struts(mesh, {});
}

void SavedAttributes::restore_faces(Mesh& mesh, const std::function<Face(Face)>& parent) const {
  AttributeMaps<Face>(before_, mesh).for_each([&](const auto& attribute, const auto& before, auto map) {
    if (attribute.carry.subdivision == CarryRule::unset) set_all(mesh, map, attribute.default_value);
    if (attribute.carry.subdivision != CarryRule::copy) return;
    for (Face f : mesh.faces()) map[f] = before[parent(f)];
  });
}

void SavedAttributes::restore_corners(Mesh& mesh, const std::function<Face(Face)>& parent,
                                      const std::function<Origin(Vertex, Face)>& origin) const {
  const VertexBlend blend(mesh, &Carry::subdivision);
  const AttributeMaps<Halfedge> maps(before_, mesh);
  maps.for_each([&](const auto& attribute, const auto&, auto map) {
    if (attribute.carry.subdivision != CarryRule::computed) set_all(mesh, map, attribute.default_value);
  });
  for (Face f : mesh.faces()) {
    physics::throw_if_cancelled("subdivide");
    const Face from = parent(f);
    for (Halfedge h : mesh.halfedges_around_face(mesh.halfedge(f))) {
      const Vertex v = mesh.target(h);
      const Origin at = origin(v, from);
      maps.for_each([&](const auto& attribute, const auto& before, auto map) {
        if constexpr (Blendable<typename decltype(map)::value_type>)
          if (attribute.carry.subdivision == CarryRule::blend)
            map[h] = weighted(before, halfedges_of(before_, at.face), at.weights);
      });
      if (v.idx() >= before_.number_of_vertices()) blend.set(v, corners_[at.face.idx()], at.weights);
    }
  }
}

void SavedAttributes::restore(Mesh& mesh, const std::function<Face(Face)>& parent,
                              const std::function<Origin(Vertex, Face)>& origin) const {
  restore_vertices(mesh);
  restore_faces(mesh, parent);
  restore_corners(mesh, parent, origin);
  AttributeMaps<Edge>(mesh).for_each(
      [&](const auto& attribute, const auto&, auto map) { set_all(mesh, map, attribute.default_value); });
}

void SavedAttributes::restore_halves(Mesh& mesh) const {
  AttributeMaps<Edge>(before_, mesh).for_each([&](const auto& attribute, const auto& before, auto map) {
    if (attribute.carry.subdivision != CarryRule::halves) return;
    for (Edge e : before_.edges()) {
      if (before[e] == attribute.default_value) continue;
      const Vertex middle(static_cast<Vertex::size_type>(before_.number_of_vertices() + e.idx()));
      for (int end : {0, 1}) map[mesh.edge(mesh.halfedge(before_.vertex(e, end), middle))] = before[e];
    }
  });
}

}  // namespace furrow::geometry
