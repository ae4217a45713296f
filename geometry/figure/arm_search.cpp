// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/figure/arm_search.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <queue>

namespace furrow::geometry {
namespace {

using Faces = std::span<const std::array<int, 3>>;

// Of the body's height:
constexpr double floor_band = 0.1;  // what hangs together with what lies lower is a leg
constexpr double ring_step = 0.005;
constexpr double least_reach = 0.15;  // of a tip from the armpit
// Of the way from the armpit to the tip:
constexpr double first_ring = 0.55;  // in the forearm, from where rings are followed inwards
constexpr double wrist = 0.76;
// Growth of a ring's girth inwards, by which arm and trunk are told apart (as torso_levels() does).
constexpr double ring_jump = 0.10, ring_four_jump = 0.25, ring_begins = 0.03;

double distance(const Point& a, const Point& b) { return std::sqrt((a - b).squared_length()); }

/// Neighbours along edges.
std::vector<std::vector<int>> neighbours_of(std::size_t count, Faces triangles) {
  std::vector<std::vector<int>> next(count);
  for (const auto& t : triangles)
    for (std::size_t k = 0; k < 3; ++k) {
      next[std::size_t(t[k])].push_back(t[(k + 1) % 3]);
      next[std::size_t(t[k])].push_back(t[(k + 2) % 3]);
    }
  return next;
}

/// What lies below the crotch and hangs together there with what stands on the floor.
std::vector<char> leg_points(std::span<const Point> points, const std::vector<std::vector<int>>& next,
                             double crotch, double floor) {
  std::vector<char> leg(points.size(), 0);
  std::vector<int> todo;
  for (std::size_t i = 0; i < points.size(); ++i)
    if (points[i].y() < floor) leg[i] = 1, todo.push_back(int(i));
  while (!todo.empty()) {
    const int at = todo.back();
    todo.pop_back();
    for (const int n : next[std::size_t(at)])
      if (!leg[std::size_t(n)] && points[std::size_t(n)].y() < crotch)
        leg[std::size_t(n)] = 1, todo.push_back(n);
  }
  return leg;
}

/// From the waist along edges [m]; infinite where no way leads. Not through legs.
std::vector<double> ways_from(const std::vector<int>& start, std::span<const Point> points,
                              const std::vector<std::vector<int>>& next, const std::vector<char>& leg) {
  std::vector<double> way(points.size(), INFINITY);
  using Entry = std::pair<double, int>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
  for (const int i : start) way[std::size_t(i)] = 0, queue.emplace(0, i);
  while (!queue.empty()) {
    const auto [far, at] = queue.top();
    queue.pop();
    if (far > way[std::size_t(at)]) continue;
    for (const int n : next[std::size_t(at)]) {
      const double longer = far + distance(points[std::size_t(at)], points[std::size_t(n)]);
      if (leg[std::size_t(n)] || !(longer < way[std::size_t(n)])) continue;
      way[std::size_t(n)] = longer;
      queue.emplace(longer, n);
    }
  }
  return way;
}

/// Turns a direction downwards, by the shortest way.
class Downwards {
 public:
  explicit Downwards(const Vector& axis) : a_(axis) {
    const Vector down(0, -1, 0), side = CGAL::cross_product(axis, down);
    cosine_ = axis * down;
    const double sine = std::sqrt(side.squared_length());
    around_ = sine > 1e-12 ? side / sine : Vector(1, 0, 0);
    sine_ = sine;
  }
  Vector operator()(const Vector& v) const { return turned(v, sine_); }
  Vector back(const Vector& v) const { return turned(v, -sine_); }

 private:
  /// Rodrigues' formula.
  Vector turned(const Vector& v, double sine) const {
    return cosine_ * v + sine * CGAL::cross_product(around_, v) + (1 - cosine_) * (around_ * v) * around_;
  }
  Vector a_, around_{1, 0, 0};
  double cosine_ = 1, sine_ = 0;
};

/// Sections across an axis through an origin.
class Across {
 public:
  Across(std::span<const Point> points, Faces triangles, const Point& origin, const Vector& axis)
      : turn_(axis), origin_(origin), triangles_(triangles) {
    for (const Point& p : points) turned_.push_back(CGAL::ORIGIN + turn_(p - origin));
  }
  /// The closed curve whose middle lies nearest to a place.
  std::optional<ArmRing> ring(double along, const Point& near) const {
    const Vector at = turn_(near - origin_);
    std::optional<ArmRing> best;
    double least = INFINITY;
    for (const SectionLoop& loop : horizontal_section(turned_, triangles_, -along)) {
      const auto [x, z] = centre_of(loop);
      const double off = std::hypot(x - at.x(), z - at.z()), girth = tape_measure(loop);
      if (!loop.closed || off >= least || girth < 0.08) continue;
      least = off;
      best = ArmRing{along, origin_ + turn_.back(Vector(x, -along, z)), girth / (2 * std::numbers::pi)};
    }
    return best;
  }

 private:
  Downwards turn_;
  Point origin_;
  Faces triangles_;
  std::vector<Point> turned_;
};

double grown(const std::vector<ArmRing>& rings, std::size_t steps) {
  return rings.size() > steps ? rings.back().radius / rings[rings.size() - 1 - steps].radius - 1 : 0;
}

/// From the forearm inwards, until the arm grows together with the trunk.
std::vector<ArmRing> rings_inwards(const Across& across, double from, double step, const Point& near) {
  std::vector<ArmRing> rings;
  Point at = near;
  for (double along = from; along > from - 2; along -= step) {
    const auto ring = across.ring(along, at);
    if (!ring) break;
    rings.push_back(*ring);
    at = ring->centre;
    if (grown(rings, 1) <= ring_jump && grown(rings, 4) <= ring_four_jump) continue;
    do rings.pop_back();
    while (rings.size() > 1 && grown(rings, 1) > ring_begins);
    break;
  }
  return rings;
}

Vector unit(const Vector& v) { return v / std::sqrt(v.squared_length()); }

/// The rings of an arm whose tip is known, from its root to its wrist, with its axis.
std::optional<Arm> arm_to(const Point& tip, const Point& armpit, double tall, std::span<const Point> points,
                          Faces triangles) {
  Point root = armpit, near = armpit + first_ring * (tip - armpit);
  Vector axis = unit(tip - root);
  Arm arm;
  for (int round = 0; round < 3; ++round) {
    const Across across(points, triangles, root, axis);
    const double from = (near - root) * axis;
    std::vector<ArmRing> rings = rings_inwards(across, from, ring_step * tall, near);
    if (rings.size() < 8) return std::nullopt;
    std::reverse(rings.begin(), rings.end());
    const double reach = (tip - rings.front().centre) * axis, length = wrist * reach;
    const double begins = rings.front().along;
    Point at = rings.back().centre;
    for (double along = rings.back().along + ring_step * tall; along <= begins + length;
         along += ring_step * tall)
      if (const auto ring = across.ring(along, at)) rings.push_back(*ring), at = ring->centre;
    root = rings.front().centre;
    near = root + first_ring / wrist * (rings.back().centre - root);
    for (const ArmRing& r : rings)  // a bent arm: the middle of the forearm
      if (r.along - begins <= first_ring / wrist * length) near = r.centre;
    for (ArmRing& r : rings) r.along -= begins;
    arm = {axis, rings.back().along, std::move(rings)};
    axis = unit(arm.rings.back().centre - root);
  }
  return arm;
}

}  // namespace

std::array<std::optional<Arm>, 2> find_arms(std::span<const Point> points, Faces triangles,
                                            std::span<const TorsoLevel> levels) {
  double low = INFINITY, high = -INFINITY;
  for (const Point& p : points) low = std::min(low, p.y()), high = std::max(high, p.y());
  const double tall = high - low;
  const auto next = neighbours_of(points.size(), triangles);
  const std::vector<char> leg = leg_points(points, next, levels.front().height, low + floor_band * tall);
  std::vector<int> start;
  const TorsoLevel& middle = levels[levels.size() / 2];
  if (const auto section = torso_section(points, triangles, levels, middle.height))
    for (const SectionPoint& p : section->torso.points) start.insert(start.end(), {p.a, p.b});
  const std::vector<double> way = ways_from(start, points, next, leg);
  const TorsoLevel& top = levels.back();
  std::array<std::optional<Arm>, 2> arms;
  for (int side = 0; side < 2; ++side) {
    const double sign = side ? -1 : 1;
    const Point armpit(top.centre[0] + sign * top.breadth / 2, top.height, top.centre[1]);
    int tip = -1;
    for (std::size_t i = 0; i < points.size(); ++i)
      if (sign * (points[i].x() - armpit.x()) > 0 && std::isfinite(way[i]) &&
          (tip < 0 || way[i] > way[std::size_t(tip)]))
        tip = int(i);
    if (tip < 0 || distance(points[std::size_t(tip)], armpit) < least_reach * tall) continue;
    arms[std::size_t(side)] = arm_to(points[std::size_t(tip)], armpit, tall, points, triangles);
  }
  return arms;
}

}  // namespace furrow::geometry
