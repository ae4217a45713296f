// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/mesh/triangulate_polygon.h"

#include <string>

#include "geometry/mesh/errors.h"

namespace furrow::io {
namespace {

using geometry::Point;
using geometry::Vector;
using Corners = std::span<const Point>;

/// Twice the polygon's vector area.
Vector newell_normal(Corners p) {
  Vector normal = CGAL::NULL_VECTOR;
  for (std::size_t i = 2; i < p.size(); ++i)
    normal = normal + CGAL::cross_product(p[i - 1] - p[0], p[i] - p[0]);
  return normal;
}

/// Signed area of a, b, c seen against n, up to a positive factor.
double turn(const Vector& n, const Point& a, const Point& b, const Point& c) {
  return n * CGAL::cross_product(b - a, c - a);
}

bool fan_turns_one_way(Corners p, const Vector& n) {
  for (std::size_t i = 2; i < p.size(); ++i)
    if (!(turn(n, p[0], p[i - 1], p[i]) > 0)) return false;
  return true;
}

/// Corners as a ring that shrinks by one ear at a time.
class Ring {
 public:
  Ring(Corners p, const Vector& n) : p_(p), n_(n), next_(p.size()), previous_(p.size()), ear_(p.size()) {
    for (std::size_t i = 0; i < p.size(); ++i) {
      next_[i] = (i + 1) % p.size();
      previous_[i] = (i + p.size() - 1) % p.size();
    }
    for (std::size_t i = 0; i < p.size(); ++i) ear_[i] = is_ear(i);
  }

  void clip(std::vector<std::array<std::size_t, 3>>& out) {
    std::size_t at = 0;
    for (std::size_t left = p_.size(); left > 2; --left) {
      std::size_t tried = 0;
      while (!ear_[at] && tried++ < left)
        at = next_[at];  // none at all: the polygon crosses itself, cut anyway
      out.push_back({previous_[at], at, next_[at]});
      const std::size_t before = previous_[at], after = next_[at];
      next_[before] = after;
      previous_[after] = before;
      if (left > 3) ear_[before] = is_ear(before), ear_[after] = is_ear(after);
      at = after;
    }
  }

 private:
  bool is_ear(std::size_t b) const {
    const std::size_t a = previous_[b], c = next_[b];
    if (!(turn(n_, p_[a], p_[b], p_[c]) > 0)) return false;
    for (std::size_t q = next_[c]; q != a; q = next_[q]) {
      if (p_[q] == p_[a] || p_[q] == p_[b] || p_[q] == p_[c]) continue;
      if (turn(n_, p_[a], p_[b], p_[q]) >= 0 && turn(n_, p_[b], p_[c], p_[q]) >= 0 &&
          turn(n_, p_[c], p_[a], p_[q]) >= 0)
        return false;
    }
    return true;
  }

  Corners p_;
  Vector n_;
  std::vector<std::size_t> next_, previous_;
  std::vector<bool> ear_;
};

}  // namespace

void triangulate_polygon(Corners corners, std::vector<std::array<std::size_t, 3>>& out) {
  const std::size_t n = corners.size();
  if (n < 3) return;
  const Vector normal = newell_normal(corners);
  if (n <= 4 || fan_turns_one_way(corners, normal)) {
    for (std::size_t i = 2; i < n; ++i) out.push_back({0, i - 1, i});
    return;
  }
  if (n > most_concave_corners)
    throw geometry::ContentError("a face that is not convex has " + std::to_string(n) +
                                 " corners, the most is " + std::to_string(most_concave_corners) +
                                 "; cut it in the modeller");
  Ring(corners, normal).clip(out);
}

}  // namespace furrow::io
