// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/band/band_mesh.h"

#include <algorithm>
#include <cmath>
#include <deque>
#include <limits>
#include <numbers>

#include "geometry/insert/flip_rules.h"
#include "geometry/mesh/carry_attributes.h"
#include "physics/base/cancel_scope.h"

namespace furrow::geometry {
namespace {

constexpr double near_chord = 0.2;  ///< of an edge: a new vertex on a chain goes onto the curve within this
constexpr double astray = 0.05;     ///< of an edge: a place on the base that is farther off is not its own
constexpr double tie = 1e-7;        ///< four points on a circle: either diagonal is Delaunay
const double steepest_flip = std::cos(40 * std::numbers::pi / 180);  ///< between the two faces

Vector normal_of(const Point& a, const Point& b, const Point& c) { return CGAL::cross_product(b - a, c - a); }

}  // namespace

BandMesh::BandMesh(Mesh& refined, const Mesh& given)
    : mesh(refined),
      editor(refined),
      rest(ensure_rest_lengths(refined)),
      base(given),
      old_vertices(given.num_vertices()),
      place(refined.num_vertices()),
      hold(refined.num_vertices(), Hold::free),
      moved(refined.num_vertices(), false),
      on_seam(refined.num_vertices(), false),
      on(refined.num_vertices()),
      in_band(refined.num_faces(), false) {
  for (Edge e : mesh.edges()) {
    const bool seam = !mesh.is_border(e) && editor.is_seam(e), fixed = seam || editor.line_edge()[e];
    for (int end : {0, 1}) {
      const Vertex v = mesh.vertex(e, end);
      if (fixed) hold[v.idx()] = Hold::fixed;
      if (mesh.is_border(e) && hold[v.idx()] == Hold::free) hold[v.idx()] = Hold::border;
      if (seam) on_seam[v.idx()] = true;
    }
  }
  for (Vertex v : mesh.vertices())
    if (!mesh.is_isolated(v) && v.idx() < base.mesh().num_vertices()) place[v.idx()] = base.of_vertex(v);
}

std::vector<Vertex> BandMesh::vertices() const {
  std::vector<bool> seen(mesh.num_vertices(), false);
  for (Face f : mesh.faces())
    if (in_band[f.idx()])
      for (Vertex v : corners_of(mesh, f)) seen[v.idx()] = true;
  std::vector<Vertex> result;
  for (Vertex v : mesh.vertices())
    if (seen[v.idx()]) result.push_back(v);
  return result;
}

Halfedge BandMesh::from_lower(Edge e) const {
  const Halfedge h = mesh.halfedge(e);
  return mesh.source(h) < mesh.target(h) ? h : mesh.opposite(h);
}

bool BandMesh::touches_band(Edge e) const {
  for (Halfedge h : {mesh.halfedge(e), mesh.opposite(mesh.halfedge(e))})
    if (!mesh.is_border(h) && in_band[mesh.face(h).idx()]) return true;
  return false;
}

bool BandMesh::is_locked(Edge e) const {
  if (mesh.is_border(e) || editor.line_edge()[e]) return true;
  return on_seam[mesh.vertex(e, 0).idx()] && on_seam[mesh.vertex(e, 1).idx()] && editor.is_seam(e);
}

double BandMesh::mean_edge(Vertex v) const {
  double sum = 0;
  int count = 0;
  for (Halfedge h : mesh.halfedges_around_target(mesh.halfedge(v))) sum += rest[mesh.edge(h)], ++count;
  return sum / count;
}

/// The place on the base of a point of an edge: the nearest that walks from the vertices around lead to. One
/// walk alone may end at the border or at a seam before it is there, and a vertex on a seam does not know its
/// side: then walks from all faces around are asked.
FacePoint BandMesh::place_on(Halfedge h, const Point& p) const {
  const Halfedge o = mesh.opposite(h);
  std::vector<Vertex> near{mesh.source(h), mesh.target(h)};
  for (Halfedge side : {h, o})
    if (!mesh.is_border(side)) near.push_back(mesh.target(mesh.next(side)));
  FacePoint best;
  double least = std::numeric_limits<double>::infinity();
  const auto ask = [&](const FacePoint& from) {
    const FacePoint at = base.project(from, p);
    const double d = (base.position(at) - p).squared_length();
    if (d < least) least = d, best = at;
  };
  const double length = (mesh.point(near[1]) - mesh.point(near[0])).squared_length();
  for (Vertex v : near)
    if (!on_seam[v.idx()] && !(least <= 1e-12 * length)) ask(place[v.idx()]);
  if (least <= astray * astray * length) return best;
  for (Vertex v : near)
    for (Vertex c : corners_of(base.mesh(), place[v.idx()].face))
      for (Face f : base.mesh().faces_around_target(base.mesh().halfedge(c)))
        if (f.is_valid()) ask({f, {1, 0, 0}});
  return best;
}

void BandMesh::grow(Vertex v, Hold as, Face left, Face right) {
  const bool inside = (left.is_valid() && in_band[left.idx()]) || (right.is_valid() && in_band[right.idx()]);
  place.resize(mesh.num_vertices());
  hold.resize(mesh.num_vertices(), Hold::free);
  moved.resize(mesh.num_vertices(), false);
  on_seam.resize(mesh.num_vertices(), false);
  on.resize(mesh.num_vertices());
  in_band.resize(mesh.num_faces(), inside);
  for (Face f : {left, right})
    if (f.is_valid()) in_band[f.idx()] = inside;
  hold[v.idx()] = as;
}

Vertex BandMesh::split(Edge e, double t) {
  Halfedge h = from_lower(e);
  const Vertex a = mesh.source(h), b = mesh.target(h);
  const bool border = mesh.is_border(e), seam = !border && editor.is_seam(e);
  const Point chord = mesh.point(a) + t * (mesh.point(b) - mesh.point(a));
  const FacePoint at = place_on(h, chord);
  const std::vector<CurveEdge> chains = curves_of(a, b);
  const bool earlier = editor.line_edge()[e] && chains.empty();
  const Face left = mesh.face(h), right = mesh.face(mesh.opposite(h));
  const bool turned = mesh.is_border(h);
  const Vertex v = turned ? editor.split_edge(mesh.opposite(h), 1 - t) : editor.split_edge(h, t);
  grow(v, seam || earlier ? Hold::fixed : border ? Hold::border : Hold::free, left, right);
  on_seam[v.idx()] = seam;
  place[v.idx()] = at;
  mesh.point(v) = base.position(at);
  ++splits;
  if (earlier) {
    editor.line()[v] = std::max(editor.line()[a], editor.line()[b]);
    cut_lines.push_back({a, b, v});
  }
  for (const CurveEdge& c : chains) join_curve(v, c, t);
  return v;
}

void BandMesh::join_curve(Vertex v, const CurveEdge& c, double t) {
  const BandCurve& curve = curves[c.curve];
  const double way = c.ahead ? curve.ahead(c.from, c.to) : curve.ahead(c.to, c.from);
  const double along = curve.wrapped(c.ahead ? c.from + t * way : c.to + (1 - t) * way);
  put_on(v, c.curve, along);
  editor.line()[v] = curve.line();
  const Point p = curve.at(along);
  if (hold[v.idx()] != Hold::free || (p - mesh.point(v)).squared_length() > std::pow(near_chord * way, 2))
    return;
  const Star star = lay_flat(mesh, rest, v);
  const StarPoint at = find_in_star(mesh, star, p);
  if (*std::min_element(at.weights.begin(), at.weights.end()) > -near_chord)
    move(star, place_in(star, at), 0.05, &p);
}

bool BandMesh::turns_over(const Star& star, const Point& p) const {
  const Point& from = mesh.point(star.centre);
  for (std::size_t i = 0; i < star.faces(); ++i) {
    const Point &a = mesh.point(mesh.target(star.spokes[i])),
                &b = mesh.point(mesh.target(star.spokes[star.after(i)]));
    if (!(normal_of(from, a, b) * normal_of(p, a, b) > 0)) return true;
  }
  return false;
}

void BandMesh::settle(Vertex v, const Point& p, const FacePoint& at, const Star& star,
                      const std::vector<double>& lengths) {
  mesh.point(v) = p;
  place[v.idx()] = at;
  moved[v.idx()] = true;
  for (std::size_t i = 0; i < lengths.size(); ++i) rest[mesh.edge(star.spokes[i])] = lengths[i];
  if (!on_seam[v.idx()]) editor.set_texture(v, base.texture(at));
}

bool BandMesh::move(const Star& star, const Place2& x, double least, const Point* p) {
  const Vertex v = star.centre;
  if (!(least_quality(star, x) >= least)) return false;
  const Point wanted = p ? *p : position_in(mesh, star, find_in_star(star, x));
  const FacePoint at = base.project(place[v.idx()], wanted);
  const Point target = p ? *p : base.position(at);
  if ((target - wanted).squared_length() > std::pow(near_chord * mean_edge(v), 2))
    return false;  // went astray
  if (turns_over(star, target)) return false;
  std::vector<double> lengths;
  for (const Place2& end : star.ends) lengths.push_back(std::hypot(end[0] - x[0], end[1] - x[1]));
  settle(v, target, at, star, lengths);
  return true;
}

bool BandMesh::move_in_space(const Star& star, const Point& p, double least) {
  const Vertex v = star.centre;
  std::vector<double> lengths;
  for (Halfedge h : star.spokes) {
    const Point& end = mesh.point(mesh.target(h));
    const double now = std::sqrt((end - mesh.point(v)).squared_length());
    lengths.push_back(rest[mesh.edge(h)] / now * std::sqrt((end - p).squared_length()));
  }
  for (std::size_t i = 0; i < star.faces(); ++i) {
    const double a = lengths[i], b = lengths[star.after(i)], c = rest[mesh.edge(mesh.next(star.spokes[i]))];
    const double area = triangle_area({a, b, c});
    if (!(4 * std::numbers::sqrt3 * area >= least * (a * a + b * b + c * c))) return false;
  }
  if (turns_over(star, p)) return false;
  settle(v, p, base.project(place[v.idx()], p), star, lengths);
  return true;
}

/// Whether the rules allow it, and the faces in space neither turn over nor meet at a sharp edge.
bool BandMesh::may_be_flipped(Edge e, const std::function<const Point&(Vertex)>& at) const {
  if (refusal_of_flip(editor, e, flip_options)) return false;
  const Halfedge h = from_lower(e), o = mesh.opposite(h);
  const Point &a = at(mesh.source(h)), &b = at(mesh.target(h)), &c = at(mesh.target(mesh.next(h))),
              &d = at(mesh.target(mesh.next(o)));
  const Vector left = normal_of(a, b, c), right = normal_of(b, a, d), sum = left + right;
  const double lengths = std::sqrt(left.squared_length() * right.squared_length());
  if (left * right < steepest_flip * lengths) return false;
  return normal_of(a, d, c) * sum > 0 && normal_of(d, b, c) * sum > 0;
}

std::size_t BandMesh::flip_to_delaunay() {
  const auto shape = [&](Vertex v) -> const Point& { return mesh.point(v); };
  std::vector<bool> waiting(mesh.num_edges(), false);
  std::deque<Edge> queue;
  const auto enqueue = [&](Edge e) {
    if (waiting[e.idx()] || mesh.is_border(e)) return;
    if (!in_band[mesh.face(mesh.halfedge(e, 0)).idx()] || !in_band[mesh.face(mesh.halfedge(e, 1)).idx()])
      return;
    if (!(cotangent_sum(mesh, rest, e) < -tie)) return;
    waiting[e.idx()] = true;
    queue.push_back(e);
  };
  std::vector<std::pair<Vertex, Edge>> higher;
  for (Vertex v : vertices()) {
    physics::throw_if_cancelled("wrinkle");
    higher.clear();
    for (Halfedge h : mesh.halfedges_around_target(mesh.halfedge(v)))
      if (mesh.source(h) > v) higher.push_back({mesh.source(h), mesh.edge(h)});
    std::sort(higher.begin(), higher.end());
    for (const auto& [w, e] : higher) enqueue(e);
  }
  std::size_t count = 0;
  // Flips end in exact arithmetic; the limit guards against rounding.
  const std::size_t limit = 100 * queue.size() + 100;
  for (; !queue.empty() && count < limit; queue.pop_front()) {
    physics::throw_if_cancelled("wrinkle");
    const Edge e = queue.front();
    waiting[e.idx()] = false;
    if (!(cotangent_sum(mesh, rest, e) < -tie) || !may_be_flipped(e, shape)) continue;
    editor.flip_edge(e);
    ++count;
    const Halfedge h = from_lower(e), o = mesh.opposite(h);
    for (Halfedge side : {mesh.next(h), mesh.prev(h), mesh.next(o), mesh.prev(o)}) enqueue(mesh.edge(side));
  }
  flips += count;
  return count;
}

void BandMesh::put_on(Vertex v, int curve, double along) {
  curves[curve].vertices[along] = v;
  on[v.idx()].push_back({curve, along});
}

void BandMesh::take_off(Vertex v, int curve) {
  std::erase_if(on[v.idx()], [&](const OnCurve& at) {
    if (at.curve != curve) return false;
    curves[curve].vertices.erase(at.along);
    return true;
  });
}

double BandMesh::along(Vertex v, int curve) const {
  for (const OnCurve& at : on[v.idx()])
    if (at.curve == curve) return at.along;
  return -1;
}

std::vector<BandMesh::CurveEdge> BandMesh::curves_of(Vertex a, Vertex b) const {
  std::vector<CurveEdge> result;
  for (const OnCurve& at : on[a.idx()]) {
    const double to = along(b, at.curve);
    if (to < 0) continue;
    if (next_on(at.curve, at.along) == b)
      result.push_back({at.curve, at.along, to, true});
    else if (next_on(at.curve, to) == a)
      result.push_back({at.curve, at.along, to, false});
  }
  return result;
}

Vertex BandMesh::next_on(int curve, double along) const {
  const auto& vertices = curves[curve].vertices;
  const auto next = vertices.upper_bound(along);
  if (next != vertices.end()) return next->second;
  return curves[curve].closed() && !vertices.empty() ? vertices.begin()->second : Vertex();
}

Vertex BandMesh::previous_on(int curve, double along) const {
  const auto& vertices = curves[curve].vertices;
  const auto at = vertices.lower_bound(along);
  if (at != vertices.begin()) return std::prev(at)->second;
  return curves[curve].closed() && !vertices.empty() ? std::prev(vertices.end())->second : Vertex();
}

void BandMesh::finish() {
  const VertexBlend blend(base.mesh(), mesh, &Carry::insertion);
  for (Vertex v : mesh.vertices()) {
    physics::throw_if_cancelled("wrinkle");
    if (is_old(v) && !moved[v.idx()]) continue;
    blend.set(v, corners_of(base.mesh(), place[v.idx()].face), place[v.idx()].barycentrics);
    if (moved[v.idx()]) editor.note_moved(v);
  }
}

}  // namespace furrow::geometry
