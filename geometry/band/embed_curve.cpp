// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/band/embed_curve.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <set>

#include "geometry/insert/connect_line.h"
#include "geometry/mesh/errors.h"
#include "physics/base/cancel_scope.h"

namespace furrow::geometry {
namespace {

constexpr int most_detours = 200;  ///< of one curve: more of them come nowhere

constexpr double snap_within = 0.3;  ///< in h, beside the curve
constexpr double snap_apart = 0.35;  ///< in h, along the curve
constexpr double end_within = 0.75;  ///< in h, of an end
constexpr double same_place = 1e-6;  ///< in h: such a vertex lies on the curve
constexpr double as_it_is = 0.04;    ///< in h: so does one that may not move
constexpr double shared = 0.25;      ///< in h: so does one of another line, or face between them were thin
constexpr double thin = 0.3;         ///< quality that a snap may come down to
constexpr double flat = 0.05;        ///< angle defect of a star that counts as flat [rad]
constexpr double unstrained = 0.02;  ///< edges that are longer or shorter than at rest by no more

/// Which vertices snap onto the curve.
struct Snap {
  double within, apart;  ///< beside the curve, and along it from the next that did, in h
  double least_quality;  ///< that a face around may come down to
};
/// The second one takes a vertex onto the curve where two crossings close to each other would be split.
constexpr std::array<Snap, 2> snaps{{{snap_within, snap_apart, thin}, {0.42, 0.5, 0.45}}};

/// A vertex near the curve.
struct Candidate {
  Vertex vertex;
  BandCurve::Near near;
  double h;
};

double gap(const Point& a, const Point& b) { return std::sqrt((a - b).squared_length()); }

class Embedding {
 public:
  Embedding(BandMesh& band, int index)
      : band_(band), mesh_(band.mesh), index_(index), curve_(band.curves[index]) {}

  void run(const FoldCurve& given, const ArcEnds& known) {
    const std::vector<Face> faces = trace(given.places.front().face);
    if (!curve_.closed()) {
      for (const bool at_end : {false, true}) {
        const double along = at_end ? curve_.length() : 0;
        if (const auto& end = at_end ? known.last : known.first)
          band_.put_on(*end, index_, along);
        else
          place_end(along, at_end ? faces.back() : faces.front(),
                    at_end ? given.ends_at_border : given.begins_at_border);
      }
    }
    snap(candidates(trace(given.places.front().face)));
    if (curve_.vertices.empty()) place_end(0, trace(given.places.front().face).front(), false);
    march(given);
    mark(given.line);
  }

 private:
  double local_h(Vertex v, double along) const { return std::min(curve_.h_at(along), band_.mean_edge(v)); }

  /// The faces below the points of the curve.
  std::vector<Face> trace(Face start) const {
    std::vector<Face> faces;
    Face face = start;
    for (std::size_t i = 0; i <= curve_.segments(); ++i) {
      physics::throw_if_cancelled("wrinkle");
      face = walk_towards(mesh_, face, curve_.point(i), [](Edge) { return true; }).face;
      faces.push_back(face);
    }
    return faces;
  }

  std::vector<Vertex> around(Face face) const {
    std::vector<Vertex> result;
    for (Halfedge h : halfedges_of(mesh_, face)) {
      result.push_back(mesh_.source(h));
      const Halfedge o = mesh_.opposite(h);
      if (!mesh_.is_border(o)) result.push_back(mesh_.target(mesh_.next(o)));
    }
    return result;
  }

  std::vector<Candidate> candidates(const std::vector<Face>& faces) const {
    std::map<Vertex, BandCurve::Near> nearest;
    for (std::size_t i = 0; i < faces.size(); ++i) {
      physics::throw_if_cancelled("wrinkle");
      for (Vertex v : around(faces[i])) {
        const auto k = static_cast<std::ptrdiff_t>(i);
        const BandCurve::Near near = curve_.nearest(mesh_.point(v), k - 3, k + 3);
        const auto [known, is_new] = nearest.try_emplace(v, near);
        if (!is_new && near.distance < known->second.distance) known->second = near;
      }
    }
    std::vector<Candidate> result;
    for (const auto& [v, near] : nearest) result.push_back({v, near, local_h(v, near.along)});
    std::stable_sort(result.begin(), result.end(), [](const Candidate& a, const Candidate& b) {
      return static_cast<float>(a.near.distance) < static_cast<float>(b.near.distance);
    });
    return result;
  }

  bool taken(double along, double within) const {
    const auto near = [&](double other) {
      return std::min(curve_.ahead(along, other), curve_.ahead(other, along)) < within ||
             std::abs(other - along) < within;
    };
    const auto& on = curve_.vertices;
    if (on.empty()) return false;
    const auto next = on.lower_bound(along);
    const double after = next != on.end() ? next->first : on.begin()->first,
                 before = next != on.begin() ? std::prev(next)->first : std::prev(on.end())->first;
    return curve_.closed() ? near(after) || near(before)
                           : std::abs(after - along) < within || std::abs(before - along) < within;
  }

  /// Vertices that may not leave where they are, whatever the curve.
  bool stays(Vertex v) const {
    return band_.hold[v.idx()] != Hold::free || band_.on[v.idx()].size() > 1 || mesh_.is_border(v);
  }

  /// On the border, another line or another curve, where this one may pass through it without being exactly
  /// there, so that no thin face lies between the two.
  bool is_shared(Vertex v) const {
    return mesh_.is_border(v) || !band_.on[v.idx()].empty() || band_.editor.line()[v] >= 0;
  }

  /// Moves a vertex to a point of the curve.
  bool slide(Vertex v, double along, double least) {
    const Star star = lay_flat(mesh_, band_.rest, v);
    const Point p = curve_.at(along);
    least = std::min(least, 0.9 * least_quality(star, {0, 0}));
    const StarPoint at = find_in_star(mesh_, star, p);
    if (*std::min_element(at.weights.begin(), at.weights.end()) < -0.05) return false;
    if (std::abs(star.defect) <= flat) return band_.move(star, place_in(star, at), least, &p);
    for (Halfedge h : star.spokes) {
      const double now = gap(mesh_.point(mesh_.source(h)), mesh_.point(mesh_.target(h)));
      if (std::abs(band_.rest[mesh_.edge(h)] / now - 1) > unstrained) return false;
    }
    return band_.move_in_space(star, p, least);
  }

  /// Where this curve meets the one that a vertex is on, near it; none if they do not.
  std::optional<BandCurve::Near> crossing_near(Vertex v, const OnCurve& other, double along, double h) const {
    const BandCurve& second = band_.curves[other.curve];
    BandCurve::Near here{along, 0}, there{other.along, 0};
    for (int i = 0; i < 40; ++i) {
      there = second.nearest(curve_.at(here.along), there.along, h);
      here = curve_.nearest(second.at(there.along), here.along, h);
    }
    if (here.distance > 1e-3 * h) return std::nullopt;
    return BandCurve::Near{here.along, gap(mesh_.point(v), curve_.at(here.along))};
  }

  /// A vertex of another curve slides along that to the crossing.
  bool slide_to_crossing(const Candidate& c) {
    const OnCurve other = band_.on[c.vertex.idx()].front();
    const auto at = crossing_near(c.vertex, other, c.near.along, c.h);
    if (!at || at->distance > 0.45 * c.h || taken(at->along, snap_apart * c.h)) return false;
    const BandCurve& second = band_.curves[other.curve];
    const double there = second.nearest(curve_.at(at->along), other.along, c.h).along;
    if (!slide(c.vertex, at->along, thin)) return false;
    band_.take_off(c.vertex, other.curve);
    band_.put_on(c.vertex, other.curve, there);
    band_.put_on(c.vertex, index_, at->along);
    return true;
  }

  void snap(const std::vector<Candidate>& list) {
    for (const Candidate& c : list) {
      if (band_.along(c.vertex, index_) >= 0) continue;
      const double within = stays(c.vertex) ? as_it_is : same_place;
      if (c.near.distance <= within * c.h && !taken(c.near.along, 1e-3 * c.h))
        band_.put_on(c.vertex, index_, c.near.along);
    }
    for (const Snap& rule : snaps)
      for (const Candidate& c : list) snap(c, rule);
  }

  void snap(const Candidate& c, const Snap& rule) {
    physics::throw_if_cancelled("wrinkle");
    if (c.near.distance > rule.within * c.h || band_.along(c.vertex, index_) >= 0) return;
    if (!stays(c.vertex) && !band_.on[c.vertex.idx()].empty() && slide_to_crossing(c)) return;
    if (is_shared(c.vertex)) {
      if (c.near.distance <= shared * c.h && !taken(c.near.along, snap_apart * c.h))
        band_.put_on(c.vertex, index_, c.near.along);
    } else if (stays(c.vertex)) {
      return;
    } else if (!taken(c.near.along, rule.apart * c.h) && slide(c.vertex, c.near.along, rule.least_quality)) {
      band_.put_on(c.vertex, index_, c.near.along);
    }
  }

  /// The vertex at an end of the curve, or the one that a closed curve begins with.
  void place_end(double along, Face face, bool at_border) {
    const Point p = curve_.at(along);
    std::vector<std::pair<float, Vertex>> list;
    for (Vertex v : around(face)) list.push_back({static_cast<float>(gap(mesh_.point(v), p)), v});
    std::sort(list.begin(), list.end());
    std::optional<Vertex> end;
    if (at_border) end = end_on_border(p, list);
    for (const auto& [distance, v] : list) {
      if (end) break;
      const double h = local_h(v, along);
      const double within = is_shared(v) && !mesh_.is_border(v) ? shared : stays(v) ? as_it_is : same_place;
      if (distance <= within * h) end = v;
      if (!end && !stays(v) && band_.on[v.idx()].empty() && distance <= end_within * h &&
          slide(v, along, thin))
        end = v;
    }
    if (!end) end = split_at(face, along);
    band_.hold[end->idx()] = Hold::fixed;
    band_.put_on(*end, index_, along);
  }

  /// The nearest edge of a face is split, and the new vertex goes to the place.
  Vertex split_at(Face face, double along) {
    const Point p = curve_.at(along);
    Halfedge best;
    double least = std::numeric_limits<double>::infinity(), t = 0.5;
    for (Halfedge h : halfedges_of(mesh_, face)) {
      const Point& a = mesh_.point(mesh_.source(h));
      const Vector side = mesh_.point(mesh_.target(h)) - a;
      const double s = std::clamp(((p - a) * side) / side.squared_length(), 0.15, 0.85);
      const double d = gap(p, a + s * side);
      if (d < least) least = d, best = h, t = s;
    }
    const Edge e = mesh_.edge(best);
    const Vertex v = band_.split(e, band_.from_lower(e) == best ? t : 1 - t);
    if (band_.hold[v.idx()] == Hold::free && band_.on[v.idx()].empty()) slide(v, along, 0.05);
    return v;
  }

  std::optional<Vertex> end_on_border(const Point& p, const std::vector<std::pair<float, Vertex>>& list) {
    Halfedge best;
    double least = std::numeric_limits<double>::infinity(), t = 0;
    for (const auto& entry : list) {
      if (!mesh_.is_border(entry.second)) continue;
      for (Halfedge h : mesh_.halfedges_around_target(mesh_.halfedge(entry.second))) {
        if (!mesh_.is_border(mesh_.edge(h))) continue;
        const Halfedge low = band_.from_lower(mesh_.edge(h));
        const Point& a = mesh_.point(mesh_.source(low));
        const Vector side = mesh_.point(mesh_.target(low)) - a;
        const double s = std::clamp(((p - a) * side) / side.squared_length(), 0.0, 1.0);
        const double d = gap(p, a + s * side);
        if (d < least * (1 - 1e-9)) least = d, best = low, t = s;
      }
    }
    if (!best.is_valid()) return std::nullopt;
    const Vertex near = t < 0.5 ? mesh_.source(best) : mesh_.target(best);
    const double off = std::min(t, 1 - t);
    if (off < 1e-6 || (off < 0.5 && slide_on_border(near, best, off))) return near;
    if (off < shared) return near;  // a corner of the border, or where another line ends
    return band_.split(mesh_.edge(best), t);
  }

  /// Moves a border vertex along a border edge by a part of it, where the border is nearly straight.
  bool slide_on_border(Vertex v, Halfedge edge, double part) {
    if (band_.hold[v.idx()] != Hold::border || !band_.on[v.idx()].empty()) return false;
    const Star star = lay_flat(mesh_, band_.rest, v);
    const Place2 &a = star.ends.front(), &b = star.ends.back();
    const double cosine = -(a[0] * b[0] + a[1] * b[1]) / std::hypot(a[0], a[1]) / std::hypot(b[0], b[1]);
    if (cosine < (band_.is_old(v) ? 0.97 : 0.999)) return false;
    const bool first = mesh_.edge(star.spokes.front()) == mesh_.edge(edge);
    const Place2& to = first ? a : b;
    const Point& end = mesh_.point(mesh_.target(first ? star.spokes.front() : star.spokes.back()));
    const Point p = mesh_.point(v) + part * (end - mesh_.point(v));
    return band_.move(star, {part * to[0], part * to[1]}, thin, &p);
  }

  struct Crossing {
    std::size_t face;  ///< of the star: the edge opposite the centre is crossed
    double t;          ///< from the end of spoke `face`
    double way;        ///< along the curve from the centre [m]
  };

  /// Coordinates of the tangent plane at the centre of a star.
  struct Plane {
    Point origin;
    Vector x, y;
    Place2 operator()(const Point& p) const { return {(p - origin) * x, (p - origin) * y}; }
  };
  Plane plane_of(const Star& star) const {
    Vector normal(0, 0, 0);
    const Point& o = mesh_.point(star.centre);
    for (std::size_t i = 0; i < star.faces(); ++i)
      normal = normal + CGAL::cross_product(mesh_.point(mesh_.target(star.spokes[i])) - o,
                                            mesh_.point(mesh_.target(star.spokes[star.after(i)])) - o);
    normal = normalized(normal);
    Vector x = mesh_.point(mesh_.target(star.spokes.front())) - o;
    x = normalized(x - (x * normal) * normal);
    return {o, x, CGAL::cross_product(normal, x)};
  }

  /// Where a straight piece of the curve leaves a star.
  std::optional<Crossing> leaves(const std::vector<Place2>& ends, const Star& star, const Place2& a,
                                 const Place2& b) const {
    std::optional<Crossing> first;
    for (std::size_t i = 0; i < star.faces(); ++i) {
      const Place2 &p = ends[i], &q = ends[star.after(i)];
      const auto side = [&](const Place2& x) {
        return (q[0] - p[0]) * (x[1] - p[1]) - (q[1] - p[1]) * (x[0] - p[0]);
      };
      const double from = side(a), to = side(b);
      if (!(from >= 0 && to < 0)) continue;
      const double u = from / (from - to);
      const Place2 x{a[0] + u * (b[0] - a[0]), a[1] + u * (b[1] - a[1])};
      const double squared = (q[0] - p[0]) * (q[0] - p[0]) + (q[1] - p[1]) * (q[1] - p[1]);
      const double t = ((x[0] - p[0]) * (q[0] - p[0]) + (x[1] - p[1]) * (q[1] - p[1])) / squared;
      if (t >= -1e-6 && t <= 1 + 1e-6 && (!first || u < first->way)) first = Crossing{i, t, u};
    }
    return first;
  }

  /// The curve's first way out of the star, from a place on; none if it ends within.
  std::optional<Crossing> way_out(const Star& star, double along) const {
    const Plane plane = plane_of(star);
    std::vector<Place2> ends;
    double longest = 0;
    for (Halfedge h : star.spokes) {
      ends.push_back(plane(mesh_.point(mesh_.target(h))));
      longest = std::max(longest, std::hypot(ends.back()[0], ends.back()[1]));
    }
    Place2 a{0, 0};
    std::size_t i = curve_.segment_at(along);
    double way = 0, left = curve_.arc(i + 1) - along;
    while (way < 3 * longest) {
      const Place2 b = plane(curve_.point(i + 1));
      if (auto out = leaves(ends, star, a, b)) {
        out->way = way + out->way * left;
        return out;
      }
      way += left;
      a = b;
      if (++i == curve_.segments()) {
        if (!curve_.closed()) return std::nullopt;
        i = 0;
      }
      left = curve_.arc(i + 1) - curve_.arc(i);
    }
    return std::nullopt;
  }

  /// The next vertex of the chain after one at a place, on the curve already or made there.
  std::optional<Vertex> advance(Vertex v, double along) {
    const Star star = lay_flat(mesh_, band_.rest, v);
    const auto out = way_out(star, along);
    const double h = local_h(v, along);
    double limit = out ? out->way + snap_within * h : 3 * h;
    std::optional<Vertex> next;
    for (Halfedge s : star.spokes) {
      const double there = band_.along(mesh_.target(s), index_);
      if (there < 0) continue;
      const double way = curve_.ahead(along, there);
      if (way > 1e-9 * h && way <= limit) limit = way, next = mesh_.target(s);
    }
    if (next || !out) return next;
    return cross(star, *out, curve_.wrapped(along + out->way));
  }

  /// Splits the edge opposite the centre of a star where the curve crosses it, or takes its end.
  Vertex cross(const Star& star, const Crossing& out, double along) {
    const Halfedge h = mesh_.next(star.spokes[out.face]);
    const Vertex near = out.t < 0.5 ? mesh_.source(h) : mesh_.target(h);
    const double length = band_.rest[mesh_.edge(h)], off = std::min(out.t, 1 - out.t) * length;
    if (band_.along(near, index_) < 0 && off < snap_within * local_h(near, along)) {
      const BandCurve::Near at = curve_.nearest(mesh_.point(near), along, length);
      const bool enough = !taken(at.along, 1e-3 * length);
      const bool is_near = (stays(near) && at.distance < as_it_is * length) ||
                           (is_shared(near) && at.distance < shared * length);
      const bool may = !stays(near) && band_.on[near.idx()].empty();
      if (enough && (is_near || (may && slide(near, at.along, 0.2)))) {
        band_.put_on(near, index_, at.along);
        return near;
      }
    }
    const double t = std::clamp(out.t, 0.02, 0.98);
    const Vertex v = band_.split(mesh_.edge(h), band_.from_lower(mesh_.edge(h)) == h ? t : 1 - t);
    if (band_.hold[v.idx()] == Hold::free) slide(v, along, 0.02);
    if (band_.along(v, index_) < 0) band_.put_on(v, index_, along);
    return v;
  }

  [[noreturn]] static void refuse_way(const FoldCurve& given) {
    throw ContentError(
        "stroke \"" + given.name +
        "\": the mesh leaves no way along it, as where it crosses itself; draw it in parts, or use "
        "the rule safe");
  }

  /// From vertex to vertex, from the beginning to the end.
  void march(const FoldCurve& given) {
    const Vertex first = curve_.vertices.begin()->second,
                 last = curve_.closed() ? first : std::prev(curve_.vertices.end())->second;
    Vertex v = first;
    std::set<Vertex> seen;
    int detours = 0;
    do {
      physics::throw_if_cancelled("wrinkle");
      seen.insert(v);
      if (seen.size() > 4 * curve_.segments() + 200) refuse_way(given);
      const double along = band_.along(v, index_);
      std::optional<Vertex> next = advance(v, along);
      if (!next || (seen.count(*next) > 0 && *next != last)) {
        if (++detours > most_detours) refuse_way(given);
        next = detour(v, along);
      }
      v = *next;
    } while (v != last);
    std::vector<Vertex> left_out;
    for (const auto& [along, w] : curve_.vertices)
      if (seen.count(w) == 0 && w != last) left_out.push_back(w);
    for (Vertex w : left_out) band_.take_off(w, index_);
  }

  /// Along edges to the next vertex that is on the curve.
  Vertex detour(Vertex v, double along) {
    ++band_.detours;
    const Vertex to = band_.next_on(index_, along);
    const auto path = shortest_edge_path(mesh_, band_.rest, v, to);
    const double way = curve_.ahead(along, band_.along(to, index_));
    for (std::size_t i = 0; i < path.size(); ++i) {
      if (band_.along(path[i], index_) >= 0) band_.take_off(path[i], index_);
      const double part = static_cast<double>(i + 1) / static_cast<double>(path.size() + 1);
      band_.put_on(path[i], index_, curve_.wrapped(along + part * way));
    }
    return path.empty() ? to : path.front();
  }

  void mark(int line) {
    for (const auto& [along, v] : curve_.vertices) {
      band_.editor.line()[v] = line;
      const Vertex next = band_.next_on(index_, along);
      if (!next.is_valid()) continue;
      if (const auto e = band_.editor.edge_between(v, next)) band_.editor.line_edge()[*e] = true;
    }
  }

  BandMesh& band_;
  const Mesh& mesh_;
  int index_;
  BandCurve& curve_;
};

}  // namespace

void embed_curve(BandMesh& band, int index, const FoldCurve& given, const ArcEnds& known) {
  Embedding(band, index).run(given, known);
}

}  // namespace furrow::geometry
