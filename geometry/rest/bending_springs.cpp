// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/rest/bending_springs.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <tuple>
#include <utility>

#include "geometry/mesh/errors.h"
#include "geometry/mesh/preconditions.h"
#include "geometry/mesh/property_names.h"

namespace furrow::geometry {
namespace {

using Pair = std::pair<Vertex, Vertex>;  // lower vertex first

Pair ordered(Vertex a, Vertex b) { return a < b ? Pair(a, b) : Pair(b, a); }
Vertex opposite_vertex(const Mesh& mesh, Halfedge h) { return mesh.target(mesh.next(h)); }
Pair opposite_pair(const Mesh& mesh, Edge e) {
  const Halfedge h = mesh.halfedge(e);
  return ordered(opposite_vertex(mesh, h), opposite_vertex(mesh, mesh.opposite(h)));
}
bool wants_spring(const Mesh& mesh, Edge e) {
  if (mesh.is_border(e)) return false;
  const auto [a, b] = opposite_pair(mesh, e);
  return a != b && !mesh.halfedge(a, b).is_valid();
}

/// An edge that wants a spring; sorted so that those that share one stand together, its holder first.
struct Candidate {
  Pair pair, ends;
  Edge edge;
  bool operator<(const Candidate& o) const {
    return std::tie(pair, ends, edge) < std::tie(o.pair, o.ends, o.edge);
  }
};

std::vector<Candidate> candidates(const Mesh& mesh, std::span<const Edge> edges) {
  std::vector<Candidate> result;
  for (Edge e : edges) {
    if (!wants_spring(mesh, e)) continue;
    result.push_back({opposite_pair(mesh, e), ordered(mesh.vertex(e, 0), mesh.vertex(e, 1)), e});
  }
  std::sort(result.begin(), result.end());
  return result;
}

/// A spring that there was before, and stays.
struct Known {
  Pair pair;
  double rest_length, stiffness;
  int count;
};

/// Gives each pair's spring to its first candidate; what is `known` (sorted by pair) goes before the
/// distance. A stiffness stays if as many edges share the spring as before.
void hand_out(Mesh& mesh, std::span<const Candidate> sorted, std::span<const Known> all_known) {
  auto rest = ensure_map(mesh, attribute::bending_rest_length);
  auto count = ensure_map(mesh, attribute::bending_count);
  const auto stiffness = find_map(mesh, attribute::bending_stiffness);
  for (std::size_t i = 0, next = 0; i < sorted.size(); i = next) {
    while (next < sorted.size() && sorted[next].pair == sorted[i].pair) ++next;
    const Pair& pair = sorted[i].pair;
    const auto known = std::lower_bound(all_known.begin(), all_known.end(), pair,
                                        [](const Known& k, const Pair& p) { return k.pair < p; });
    const bool is_known = known != all_known.end() && known->pair == pair;
    rest[sorted[i].edge] =
        is_known ? known->rest_length
                 : std::sqrt(CGAL::squared_distance(mesh.point(pair.first), mesh.point(pair.second)));
    count[sorted[i].edge] = static_cast<int>(next - i);
    if (stiffness && is_known && known->count == count[sorted[i].edge])
      (*stiffness)[sorted[i].edge] = known->stiffness;
  }
}

void clear(Mesh& mesh, std::span<const Edge> edges) {
  auto rest = ensure_map(mesh, attribute::bending_rest_length);
  auto count = ensure_map(mesh, attribute::bending_count);
  const auto stiffness = find_map(mesh, attribute::bending_stiffness);
  for (Edge e : edges) {
    rest[e] = unset_value, count[e] = 0;
    if (stiffness) (*stiffness)[e] = unset_value;
  }
}

/// Edges of all faces that touch a corner of `changed`, each once: whatever pair of vertices lost or gained
/// an edge or a hinge, one of the two is such a corner, so every hinge opposite that pair lies in these
/// faces.
std::vector<Edge> edges_around(const Mesh& mesh, std::span<const Face> changed) {
  std::vector<Edge> edges;
  for (Face f : changed)
    for (Halfedge corner : mesh.halfedges_around_face(mesh.halfedge(f)))
      for (Halfedge h : mesh.halfedges_around_target(corner)) {
        edges.push_back(mesh.edge(h));
        if (!mesh.is_border(h)) edges.push_back(mesh.edge(mesh.prev(h)));
      }
  std::sort(edges.begin(), edges.end());
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  return edges;
}

/// The springs across edges whose two faces did not change: their pairs are what they were.
std::vector<Known> known_springs(const Mesh& mesh, std::span<const Edge> edges,
                                 std::span<const Face> changed) {
  std::vector<Known> known;
  const auto rest = find_map(mesh, attribute::bending_rest_length),
             stiffness = find_map(mesh, attribute::bending_stiffness);
  const auto count = find_map(mesh, attribute::bending_count);
  if (!rest) return known;
  std::vector<Face> sorted(changed.begin(), changed.end());
  std::sort(sorted.begin(), sorted.end());
  const auto is_changed = [&](Halfedge h) {
    return std::binary_search(sorted.begin(), sorted.end(), mesh.face(h));
  };
  for (Edge e : edges) {
    const Halfedge h = mesh.halfedge(e);
    if (mesh.is_border(e) || std::isnan((*rest)[e]) || is_changed(h) || is_changed(mesh.opposite(h)))
      continue;
    known.push_back({opposite_pair(mesh, e), (*rest)[e], stiffness ? (*stiffness)[e] : unset_value,
                     count ? (*count)[e] : 0});
  }
  std::sort(known.begin(), known.end(), [](const Known& k, const Known& l) {
    return std::tie(k.pair, k.rest_length) < std::tie(l.pair, l.rest_length);
  });
  return known;
}

using PerEdge = PropertyName<Edge, double>;

/// By edge index; empty where the mesh has no such map.
std::vector<double> values_of(const Mesh& mesh, const PerEdge& name) {
  std::vector<double> values;
  if (const auto map = find_map(mesh, name)) {
    values.assign(mesh.num_edges(), unset_value);
    for (Edge e : mesh.edges()) values[e.idx()] = (*map)[e];
  }
  return values;
}

/// Gives each spring's holder what was stated on the first of the edges that share it.
void take_stated(Mesh& mesh, std::span<const Candidate> sorted, const std::vector<double>& stated,
                 const PerEdge& name) {
  if (stated.empty()) return;
  auto map = ensure_map(mesh, name);
  Edge holder;
  bool taken = false;
  for (std::size_t i = 0; i < sorted.size(); ++i) {
    if (i == 0 || sorted[i].pair != sorted[i - 1].pair) holder = sorted[i].edge, taken = false;
    const double value = stated[sorted[i].edge.idx()];
    if (taken || std::isnan(value)) continue;
    map[holder] = value;
    taken = true;
  }
}

}  // namespace

void rebuild_bending_springs(Mesh& mesh) {
  require_triangles(mesh, "rebuild_bending_springs");
  const std::vector<Edge> edges(mesh.edges().begin(), mesh.edges().end());
  const std::vector<Candidate> all = candidates(mesh, edges);
  clear(mesh, edges);
  hand_out(mesh, all, {});
}

void rebuild_bending_springs(Mesh& mesh, std::span<const Face> changed) {
  for (Face f : changed) {
    if (f.is_valid() && f.idx() < mesh.num_faces() && !mesh.is_removed(f)) continue;
    refuse("rebuild_bending_springs", "the mesh has no face " + std::to_string(f.idx()));
  }
  const std::vector<Edge> edges = edges_around(mesh, changed);
  for (Edge e : edges)
    for (Halfedge h : {mesh.halfedge(e), mesh.opposite(mesh.halfedge(e))})
      if (!mesh.is_border(h) && mesh.next(mesh.next(mesh.next(h))) != h)
        throw ContentError("rebuild_bending_springs: face " + std::to_string(mesh.face(h).idx()) +
                           " is no triangle; triangulate the mesh first");
  const auto known = known_springs(mesh, edges, changed);
  const std::vector<Candidate> around = candidates(mesh, edges);
  // A pair with neither vertex at `changed` may be seen here in part only, and did not change: leave it
  // alone.
  std::vector<char> at_changed(mesh.num_vertices(), 0);
  for (Face f : changed)
    for (Vertex v : mesh.vertices_around_face(mesh.halfedge(f))) at_changed[v.idx()] = 1;
  const auto concerned = [&](const Pair& p) {
    return at_changed[p.first.idx()] || at_changed[p.second.idx()];
  };
  std::vector<Candidate> kept;
  for (const Candidate& c : around)
    if (concerned(c.pair)) kept.push_back(c);
  std::vector<Edge> to_clear;
  for (Edge e : edges)
    if (mesh.is_border(e) || concerned(opposite_pair(mesh, e))) to_clear.push_back(e);
  clear(mesh, to_clear);
  hand_out(mesh, kept, known);
}

std::vector<BendingSpring> bending_springs(const Mesh& mesh) {
  std::vector<BendingSpring> springs;
  const auto rest = find_map(mesh, attribute::bending_rest_length);
  const auto count = find_map(mesh, attribute::bending_count);
  if (!rest || !count) return springs;
  for (Edge e : mesh.edges()) {
    if ((*count)[e] <= 0 || mesh.is_border(e)) continue;
    const auto [a, b] = opposite_pair(mesh, e);
    springs.push_back({a, b, e, (*rest)[e], (*count)[e]});
  }
  std::sort(springs.begin(), springs.end(),
            [](const auto& s, const auto& t) { return std::tie(s.a, s.b) < std::tie(t.a, t.b); });
  return springs;
}

std::size_t count_bending_springs(const Mesh& mesh) {
  const auto count = find_map(mesh, attribute::bending_count);
  if (!count || !find_map(mesh, attribute::bending_rest_length)) return 0;
  const auto holds = [&](Edge e) { return (*count)[e] > 0 && !mesh.is_border(e); };
  return static_cast<std::size_t>(std::count_if(mesh.edges_begin(), mesh.edges_end(), holds));
}

void ensure_bending_springs(Mesh& mesh) {
  const bool known =
      find_map(mesh, attribute::bending_rest_length) && find_map(mesh, attribute::bending_count);
  if (known && count_bending_springs(mesh) > 0) return;
  const auto rest = values_of(mesh, attribute::bending_rest_length),
             stiffness = values_of(mesh, attribute::bending_stiffness);
  rebuild_bending_springs(mesh);
  const std::vector<Edge> edges(mesh.edges().begin(), mesh.edges().end());
  const std::vector<Candidate> all = candidates(mesh, edges);
  take_stated(mesh, all, rest, attribute::bending_rest_length);
  take_stated(mesh, all, stiffness, attribute::bending_stiffness);
}

}  // namespace furrow::geometry
