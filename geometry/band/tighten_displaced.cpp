// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/band/tighten_displaced.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "physics/base/cancel_scope.h"

namespace furrow::geometry {
namespace {

constexpr double least_gain = 1e-3;  ///< of a flip [rad]
constexpr double bend_share = 0.03;  ///< of the bends of edges, beside the angle defects
constexpr double least_angle = 17 * std::numbers::pi / 180;         ///< in the displaced shape
constexpr double least_angle_flat = 13.5 * std::numbers::pi / 180;  ///< undisplaced: flanks are short there
constexpr int most_sweeps = 30;

/// An edge with its two faces: a to b, and the corners opposite, c on its left and d on its right.
struct Quad {
  Halfedge left, right;
  Vertex a, b, c, d;
};

/// Of an edge that is flipped: what the angles at its corners change by [rad].
using Changes = std::array<std::pair<Vertex, double>, 4>;

/// A flip that gains; lengths of floats, so that rounding does not decide between equal ones: vertices do.
struct WaitingFlip {
  float gain;
  Vertex a, b;  // a < b
  bool operator<(const WaitingFlip& other) const {
    if (gain != other.gain) return gain > other.gain;
    return std::pair(a, b) < std::pair(other.a, other.b);
  }
};

double turn_between(const Vector& p, const Vector& q) {
  return std::atan2(std::sqrt(CGAL::cross_product(p, q).squared_length()), p * q);
}

/// The angle opposite to side c of a triangle of lengths.
double angle_opposite(double a, double b, double c) {
  return std::acos(std::clamp((a * a + b * b - c * c) / (2 * a * b), -1.0, 1.0));
}

class Tightening {
 public:
  Tightening(BandMesh& band, const std::vector<Point>& displaced)
      : band_(band),
        mesh_(band.mesh),
        at_(displaced),
        defects_(displaced.size(), 2 * std::numbers::pi),
        changed_(displaced.size(), true) {
    for (Face f : mesh_.faces()) {
      const auto c = corners_of(mesh_, f);
      for (int i = 0; i < 3; ++i) defects_[c[i].idx()] -= angle(c[i], c[(i + 1) % 3], c[(i + 2) % 3]);
    }
  }

  std::size_t run() {
    std::size_t count = 0;
    for (int sweep = 0; sweep < most_sweeps; ++sweep) {
      const std::vector<WaitingFlip> waiting = flips_that_gain();
      std::fill(changed_.begin(), changed_.end(), false);
      const std::size_t before = count;
      for (const WaitingFlip& next : waiting)
        if (const auto e = band_.editor.edge_between(next.a, next.b)) count += flip(*e);
      if (count == before) break;
    }
    return count;
  }

 private:
  Vector way(Vertex from, Vertex to) const { return at_[to.idx()] - at_[from.idx()]; }
  double angle(Vertex v, Vertex a, Vertex b) const { return turn_between(way(v, a), way(v, b)); }
  double length(Vertex a, Vertex b) const { return std::sqrt(way(a, b).squared_length()); }
  Vector normal(Vertex a, Vertex b, Vertex c) const { return CGAL::cross_product(way(a, b), way(a, c)); }

  Quad quad_of(Edge e) const {
    const Halfedge h = band_.from_lower(e), o = mesh_.opposite(h);
    return {h, o, mesh_.source(h), mesh_.target(h), mesh_.target(mesh_.next(h)), mesh_.target(mesh_.next(o))};
  }

  std::vector<WaitingFlip> flips_that_gain() const {
    std::vector<WaitingFlip> list;
    for (Edge e : mesh_.edges()) {
      physics::throw_if_cancelled("wrinkle");
      if (mesh_.is_border(e) || !band_.touches_band(e)) continue;
      const Quad q = quad_of(e);
      if (!changed_[q.a.idx()] && !changed_[q.b.idx()] && !changed_[q.c.idx()] && !changed_[q.d.idx()])
        continue;
      if (const double g = gain(q); g > least_gain && !band_.is_locked(e))
        list.push_back({static_cast<float>(g), q.a, q.b});
    }
    std::sort(list.begin(), list.end());
    return list;
  }

  Changes changes(const Quad& q) const {
    const auto [left, right, a, b, c, d] = q;
    return {{{a, angle(a, b, c) + angle(a, b, d) - angle(a, c, d)},
             {b, angle(b, a, c) + angle(b, a, d) - angle(b, c, d)},
             {c, angle(c, a, b) - angle(c, a, d) - angle(c, b, d)},
             {d, angle(d, a, b) - angle(d, a, c) - angle(d, b, c)}}};
  }

  double gain(const Quad& q) const {
    double sum = 0;
    for (const auto& [v, change] : changes(q))
      if (!mesh_.is_border(v)) sum += std::abs(defects_[v.idx()]) - std::abs(defects_[v.idx()] + change);
    return sum + bend_share * less_bent(q);
  }

  /// How much less the five edges bend after the flip, by their lengths in that of the edge [rad].
  double less_bent(const Quad& q) const {
    const auto [left, right, a, b, c, d] = q;
    const Vector abc = normal(a, b, c), bad = normal(b, a, d), adc = normal(a, d, c), dbc = normal(d, b, c);
    double less = turn_between(abc, bad) * length(a, b) - turn_between(adc, dbc) * length(c, d);
    const auto side = [&](Halfedge h, const Vector& before, const Vector& after) {
      const Halfedge o = mesh_.opposite(h);
      if (mesh_.is_border(o)) return;
      const Vertex x = mesh_.source(o), y = mesh_.target(o);
      const Vector beyond = normal(x, y, mesh_.target(mesh_.next(o)));
      less += (turn_between(before, beyond) - turn_between(after, beyond)) * length(x, y);
    };
    side(mesh_.next(left), abc, dbc);
    side(mesh_.prev(left), abc, adc);
    side(mesh_.next(right), bad, adc);
    side(mesh_.prev(right), bad, dbc);
    return less / length(a, b);
  }

  /// Whether the two faces after the flip are not thinner than they may be.
  bool stays_thick(Edge e, const Quad& q) const {
    const auto [left, right, a, b, c, d] = q;
    const auto rest = [&](Halfedge h) { return band_.rest[mesh_.edge(h)]; };
    const auto in_space = [&](Vertex x, Vertex y, Vertex z) {
      return smallest_angle({length(x, y), length(y, z), length(z, x)});
    };
    if (std::min(in_space(a, d, c), in_space(d, b, c)) <
        std::min({least_angle, in_space(a, b, c), in_space(a, b, d)}))
      return false;
    const double ab = band_.rest[e], bc = rest(mesh_.next(left)), ca = rest(mesh_.prev(left)),
                 ad = rest(mesh_.next(right)), db = rest(mesh_.prev(right));
    const double turn = angle_opposite(ab, ca, bc) + angle_opposite(ab, ad, db);
    const double cd = std::sqrt(std::max(0.0, ca * ca + ad * ad - 2 * ca * ad * std::cos(turn)));
    return std::min(smallest_angle({cd, ca, ad}), smallest_angle({cd, bc, db})) >=
           std::min({least_angle_flat, smallest_angle({ab, bc, ca}), smallest_angle({ab, ad, db})});
  }

  bool flip(Edge e) {
    const Quad q = quad_of(e);
    if (!(gain(q) > least_gain) || !stays_thick(e, q)) return false;
    if (!band_.may_be_flipped(e, [&](Vertex v) -> const Point& { return at_[v.idx()]; })) return false;
    for (const auto& [v, change] : changes(q)) {
      defects_[v.idx()] += change;
      changed_[v.idx()] = true;
    }
    band_.editor.flip_edge(e);
    ++band_.flips;
    return true;
  }

  BandMesh& band_;
  const Mesh& mesh_;
  const std::vector<Point>& at_;
  std::vector<double> defects_;  ///< by vertex; of no use at the border [rad]
  std::vector<bool> changed_;    ///< by vertex: angles there are not what they were in the last sweep
};

}  // namespace

std::size_t tighten_displaced(BandMesh& band, const std::vector<Point>& displaced) {
  return Tightening(band, displaced).run();
}

}  // namespace furrow::geometry
