// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/band/refine_displaced.h"

#include <algorithm>
#include <cmath>
#include <deque>
#include <numbers>
#include <set>

#include "geometry/band/band_mesh.h"
#include "geometry/band/band_report.h"
#include "geometry/band/curve_arcs.h"
#include "geometry/band/relax_band.h"
#include "geometry/band/split_longest.h"
#include "geometry/band/tighten_displaced.h"
#include "geometry/mesh/errors.h"
#include "geometry/mesh/preconditions.h"
#include "physics/base/cancel_scope.h"

namespace furrow::geometry {
namespace {

constexpr double too_stretched = 1.5;  ///< of the sizing, in the displaced shape
constexpr double least_share = 0.2;    ///< of the sizing, undisplaced: what is shorter spans a jump
constexpr double least_height = 0.01;  ///< of a face's longest side, after a flip
constexpr double delaunay_tie = 1e-7;
constexpr int most_passes = 20;
constexpr int displaced_relaxations = 2;  ///< after the splits of a pass, and twice as many at last
constexpr double good_displaced = 0.6;    ///< quality that a step may come down to in the displaced shape
constexpr double good_undisplaced = 0.3;  ///< and undisplaced, where flanks are short

double distance(const Point& a, const Point& b) { return std::sqrt((a - b).squared_length()); }

/// Cotangent of the angle at c.
double cotangent_at(const Point& c, const Point& a, const Point& b) {
  const Vector u = a - c, v = b - c;
  const double area = std::sqrt(CGAL::cross_product(u, v).squared_length());
  return u * v / area;
}

double height_over_side(const Point& a, const Point& b, const Point& c) {
  const double area = std::sqrt(CGAL::cross_product(b - a, c - a).squared_length());
  return area / std::max({(b - a).squared_length(), (c - b).squared_length(), (a - c).squared_length()});
}

/// Least quality of the star's faces with its centre at p, negative where one turns over.
double displaced_quality(const Mesh& mesh, const std::vector<Point>& at, const Star& star, const Point& p) {
  const Point& before = at[star.centre.idx()];
  double least = 1;
  for (std::size_t i = 0; i < star.faces(); ++i) {
    const Point &a = at[mesh.target(star.spokes[i]).idx()],
                &b = at[mesh.target(star.spokes[star.after(i)]).idx()];
    const Vector now = CGAL::cross_product(a - p, b - p), was = CGAL::cross_product(a - before, b - before);
    const double sides = (a - p).squared_length() + (b - a).squared_length() + (p - b).squared_length();
    const double area = std::sqrt(now.squared_length());
    least = std::min(least, 2 * std::numbers::sqrt3 * (now * was > 0 ? area : -area) / sides);
  }
  return least;
}

bool may_move(const BandMesh& band, Vertex v) {
  return !band.is_old(v) && band.hold[v.idx()] == Hold::free && band.on[v.idx()].empty();
}

/// One round of better places for the band's new vertices, as relax_band() gives, but in the displaced shape:
/// splits halve edges, and a mesh of halves has corners of four faces, at which even a smooth fold looks
/// knobbly. Only free vertices move, that lie on no curve, seam or border; the rest metric is kept. A step
/// that turns a face over in either shape, or makes the worst face of a star worse where it is bad, is
/// refused. `displaced` follows. O(vertices of the band).
void relax_displaced(BandMesh& band, const BandSizing& sizing, std::vector<Point>& displaced,
                     const Displacing& displacing) {
  const Mesh& mesh = band.mesh;
  const std::vector<Vertex> vertices = band.vertices();
  std::vector<double> size(mesh.num_vertices(), 0);
  for (Vertex v : vertices) size[v.idx()] = sizing.at(mesh.point(v), 4 * band.mean_edge(v));
  for (Vertex v : vertices) {
    physics::throw_if_cancelled("wrinkle");
    if (!may_move(band, v)) continue;
    const Star raised = lay_flat(mesh, displaced, v), flat = lay_flat(mesh, band.rest, v);
    const StarPoint to = find_in_star(raised, relaxed_place(mesh, raised, size));
    if (to.weights[0] == 1 || std::min({to.weights[0], to.weights[1], to.weights[2]}) < 0) continue;
    const Between between{
        {v, mesh.target(raised.spokes[to.face]), mesh.target(raised.spokes[raised.after(to.face)])},
        to.weights};
    const FacePoint place = band.base.project(band.place[v.idx()], position_in(mesh, flat, to));
    const Point p = displacing.at(between, place);
    const double now = displaced_quality(mesh, displaced, raised, displaced[v.idx()]);
    if (!(displaced_quality(mesh, displaced, raised, p) >= std::min(good_displaced, now))) continue;
    const Place2 there = place_in(flat, to);
    if (!band.move(flat, there, std::min(good_undisplaced, least_quality(flat, {0, 0})))) continue;
    displaced[v.idx()] = p;
    displacing.take(v);
  }
}

class SecondPass {
 public:
  SecondPass(BandMesh& band, const BandSizing& sizing, std::vector<Point>& displaced,
             const Displacing& displacing)
      : band_(band), mesh_(band.mesh), sizing_(sizing), displaced_(displaced), displacing_(displacing) {}

  void run() {
    for (int i = 0; i < most_passes; ++i) {
      const std::size_t count = split();
      flip();
      if (count == 0 && i == 0) return;
      if (count == 0) break;
      relax(displaced_relaxations);
    }
    relax(2 * displaced_relaxations);
  }

 private:
  const Point& at(Vertex v) const { return displaced_[v.idx()]; }
  double length(Edge e) const { return distance(at(mesh_.vertex(e, 0)), at(mesh_.vertex(e, 1))); }

  void relax(int rounds) {
    for (int i = 0; i < rounds; ++i) {
      relax_displaced(band_, sizing_, displaced_, displacing_);
      flip();
    }
  }

  std::size_t split() {
    const auto is_too_long = [&](Edge e) {
      const double most = length(e) / too_stretched;
      const Halfedge h = band_.from_lower(e);
      const Point middle = CGAL::midpoint(mesh_.point(mesh_.source(h)), mesh_.point(mesh_.target(h)));
      const double size = sizing_.at(middle, most);
      return size < most && band_.rest[e] > least_share * size;
    };
    return split_longest(
        band_, [&](Edge e) { return length(e); }, is_too_long,
        [&](Edge e) {
          if (displaced_.size() > most_vertices_)
            throw ContentError(
                "strokes: the cloth beside them lies in folds so close that their heights jump; draw them "
                "elsewhere, make them narrower, or use the rule safe");
          const Halfedge h = band_.from_lower(e);
          const SplitEdge ends{mesh_.source(h), mesh_.target(h), band_.split(e, 0.5)};
          const FacePoint& place = band_.place[ends.vertex.idx()];
          displaced_.push_back(displacing_.at({{ends.from, ends.to, ends.to}, {0.5, 0.5, 0}}, place));
          displacing_.take(ends.vertex);
          return ends.vertex;
        });
  }

  bool is_delaunay(Edge e) const {
    const Halfedge h = band_.from_lower(e), o = mesh_.opposite(h);
    const Point &a = at(mesh_.source(h)), &b = at(mesh_.target(h));
    return !(cotangent_at(at(mesh_.target(mesh_.next(h))), a, b) +
                 cotangent_at(at(mesh_.target(mesh_.next(o))), a, b) <
             -delaunay_tie);
  }

  bool may_be_flipped(Edge e) const {
    const Halfedge h = band_.from_lower(e), o = mesh_.opposite(h);
    const Point &a = at(mesh_.source(h)), &b = at(mesh_.target(h)), &c = at(mesh_.target(mesh_.next(h))),
                &d = at(mesh_.target(mesh_.next(o)));
    if (!(std::min(height_over_side(a, d, c), height_over_side(d, b, c)) >= least_height)) return false;
    return band_.may_be_flipped(e, [&](Vertex v) -> const Point& { return at(v); });
  }

  void flip() {
    std::vector<std::pair<std::pair<Vertex, Vertex>, Edge>> edges;
    for (Edge e : mesh_.edges()) {
      physics::throw_if_cancelled("wrinkle");
      const Halfedge h = band_.from_lower(e);
      if (!mesh_.is_border(e) && band_.touches_band(e) && !is_delaunay(e))
        edges.push_back({{mesh_.source(h), mesh_.target(h)}, e});
    }
    std::sort(edges.begin(), edges.end());
    std::deque<Edge> queue;
    for (const auto& entry : edges) queue.push_back(entry.second);
    const std::size_t limit = 100 * queue.size() + 100;
    for (std::size_t count = 0; !queue.empty() && count < limit; queue.pop_front()) {
      physics::throw_if_cancelled("wrinkle");
      const Edge e = queue.front();
      if (mesh_.is_border(e) || is_delaunay(e) || !may_be_flipped(e)) continue;
      band_.editor.flip_edge(e);
      ++band_.flips;
      ++count;
      const Halfedge h = band_.from_lower(e), o = mesh_.opposite(h);
      for (Halfedge s : {mesh_.next(h), mesh_.prev(h), mesh_.next(o), mesh_.prev(o)})
        if (band_.touches_band(mesh_.edge(s))) queue.push_back(mesh_.edge(s));
    }
  }

  BandMesh& band_;
  const Mesh& mesh_;
  const BandSizing& sizing_;
  std::vector<Point>& displaced_;
  const Displacing& displacing_;
  const std::size_t most_vertices_ = 4 * displaced_.size() + 5000;
};

/// Takes over what the first pass knows.
void resume(BandMesh& band, const BandReport& report, const CurveArcs& arcs, const BandSizing& sizing) {
  band.place = report.places;
  band.in_band = report.in_band;
  for (std::size_t i = 0; i < arcs.arcs.size(); ++i) {
    band.curves.emplace_back(arcs.arcs[i], sizing.on_curves()[i]);
    const BandChain& chain = report.chains[arcs.curve[i]];
    for (const auto& [along, v] : arcs.part(i, chain.along, chain.vertices))
      band.put_on(v, static_cast<int>(i), along);
  }
}

/// The report of the first pass with what the second one adds.
BandReport joined(BandReport first, BandReport second) {
  second.snapped = std::move(first.snapped);
  second.min_angle_before_deg = first.min_angle_before_deg;
  second.inserted += first.inserted;
  second.flipped += first.flipped;
  second.detours += first.detours;
  second.split_edges.insert(second.split_edges.begin(), first.split_edges.begin(), first.split_edges.end());
  std::set<Face> changed(first.changed_faces.begin(), first.changed_faces.end());
  changed.insert(second.changed_faces.begin(), second.changed_faces.end());
  second.changed_faces.assign(changed.begin(), changed.end());
  return second;
}

double smallest_angle_in(const BandMesh& band, const std::vector<Point>& displaced) {
  double least = std::numbers::pi / 3;
  for (Face f : band.mesh.faces()) {
    if (!band.in_band[f.idx()]) continue;
    const auto c = corners_of(band.mesh, f);
    TriangleLengths lengths;
    for (int i = 0; i < 3; ++i) lengths[i] = distance(displaced[c[i].idx()], displaced[c[(i + 1) % 3].idx()]);
    least = std::min(least, smallest_angle(lengths));
  }
  return least * 180 / std::numbers::pi;
}

}  // namespace

DisplacedReport refine_displaced(Mesh& mesh, const Mesh& given, std::span<const FoldCurve> curves,
                                 std::vector<Point>& displaced, const Displacing& displacing,
                                 BandReport& report, const BandOptions& options) {
  if (displaced.size() != mesh.num_vertices() || report.places.size() != mesh.num_vertices() ||
      report.in_band.size() != mesh.num_faces() || report.chains.size() != curves.size())
    refuse("refine_displaced", "displaced places and band are not those of the mesh");
  Mesh work = mesh;
  BandMesh band(work, given);
  band.flip_options.may_flip = options.may_flip;
  const CurveArcs arcs(curves);
  const BandSizing sizing(arcs.arcs, options.detail, options.least_edge);
  resume(band, report, arcs, sizing);
  std::vector<Point> places = displaced;
  SecondPass(band, sizing, places, displacing).run();
  tighten_displaced(band, places);
  band.finish();
  report = joined(std::move(report), report_on(band, arcs));
  const DisplacedReport result{band.splits, band.flips, smallest_angle_in(band, places)};
  displaced = std::move(places);
  mesh = std::move(work);
  return result;
}

}  // namespace furrow::geometry
