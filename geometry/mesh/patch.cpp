// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/mesh/patch.h"

#include <algorithm>
#include <tuple>
#include <utility>

#include "geometry/mesh/attribute_register.h"
#include "geometry/mesh/vertex_attributes.h"

namespace furrow::geometry {
namespace {

/// Elements of one mesh, and what they are in the other.
using Correspondence =
    std::tuple<std::vector<std::pair<Vertex, Vertex>>, std::vector<std::pair<Edge, Edge>>,
               std::vector<std::pair<Halfedge, Halfedge>>, std::vector<std::pair<Face, Face>>>;

template <class Key>
auto& of(Correspondence& pairs) {
  return std::get<std::vector<std::pair<Key, Key>>>(pairs);
}

void copy_attributes(const Mesh& from, Mesh& to, Correspondence& pairs) {
  const auto copy = [&]<class A>(const A& attribute) {
    const auto source = find_map(from, attribute);
    if (!source) return;
    auto target = ensure_map(to, attribute);
    for (const auto& [a, b] : of<typename A::Key>(pairs)) target[b] = (*source)[a];
  };
  std::apply([&](const auto&... attribute) { (copy(attribute), ...); }, attribute_register);
  for (const VertexAttribute& source : vertex_attributes(from)) {
    VertexMap<double> target = ensure_vertex_attribute(to, source.name);
    for (const auto& [a, b] : of<Vertex>(pairs)) target[b] = source.values[a];
  }
  for (const auto& [a, b] : of<Vertex>(pairs)) to.point(b) = from.point(a);
}

template <class Key>
void sort_once(std::vector<Key>& list) {
  std::sort(list.begin(), list.end());
  list.erase(std::unique(list.begin(), list.end()), list.end());
}

template <class Key>
Key local(const std::vector<Key>& list, Key of) {
  return Key(
      static_cast<typename Key::size_type>(std::lower_bound(list.begin(), list.end(), of) - list.begin()));
}

/// The halfedge of an edge with the parity of another: that tells the sides of edges apart, for CGAL's
/// halfedge(e) may be either one.
Halfedge same_side(Halfedge h, Edge e) { return Halfedge(2 * e.idx() + h.idx() % 2); }

/// Whether beyond a halfedge at the border of the patch there is more of the whole.
bool is_rim(const Patch& patch, const Mesh& whole, Halfedge h) {
  const std::size_t e = patch.mesh.edge(h).idx();
  return patch.mesh.is_border(h) && e < patch.edges.size() && !whole.is_border(same_side(h, patch.edges[e]));
}

void add_edges(const Mesh& whole, Patch& patch) {
  for (Edge e : patch.edges) {
    const Halfedge h = patch.mesh.add_edge(), of = same_side(h, e);
    patch.mesh.set_target(h, local(patch.vertices, whole.target(of)));
    patch.mesh.set_target(patch.mesh.opposite(h), local(patch.vertices, whole.source(of)));
  }
}

/// Joins the halfedges without a face, and gives vertices at a border one of them.
void close_border(Mesh& mesh) {
  for (Halfedge h : mesh.halfedges()) {
    if (mesh.face(h).is_valid()) continue;
    Halfedge next = mesh.opposite(h);
    while (mesh.face(next).is_valid()) next = mesh.opposite(mesh.prev(next));
    mesh.set_next(h, next);
    mesh.set_halfedge(mesh.target(h), h);
  }
}

}  // namespace

std::vector<bool> Patch::rim(const Mesh& whole) const {
  std::vector<bool> result(mesh.num_vertices(), false);
  for (Halfedge h : mesh.halfedges())
    if (is_rim(*this, whole, h)) result[mesh.source(h).idx()] = result[mesh.target(h).idx()] = true;
  return result;
}

Patch cut_patch(const Mesh& whole, std::vector<Face> faces) {
  Patch patch{{}, {}, {}, std::move(faces)};
  for (Face f : patch.faces)
    for (Halfedge h : whole.halfedges_around_face(whole.halfedge(f))) {
      patch.vertices.push_back(whole.target(h));
      patch.edges.push_back(whole.edge(h));
    }
  sort_once(patch.vertices), sort_once(patch.edges);
  Mesh& mesh = patch.mesh;
  Correspondence pairs;
  for (Vertex v : patch.vertices) of<Vertex>(pairs).push_back({v, mesh.add_vertex()});
  add_edges(whole, patch);
  const auto side = [&](Halfedge h) { return same_side(h, local(patch.edges, whole.edge(h))); };
  for (Face f : patch.faces) {
    const Face to = mesh.add_face();
    of<Face>(pairs).push_back({f, to});
    mesh.set_halfedge(to, side(whole.halfedge(f)));
    for (Halfedge h : whole.halfedges_around_face(whole.halfedge(f))) {
      mesh.set_face(side(h), to);
      mesh.set_next(side(h), side(whole.next(h)));
    }
  }
  close_border(mesh);
  for (Vertex v : patch.vertices) {
    const Vertex to = local(patch.vertices, v);
    if (!std::binary_search(patch.edges.begin(), patch.edges.end(), whole.edge(whole.halfedge(v)))) continue;
    const Halfedge h = side(whole.halfedge(v));
    if (!mesh.halfedge(to).is_valid() || mesh.is_border(h)) mesh.set_halfedge(to, h);
  }
  for (Edge e : patch.edges)
    for (Halfedge h : {whole.halfedge(e), whole.opposite(whole.halfedge(e))})
      of<Halfedge>(pairs).push_back({h, side(h)});
  for (Edge e : patch.edges) of<Edge>(pairs).push_back({e, local(patch.edges, e)});
  copy_attributes(whole, mesh, pairs);
  return patch;
}

void put_back(const Patch& patch, Mesh& whole) {
  const Mesh& mesh = patch.mesh;
  std::vector<bool> outer;
  for (Halfedge h : mesh.halfedges()) outer.push_back(is_rim(patch, whole, h));
  const std::vector<bool> rim = patch.rim(whole);
  std::vector<Vertex> vertices = patch.vertices;
  std::vector<Edge> edges = patch.edges;
  std::vector<Face> faces = patch.faces;
  while (vertices.size() < mesh.num_vertices()) vertices.push_back(whole.add_vertex());
  while (edges.size() < mesh.num_edges()) edges.push_back(whole.edge(whole.add_edge()));
  while (faces.size() < mesh.num_faces()) faces.push_back(whole.add_face());
  const auto side = [&](Halfedge h) { return same_side(h, edges[mesh.edge(h).idx()]); };
  Correspondence pairs;
  for (Halfedge h : mesh.halfedges()) {
    if (outer[h.idx()]) continue;
    whole.set_target(side(h), vertices[mesh.target(h).idx()]);
    const bool border = mesh.is_border(h);
    whole.set_face(side(h), border ? Mesh::null_face() : faces[mesh.face(h).idx()]);
    if (!border || !outer[mesh.next(h).idx()]) whole.set_next(side(h), side(mesh.next(h)));
    if (!outer[mesh.opposite(h).idx()]) of<Halfedge>(pairs).push_back({h, side(h)});
  }
  for (Face f : mesh.faces()) {
    whole.set_halfedge(faces[f.idx()], side(mesh.halfedge(f)));
    of<Face>(pairs).push_back({f, faces[f.idx()]});
  }
  for (Vertex v : mesh.vertices()) {
    if (rim[v.idx()]) continue;
    whole.set_halfedge(vertices[v.idx()], side(mesh.halfedge(v)));
    of<Vertex>(pairs).push_back({v, vertices[v.idx()]});
  }
  for (Edge e : mesh.edges())
    if (!outer[mesh.halfedge(e, 0).idx()] && !outer[mesh.halfedge(e, 1).idx()])
      of<Edge>(pairs).push_back({e, edges[e.idx()]});
  copy_attributes(mesh, whole, pairs);
}

}  // namespace furrow::geometry
