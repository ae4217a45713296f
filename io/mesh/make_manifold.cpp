// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/mesh/make_manifold.h"

#include <algorithm>
#include <numeric>
#include <tuple>
#include <utility>

namespace furrow::io {
namespace {

constexpr std::size_t none = static_cast<std::size_t>(-1);

/// Side k of a triangle goes from its point k to its point k + 1.
struct Side {
  std::size_t triangle = none;
  int k = 0;
};
using Neighbours = std::vector<std::array<Side, 3>>;

std::pair<std::size_t, std::size_t> ends(const SoupTriangle& t, int k) {
  return {t.points[k], t.points[(k + 1) % 3]};
}

/// The other triangle at each side, where there is exactly one.
Neighbours find_neighbours(const std::vector<SoupTriangle>& triangles) {
  struct Use {
    std::size_t a, b;
    Side side;
  };
  std::vector<Use> uses;
  uses.reserve(3 * triangles.size());
  for (std::size_t t = 0; t < triangles.size(); ++t)
    for (int k = 0; k < 3; ++k) {
      const auto [a, b] = ends(triangles[t], k);
      uses.push_back({std::min(a, b), std::max(a, b), {t, k}});
    }
  std::sort(uses.begin(), uses.end(), [](const Use& p, const Use& q) {
    return std::tie(p.a, p.b, p.side.triangle, p.side.k) < std::tie(q.a, q.b, q.side.triangle, q.side.k);
  });
  Neighbours neighbours(triangles.size());
  for (std::size_t i = 0, j = 0; i < uses.size(); i = j) {
    while (j < uses.size() && uses[j].a == uses[i].a && uses[j].b == uses[i].b) ++j;
    if (j - i != 2) continue;
    const Side p = uses[i].side, q = uses[i + 1].side;
    neighbours[p.triangle][p.k] = q;
    neighbours[q.triangle][q.k] = p;
  }
  return neighbours;
}

bool same_direction(const std::vector<SoupTriangle>& triangles, const Side& p, const Side& q) {
  return ends(triangles[p.triangle], p.k) == ends(triangles[q.triangle], q.k);
}

/// Which triangles must be turned.
std::vector<char> find_turns(const std::vector<SoupTriangle>& triangles, const Neighbours& neighbours) {
  std::vector<char> turned(triangles.size(), 0), seen(triangles.size(), 0);
  std::vector<std::size_t> component;
  for (std::size_t seed = 0; seed < triangles.size(); ++seed) {
    if (seen[seed]) continue;
    component.assign(1, seed);
    seen[seed] = 1;
    std::size_t turns = 0;
    for (std::size_t i = 0; i < component.size(); ++i) {
      const std::size_t t = component[i];
      turns += turned[t];
      for (int k = 0; k < 3; ++k) {
        const Side other = neighbours[t][k];
        if (other.triangle == none || seen[other.triangle]) continue;
        seen[other.triangle] = 1;
        turned[other.triangle] = turned[t] ^ same_direction(triangles, {t, k}, other);
        component.push_back(other.triangle);
      }
    }
    if (2 * turns > component.size())
      for (const std::size_t t : component) turned[t] ^= 1;
  }
  return turned;
}

/// Sets of triangle corners (3 t + k); the smallest corner stands for its set.
class Fans {
 public:
  explicit Fans(std::size_t n) : parent_(n) { std::iota(parent_.begin(), parent_.end(), std::size_t{0}); }
  std::size_t first(std::size_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  void join(std::size_t i, std::size_t j) {
    const std::size_t a = first(i), b = first(j);
    parent_[std::max(a, b)] = std::min(a, b);
  }

 private:
  std::vector<std::size_t> parent_;
};

std::size_t corner_at(const std::vector<SoupTriangle>& triangles, std::size_t t, std::size_t point) {
  const auto& p = triangles[t].points;
  return 3 * t + (p[0] == point ? 0 : p[1] == point ? 1 : 2);
}

Fans join_fans(const std::vector<SoupTriangle>& triangles, const Neighbours& neighbours,
               const std::vector<char>& turned) {
  Fans fans(3 * triangles.size());
  for (std::size_t t = 0; t < triangles.size(); ++t)
    for (int k = 0; k < 3; ++k) {
      const Side other = neighbours[t][k];
      if (other.triangle == none || other.triangle < t) continue;
      const bool differ = turned[t] ^ turned[other.triangle];
      if (same_direction(triangles, {t, k}, other) != differ) continue;
      const auto [a, b] = ends(triangles[t], k);
      fans.join(corner_at(triangles, t, a), corner_at(triangles, other.triangle, a));
      fans.join(corner_at(triangles, t, b), corner_at(triangles, other.triangle, b));
    }
  return fans;
}

}  // namespace

ManifoldReport make_manifold(std::vector<SoupTriangle>& triangles, std::size_t n_points) {
  const Neighbours neighbours = find_neighbours(triangles);
  const std::vector<char> turned = find_turns(triangles, neighbours);
  Fans fans = join_fans(triangles, neighbours, turned);
  ManifoldReport report;
  std::vector<std::size_t> point_of_fan(3 * triangles.size(), none);
  std::vector<char> taken(n_points, 0);
  for (std::size_t t = 0; t < triangles.size(); ++t)
    for (int k = 0; k < 3; ++k) {
      std::size_t& point = triangles[t].points[k];
      std::size_t& of_fan = point_of_fan[fans.first(3 * t + k)];
      if (of_fan == none && !std::exchange(taken[point], 1)) of_fan = point;
      if (of_fan == none) {
        of_fan = n_points + report.added_points.size();
        report.added_points.push_back(point);
      }
      point = of_fan;
    }
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    if (!turned[t]) continue;
    std::swap(triangles[t].points[1], triangles[t].points[2]);
    std::swap(triangles[t].corners[1], triangles[t].corners[2]);
    ++report.reversed_faces;
  }
  return report;
}

}  // namespace furrow::io
