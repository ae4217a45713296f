// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/refine/refine_rest.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "geometry/mesh/edge_metric.h"

namespace furrow::geometry {
namespace {

using Place = std::array<double, 2>;

/// The corner of a face's halfedge that it comes from, and the one that it goes to, as Origin counts them.
std::array<std::size_t, 2> corners_of_side(const SavedAttributes& saved, Halfedge h) {
  const Mesh& before = saved.before();
  const Face f = before.face(h);
  return {saved.corner(f, before.source(h)), saved.corner(f, before.target(h))};
}

/// Rest lengths of all edges of a mesh, those in space where none is set.
class Unfolder {
 public:
  explicit Unfolder(const SavedAttributes& saved) : saved_(saved), lengths_(rest_lengths(saved.before())) {}

  /// Between two points of one old face [m].
  double within(const Origin& p, const Origin& q) const {
    const Halfedge side = saved_.before().halfedge(p.face);
    return apart(place(p, side), place(q, side));
  }

  /// Between points of two old faces that have a side in common [m]; NaN if they have none.
  double across(const Origin& p, const Origin& q) const {
    const Mesh& before = saved_.before();
    for (Halfedge h : before.halfedges_around_face(before.halfedge(p.face))) {
      const Halfedge o = before.opposite(h);
      if (before.face(o) != q.face) continue;
      const Place there = place(q, o);
      // the other triangle lies below the common side, which it runs along the other way
      return apart(place(p, h), {lengths_[before.edge(h).idx()] - there[0], -there[1]});
    }
    return unset_value;
  }

  double of(Edge old) const { return lengths_[old.idx()]; }

 private:
  static double apart(const Place& a, const Place& b) { return std::hypot(a[0] - b[0], a[1] - b[1]); }

  /// In the plane of its triangle, whose side h runs from (0, 0) to (length of h, 0).
  Place place(const Origin& at, Halfedge h) const {
    const Mesh& before = saved_.before();
    const double length = lengths_[before.edge(h).idx()],
                 from_b = lengths_[before.edge(before.next(h)).idx()],
                 from_a = lengths_[before.edge(before.prev(h)).idx()];
    const double x = length > 0 ? (length * length + from_a * from_a - from_b * from_b) / (2 * length) : 0;
    const double y = std::sqrt(std::max(0.0, from_a * from_a - x * x));
    const auto [a, b] = corners_of_side(saved_, h);
    const double apex = at.weights[3 - a - b];
    return {at.weights[b] * length + apex * x, apex * y};
  }

  const SavedAttributes& saved_;
  std::vector<double> lengths_;
};

bool any_set(const Mesh& mesh, const Map<Edge, double>& rest) {
  return std::any_of(mesh.edges().begin(), mesh.edges().end(), [&](Edge e) { return !std::isnan(rest[e]); });
}

/// Calls visit(new halfedge, old halfedge that it is parallel to) for the three sides of every new face.
template <class Visit>
void for_each_side(const SavedAttributes& saved, const Mesh& mesh, const std::function<Face(Face)>& parent,
                   const Visit& visit) {
  const Mesh& before = saved.before();
  const std::size_t old = before.number_of_vertices();
  const auto cut = [&](Vertex v) { return Edge(static_cast<Edge::size_type>(v.idx() - old)); };
  for (Face f : mesh.faces())
    for (Halfedge h : mesh.halfedges_around_face(mesh.halfedge(f))) {
      const Vertex a = mesh.source(h), b = mesh.target(h);
      for (Halfedge side : before.halfedges_around_face(before.halfedge(parent(f)))) {
        const Edge e = before.edge(side);
        const bool half = a.idx() < old ? cut(b) == e : b.idx() < old && cut(a) == e;
        // between two mid-points: parallel to the side that neither lies on
        if (half || (a.idx() >= old && b.idx() >= old && cut(a) != e && cut(b) != e)) visit(h, side);
      }
    }
}

}  // namespace

void refine_rest_of_quarters(const SavedAttributes& saved, Mesh& mesh,
                             const std::function<Face(Face)>& parent) {
  const auto rest_before = find_map(saved.before(), attribute::rest_length);
  const auto rest = find_map(mesh, attribute::rest_length);
  const auto own_before = find_map(saved.before(), attribute::triangle_rest_length);
  const auto own = find_map(mesh, attribute::triangle_rest_length);
  if (own)
    for (Halfedge h : mesh.halfedges()) (*own)[h] = unset_value;
  if (!rest && !own) return;
  for_each_side(saved, mesh, parent, [&](Halfedge h, Halfedge side) {
    if (rest) (*rest)[mesh.edge(h)] = (*rest_before)[saved.before().edge(side)] / 2;
    if (own) (*own)[h] = (*own_before)[side] / 2;
  });
}

void refine_rest_of_sqrt3(const SavedAttributes& saved, Mesh& mesh, std::span<const Origin> origins) {
  const Mesh& before = saved.before();
  if (const auto own = find_map(mesh, attribute::triangle_rest_length))
    for (Halfedge h : mesh.halfedges()) (*own)[h] = unset_value;
  const auto rest = find_map(mesh, attribute::rest_length);
  if (!rest || !any_set(before, *find_map(before, attribute::rest_length))) return;
  const Unfolder unfolder(saved);
  const std::size_t old = before.number_of_vertices();
  for (Edge e : mesh.edges()) {
    Vertex a = mesh.vertex(e, 0), b = mesh.vertex(e, 1);
    if (b < a) std::swap(a, b);  // an old one before a new one
    if (b.idx() < old) {         // a border that this step leaves
      (*rest)[e] = unfolder.of(before.edge(before.halfedge(a, b)));
      continue;
    }
    const Origin& to = origins[b.idx() - old];
    Origin from{to.face};
    if (a.idx() < old)
      from.weights.at(saved.corner(to.face, a)) = 1;
    else
      from = origins[a.idx() - old];
    (*rest)[e] = from.face == to.face ? unfolder.within(from, to) : unfolder.across(from, to);
  }
}

}  // namespace furrow::geometry
