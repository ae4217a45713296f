// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/band/relax_band.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "physics/base/cancel_scope.h"

namespace furrow::geometry {
namespace {

constexpr double step = 0.7;           ///< of the way to the mean of the centroids
constexpr double good_enough = 0.6;    ///< quality that a step may come down to
constexpr double straight = 1 - 1e-9;  ///< cosine: a border is straight there

double area(const Place2& a, const Place2& b) { return 0.5 * (a[0] * b[1] - a[1] * b[0]); }

class Relaxation {
 public:
  Relaxation(BandMesh& band, const BandSizing& sizing)
      : band_(band), mesh_(band.mesh), sizing_(sizing), size_(band.mesh.num_vertices(), 0) {}

  std::size_t run() {
    const std::vector<Vertex> vertices = band_.vertices();
    for (Vertex v : vertices) size_[v.idx()] = sizing_.at(mesh_.point(v), 4 * band_.mean_edge(v));
    std::size_t count = 0;
    for (Vertex v : vertices) {
      physics::throw_if_cancelled("wrinkle");
      count += relax(v);
    }
    band_.flip_to_delaunay();
    return count;
  }

 private:
  bool relax(Vertex v) {
    if (band_.hold[v.idx()] == Hold::fixed) return false;
    if (band_.is_old(v) && !(band_.moved[v.idx()] && !band_.on[v.idx()].empty())) return false;
    if (!band_.on[v.idx()].empty()) return slide_on_curve(v, band_.on[v.idx()].front());
    if (band_.hold[v.idx()] == Hold::border) return slide_on_border(v);
    return centre(v);
  }

  /// Steps that keep good stars good and make bad ones no worse.
  bool go(const Star& star, const Place2& x, const Point* p = nullptr) {
    const double least = std::min(good_enough, least_quality(star, {0, 0}));
    return band_.move(star, x, least, p);
  }

  bool centre(Vertex v) {
    const Star star = lay_flat(mesh_, band_.rest, v);
    const Place2 to = relaxed_place(mesh_, star, size_);
    return (to[0] != 0 || to[1] != 0) && go(star, to);
  }

  bool slide_on_curve(Vertex v, const OnCurve at) {
    if (band_.hold[v.idx()] != Hold::free) return false;
    const BandCurve& curve = band_.curves[at.curve];
    const Vertex before = band_.previous_on(at.curve, at.along), after = band_.next_on(at.curve, at.along);
    if (!before.is_valid() || !after.is_valid() || before == after) return false;
    const double back = curve.ahead(band_.along(before, at.curve), at.along),
                 on = curve.ahead(at.along, band_.along(after, at.curve));
    const double along = curve.wrapped(at.along + step * (on - back) / 2);
    const Point p = curve.at(along);
    const Star star = lay_flat(mesh_, band_.rest, v);
    const StarPoint to = find_in_star(mesh_, star, p);
    if (*std::min_element(to.weights.begin(), to.weights.end()) < -1e-3) return false;
    // Of several curves, it leaves none: it stays at a crossing, and slides where one lies on the other.
    std::vector<OnCurve> there;
    for (const OnCurve& o : band_.on[v.idx()]) {
      const BandCurve::Near near = band_.curves[o.curve].nearest(p, o.along, on + back);
      if (near.distance > 1e-6 * (on + back)) return false;
      there.push_back({o.curve, o.curve == at.curve ? along : near.along});
    }
    if (!go(star, place_in(star, to), &p)) return false;
    for (const OnCurve& o : there) {
      band_.take_off(v, o.curve);
      band_.put_on(v, o.curve, o.along);
    }
    return true;
  }

  /// Only where the border is straight, so that its shape stays.
  bool slide_on_border(Vertex v) {
    const Star star = lay_flat(mesh_, band_.rest, v);
    const Place2 &a = star.ends.front(), &b = star.ends.back();
    const double to_a = std::hypot(a[0], a[1]), to_b = std::hypot(b[0], b[1]);
    const Vector u = mesh_.point(mesh_.target(star.spokes.front())) - mesh_.point(v),
                 w = mesh_.point(mesh_.target(star.spokes.back())) - mesh_.point(v);
    if (-(a[0] * b[0] + a[1] * b[1]) < straight * to_a * to_b) return false;
    if (-(u * w) < straight * std::sqrt(u.squared_length() * w.squared_length())) return false;
    const Place2& towards = to_a > to_b ? a : b;
    const double t = step * std::abs(to_a - to_b) / 2 / std::max(to_a, to_b);
    return go(star, {t * towards[0], t * towards[1]});
  }

  BandMesh& band_;
  const Mesh& mesh_;
  const BandSizing& sizing_;
  std::vector<double> size_;
};

}  // namespace

Place2 relaxed_place(const Mesh& mesh, const Star& star, const std::vector<double>& size) {
  Place2 sum{0, 0};
  double weights = 0;
  for (std::size_t i = 0; i < star.faces(); ++i) {
    const std::size_t j = star.after(i);
    const Place2 &a = star.ends[i], &b = star.ends[j];
    const double h = (size[star.centre.idx()] + size[mesh.target(star.spokes[i]).idx()] +
                      size[mesh.target(star.spokes[j]).idx()]) /
                     3;
    const double w = area(a, b) / (h * h);
    weights += w;
    for (int k = 0; k < 2; ++k) sum[k] += w * (a[k] + b[k]) / 3;
  }
  if (!(weights > 0)) return {0, 0};
  return {step * sum[0] / weights, step * sum[1] / weights};
}

std::size_t relax_band(BandMesh& band, const BandSizing& sizing) { return Relaxation(band, sizing).run(); }

}  // namespace furrow::geometry
