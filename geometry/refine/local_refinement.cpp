// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/refine/local_refinement.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "geometry/mesh/add_all_faces.h"
#include "geometry/mesh/carry_attributes.h"
#include "geometry/mesh/edge_metric.h"
#include "geometry/refine/subdivide.h"
#include "physics/base/cancel_scope.h"

namespace furrow::geometry {
namespace {

constexpr const char* uniform_name = "v:uniform";
using VertexIndex = Vertex::size_type;

/// In the order of the weights of an Origin.
std::array<Vertex, 3> targets_of(const Mesh& mesh, Face f) {
  const Halfedge h = mesh.halfedge(f), next = mesh.next(h);
  return {mesh.target(h), mesh.target(next), mesh.target(mesh.next(next))};
}

/// The same vertices, without a face.
Mesh without_faces(const Mesh& mesh) {
  Mesh bare = mesh;
  for (const Face f : mesh.faces()) bare.remove_face(f);
  for (const Edge e : mesh.edges()) bare.remove_edge(e);
  for (const Vertex v : mesh.vertices()) bare.set_halfedge(v, Mesh::null_halfedge());
  bare.collect_garbage();
  return bare;
}

/// The length across a triangle at rest, from the corner of sides a and b to the middle of the side c; NaN if
/// one is not set.
double median_length(double a, double b, double c) {
  // m^2 = (2 a^2 + 2 b^2 - c^2) / 4
  const double four_squares = 2 * a * a + 2 * b * b - c * c;
  return four_squares < 0 ? 0 : std::sqrt(four_squares) / 2;
}

/// All that an edge is, from that of another mesh.
void take_edge(const Mesh& from, Halfedge of, const Mesh& mesh, Halfedge h) {
  AttributeMaps<Edge>(from, mesh).for_each([&](const auto& attribute, const auto& before, auto map) {
    if (attribute.carry.subdivision != CarryRule::unset) map[mesh.edge(h)] = before[from.edge(of)];
  });
}

}  // namespace

std::optional<VertexMap<int>> uniform_indices(const Mesh& mesh) {
  return find_map(mesh, PropertyName<Vertex, int>{uniform_name, -1});
}

void drop_uniform_indices(Mesh& mesh) {
  if (auto map = uniform_indices(mesh)) mesh.remove_property_map(*map);
}

LocalRefinement::LocalRefinement(const Mesh& mesh, int depth) {
  levels_.push_back(mesh);
  loop_subdivide(levels_[0], 0);
  levels_[0].collect_garbage();
  for (int level = 0; level < depth; ++level) {
    red_.emplace_back(levels_.back().number_of_faces(), 0);
    levels_.push_back(levels_.back());
    loop_subdivide(levels_.back(), 1);
  }
  list_parts();
}

std::array<std::size_t, 2> LocalRefinement::ends_of(std::size_t uniform) const {
  for (std::size_t level = levels_.size() - 1; level > 0; --level) {
    const Mesh& before = levels_[level - 1];
    const std::size_t old = before.number_of_vertices();
    if (uniform < old) continue;
    const Edge e(Edge::size_type(uniform - old));
    return {before.vertex(e, 0).idx(), before.vertex(e, 1).idx()};
  }
  return {uniform, uniform};
}

bool LocalRefinement::is_cut(int level, Edge e) const {
  if (level == depth()) return false;
  const Mesh& mesh = levels_[std::size_t(level)];
  for (const Halfedge h : {mesh.halfedge(e), mesh.opposite(mesh.halfedge(e))})
    if (!mesh.is_border(h) && is_red(level, mesh.face(h))) return true;
  return false;
}

/// Faces beside it that belong to a face which is whole, two cuts away, follow.
void LocalRefinement::cut(int level, Face f, std::size_t& count) {
  if (is_red(level, f)) return;
  red_[std::size_t(level)][f.idx()] = 1;
  ++count;
  if (level == 0) return;
  const Mesh& mesh = levels_[std::size_t(level)];
  const std::size_t above = levels_[std::size_t(level) - 1].number_of_faces();
  for (const Halfedge h : mesh.halfedges_around_face(mesh.halfedge(f)))
    if (const Halfedge o = mesh.opposite(h); !mesh.is_border(o))
      cut(level - 1, whole_of(mesh.face(o), above), count);
}

std::size_t LocalRefinement::refine(std::span<const Face> faces) {
  std::size_t count = 0;
  for (const Face f : faces)
    if (const Leaf& leaf = leaves_[source_[f.idx()].leaf]; leaf.level < depth())
      cut(leaf.level, leaf.face, count);
  for (std::size_t before = 0; before != count;) {  // a face whose three sides are cut is cut, too
    before = count;
    list_parts();
    for (const Leaf& leaf : leaves_) {
      const Mesh& mesh = levels_[std::size_t(leaf.level)];
      const auto sides = mesh.halfedges_around_face(mesh.halfedge(leaf.face));
      if (std::all_of(sides.begin(), sides.end(),
                      [&](Halfedge h) { return is_cut(leaf.level, mesh.edge(h)); }))
        cut(leaf.level, leaf.face, count);
    }
  }
  return count;
}

void LocalRefinement::visit(int level, Face f, Face old) {
  if (level == depth() || !is_red(level, f)) {
    leaves_.push_back({level, f, old});
    return;
  }
  for (const Face part : parts_of(f, on(level).number_of_faces())) visit(level + 1, part, old);
}

/// Two sides of a leaf are cut, at m from its second to its third corner and at n from there to its first.
void LocalRefinement::close_two(std::size_t leaf, const Triangle& c, std::size_t m, std::size_t n) {
  const auto apart = [&](std::size_t p, std::size_t q) {
    const Mesh& finest = levels_.back();
    return CGAL::squared_distance(finest.point(Vertex(VertexIndex(p))), finest.point(Vertex(VertexIndex(q))));
  };
  source_.push_back({leaf, {m, c[2], n}});
  const bool from_first = apart(c[0], m) <= apart(c[1], n);
  source_.push_back({leaf, {c[0], c[1], from_first ? m : n}});
  source_.push_back({leaf, from_first ? Triangle{c[0], m, n} : Triangle{c[1], m, n}});
}

/// Whole, in two or in three parts, as its neighbours ask.
void LocalRefinement::close(std::size_t index) {
  const Leaf& leaf = leaves_[index];
  const Mesh& mesh = on(leaf.level);
  const std::array<Vertex, 3> of = targets_of(mesh, leaf.face);
  const Halfedge first = mesh.halfedge(leaf.face);
  // side i runs from corner i to corner i + 1
  const std::array<Halfedge, 3> sides{mesh.next(first), mesh.next(mesh.next(first)), first};
  std::array<bool, 3> cuts{};
  for (std::size_t i = 0; i < 3; ++i) cuts[i] = is_cut(leaf.level, mesh.edge(sides[i]));
  const auto corner = [&](std::size_t i) { return std::size_t(of[i % 3].idx()); };
  const auto on_side = [&](std::size_t i) { return middle(leaf.level, mesh.edge(sides[i % 3])); };
  const auto count = std::count(cuts.begin(), cuts.end(), true);
  if (count == 0) return source_.push_back({index, {corner(0), corner(1), corner(2)}});
  const auto odd = std::size_t(std::find(cuts.begin(), cuts.end(), count == 1) - cuts.begin());
  if (count == 2)  // the odd side is whole
    return close_two(index, {corner(odd), corner(odd + 1), corner(odd + 2)}, on_side(odd + 1),
                     on_side(odd + 2));
  source_.push_back({index, {corner(odd), on_side(odd), corner(odd + 2)}});
  source_.push_back({index, {on_side(odd), corner(odd + 1), corner(odd + 2)}});
}

void LocalRefinement::list_parts() {
  physics::throw_if_cancelled("refine");
  leaves_.clear();
  source_.clear();
  for (const Face f : levels_[0].faces()) visit(0, f, f);
  for (std::size_t i = 0; i < leaves_.size(); ++i) close(i);
}

/// Vertices that are used, in their order, and the faces.
Mesh LocalRefinement::connect(const Mesh& places) const {
  const std::size_t old = levels_[0].number_of_vertices();
  std::vector<std::size_t> place(uniform_vertices(), 0);
  std::fill_n(place.begin(), old, 1);
  for (const Part& part : source_)
    for (const std::size_t v : part.corners) place[v] = 1;
  Mesh mesh = without_faces(levels_[0]);
  const VertexMap<int> uniform = mesh.add_property_map<Vertex, int>(uniform_name, -1).first;
  std::size_t count = 0;
  for (std::size_t v = 0; v < place.size(); ++v) {
    if (!place[v]) continue;
    const Vertex to = v < old ? Vertex(VertexIndex(v)) : mesh.add_vertex();
    mesh.point(to) = places.point(Vertex(VertexIndex(v)));
    uniform[to] = int(v);
    place[v] = count++;
  }
  std::vector<CornerIndices> triangles;
  for (const Part& part : source_)
    triangles.push_back({place[part.corners[0]], place[part.corners[1]], place[part.corners[2]]});
  if (!add_all_faces(std::span<const CornerIndices>(triangles), mesh))
    throw std::logic_error("refine: the faces of a refined mesh do not fit");
  return mesh;
}

/// The level, and the half-edge of it, that runs from a to b: a side of a leaf, or of a part that it would be
/// cut into. None: an edge that is there for the time being.
std::optional<std::pair<int, Halfedge>> LocalRefinement::find(int leaf_level, std::size_t a,
                                                              std::size_t b) const {
  for (int level = leaf_level; level <= std::min(leaf_level + 1, depth()); ++level) {
    const std::size_t count = on(level).number_of_vertices();
    if (a >= count || b >= count) continue;
    const Halfedge h = on(level).halfedge(Vertex(VertexIndex(a)), Vertex(VertexIndex(b)));
    if (h.is_valid()) return std::pair(level, h);
  }
  return std::nullopt;
}

/// Of the edge for the time being between a and b, one of which is a corner of the leaf. length(h): of a side
/// of the leaf [m].
template <class Length>
double LocalRefinement::median(const Leaf& leaf, std::size_t a, std::size_t b, const Length& length) const {
  const Mesh& mesh = on(leaf.level);
  for (const Halfedge h : mesh.halfedges_around_face(mesh.halfedge(leaf.face))) {
    const std::size_t middle_of_side = middle(leaf.level, mesh.edge(h));
    if (middle_of_side == a || middle_of_side == b)
      if (const std::size_t corner = mesh.target(mesh.next(h)).idx(); corner == a || corner == b)
        return median_length(length(mesh.next(h)), length(mesh.prev(h)), length(h));
  }
  throw std::logic_error("refine: an edge of a refined mesh is not known");
}

/// What edges are, and the lengths that triangles have of their own.
void LocalRefinement::take_edges(Mesh& mesh) const {
  const VertexMap<int> uniform = *uniform_indices(mesh);
  const auto rest = find_map(mesh, attribute::rest_length);
  const auto own = find_map(mesh, attribute::triangle_rest_length);
  for (const Face f : mesh.faces()) {
    const Leaf& leaf = leaves_[source_[f.idx()].leaf];
    const Mesh& level = on(leaf.level);
    for (const Halfedge h : mesh.halfedges_around_face(mesh.halfedge(f))) {
      const auto a = std::size_t(uniform[mesh.source(h)]), b = std::size_t(uniform[mesh.target(h)]);
      if (const auto found = find(leaf.level, a, b)) {
        const Mesh& of = on(found->first);
        take_edge(of, found->second, mesh, h);
        if (own) (*own)[h] = (*find_map(of, attribute::triangle_rest_length))[found->second];
        continue;
      }
      if (rest) {
        const auto set = *find_map(level, attribute::rest_length);
        (*rest)[mesh.edge(h)] = median(leaf, a, b, [&](Halfedge side) { return set[level.edge(side)]; });
      }
      if (own) {
        const auto set = *find_map(level, attribute::triangle_rest_length);
        (*own)[h] = median(leaf, a, b, [&](Halfedge side) { return set[side]; });
      }
    }
  }
}

/// In an old face that has the vertex, as an Origin has them.
std::array<double, 3> LocalRefinement::weights_in(Face old, std::size_t v) const {
  const std::array<Vertex, 3> corners = targets_of(levels_[0], old);
  std::array<double, 3> weights{};
  for (std::size_t i = 0; i < 3; ++i) weights[i] = corners[i].idx() == v ? 1 : 0;
  if (v < levels_[0].number_of_vertices()) return weights;
  for (const std::size_t end : ends_of(v)) {
    const std::array<double, 3> at = weights_in(old, end);
    for (std::size_t i = 0; i < 3; ++i) weights[i] += at[i] / 2;
  }
  return weights;
}

Mesh LocalRefinement::mesh(int steps) const {
  Mesh mesh = connect(on(steps));
  const SavedAttributes saved(levels_[0]);
  const VertexMap<int> uniform = *uniform_indices(mesh);
  const auto parent = [&](Face f) { return leaves_[source_[f.idx()].leaf].old; };
  const auto origin = [&](Vertex v, Face in) { return Origin{in, weights_in(in, std::size_t(uniform[v]))}; };
  saved.restore(mesh, parent, origin);
  if (const auto line = find_map(mesh, attribute::line)) {
    const auto of = *find_map(levels_.back(), attribute::line);
    for (const Vertex v : mesh.vertices()) (*line)[v] = of[Vertex(VertexIndex(uniform[v]))];
  }
  take_edges(mesh);
  return mesh;
}

}  // namespace furrow::geometry
