// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/figure/skeleton.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "geometry/figure/arm_search.h"
#include "geometry/mesh/errors.h"

namespace furrow::geometry {
namespace {

using Faces = std::span<const std::array<int, 3>>;

constexpr double slice_step = 0.01, ankle = 0.05;             // of the height
constexpr double neck_from = 0.80, neck_to = 0.93;            // where the neck is looked for
constexpr double outer_shoulder = 0.75, shoulder_band = 0.1;  // of half the breadth between the arms

std::array<double, 2> heights_of(std::span<const Point> points) {
  std::array<double, 2> range{INFINITY, -INFINITY};
  for (const Point& p : points) range = {std::min(range[0], p.y()), std::max(range[1], p.y())};
  return range;
}

/// Of level slices below the crotch, on one side of the trunk's middle: upwards from the ankle, then
/// downwards.
class LegSlices {
 public:
  LegSlices(std::span<const Point> points, Faces triangles, const std::array<double, 2>& middle, int side)
      : points_(points), triangles_(triangles), middle_(middle), side_(side) {}

  /// A slice around the middle of the one before it; without one, the largest of its side.
  std::optional<TrunkOutline> at(double y, const TrunkOutline* last) const {
    std::optional<TrunkOutline> best;
    double area = 0;
    for (const SectionLoop& loop : horizontal_section(points_, triangles_, y)) {
      const double x = centre_of(loop)[0] - middle_[0];
      // Thighs that are one curve are no leg's: they reach over the middle.
      if (!loop.closed || (side_ ? -x : x) <= 0 || encloses(loop, middle_[0], middle_[1])) continue;
      if (last && !encloses(loop, last->centre[0], last->centre[1])) continue;
      if (enclosed_area(loop) > area) area = enclosed_area(loop), best = outline_of(loop, y);
    }
    return best;
  }

 private:
  std::span<const Point> points_;
  Faces triangles_;
  const std::array<double, 2>& middle_;
  int side_;
};

Leg leg_of(std::span<const Point> points, Faces triangles, const Skeleton& s,
           const std::array<double, 2>& middle, int side) {
  const LegSlices slices(points, triangles, middle, side);
  const double tall = s.high - s.low;
  Leg leg;
  for (double y = s.low + ankle * tall; y < s.crotch; y += slice_step * tall)
    if (auto slice = slices.at(y, leg.slices.empty() ? nullptr : &leg.slices.back()))
      leg.slices.push_back(std::move(*slice));
  if (leg.slices.size() < 20)
    throw ContentError(
        "the body has no two legs below its crotch that could be told apart; it must stand with its legs "
        "apart, y up");
  const TrunkOutline &a = leg.slices.back(), &b = leg.slices.front();
  const Vector along(b.centre[0] - a.centre[0], b.height - a.height, b.centre[1] - a.centre[1]);
  leg.axis = along / std::sqrt(along.squared_length());
  return leg;
}

/// The narrowest slice around the trunk's middle between shoulders and chin.
TrunkOutline neck_of(std::span<const Point> points, Faces triangles, const Skeleton& s) {
  const double tall = s.high - s.low;
  std::optional<SectionLoop> best;
  double height = s.low + neck_from * tall;
  std::array<double, 2> at = s.trunk.back().centre;
  for (double y = std::max(s.armpits, height); y <= s.low + neck_to * tall; y += slice_step / 2 * tall)
    for (SectionLoop& loop : horizontal_section(points, triangles, y)) {
      if (!loop.closed || !encloses(loop, at[0], at[1])) continue;
      at = centre_of(loop);
      if (!best || tape_measure(loop) < tape_measure(*best)) best = std::move(loop), height = y;
      break;
    }
  if (!best)
    throw ContentError(
        "the body has no neck above its armpits that could be found; it must stand upright, y up");
  return outline_of(*best, height);
}

/// Half of the breadth between the arms' roots; without arms that of the uppermost slice.
double shoulder_half_of(const Skeleton& s) {
  double sum = 0;
  int count = 0;
  for (const auto& arm : s.arms)
    if (arm) sum += std::abs(arm->rings.front().centre.x() - s.trunk.back().centre[0]), ++count;
  return count ? sum / count : std::max(s.trunk.back().towards(0), s.trunk.back().towards(std::numbers::pi));
}

/// The height of the surface above the outer part of the shoulders.
double shoulders_of(std::span<const Point> points, const Skeleton& s) {
  double highest = s.armpits;  // and between armpits and neck, for figures without shoulders
  const std::array<double, 2>& c = s.trunk.back().centre;
  for (const Point& p : points)
    if (std::abs(std::abs(p.x() - c[0]) - outer_shoulder * s.shoulder_half) <
            shoulder_band * s.shoulder_half &&
        p.y() < s.neck)
      highest = std::max(highest, p.y());
  const double margin = 0.1 * (s.neck - s.armpits);
  return std::clamp(highest, s.armpits + margin, s.neck - margin);
}

/// Toes reach farther from the ankle than heels.
int facing_of(std::span<const Point> points, const Skeleton& s) {
  const double tall = s.high - s.low;
  const double ankles = (s.legs[0].slices.front().centre[1] + s.legs[1].slices.front().centre[1]) / 2;
  double front = 0, back = 0;
  for (const Point& p : points)
    if (p.y() < s.low + 0.02 * tall)
      front = std::max(front, p.z() - ankles), back = std::max(back, ankles - p.z());
  if (std::max(front, back) < 1.3 * std::min(front, back) || std::max(front, back) < 0.03 * tall) return 0;
  return front > back ? 1 : -1;
}

}  // namespace

Skeleton find_skeleton(std::span<const Point> points, Faces triangles) {
  if (points.empty()) throw ContentError("the body is empty");
  Skeleton s;
  const std::vector<TorsoLevel> levels = torso_levels(points, triangles);
  const auto [low, high] = heights_of(points);
  s.low = low, s.high = high;
  const auto heights = torso_heights(levels, s.low, s.high);
  if (!heights)
    throw ContentError(
        "the body has no torso that could be found: it must stand upright, 0.9 to 2.5 m high, y up, and its "
        "arms must not grow together with the trunk; look at `unit`, `body_unit` and `up`");
  s.crotch = levels.front().height;
  s.waist = heights->waist;
  s.armpits = levels.back().height;
  for (const TorsoLevel& level : levels)
    if (const auto section = torso_section(points, triangles, levels, level.height))
      s.trunk.push_back(outline_of(section->torso, level.height));
  for (int side = 0; side < 2; ++side)
    s.legs[std::size_t(side)] = leg_of(points, triangles, s, levels.front().centre, side);
  s.arms = find_arms(points, triangles, levels);
  s.neck_slice = neck_of(points, triangles, s);
  s.neck = s.neck_slice.height;
  s.shoulder_half = shoulder_half_of(s);
  s.shoulders = shoulders_of(points, s);
  s.faces = facing_of(points, s);
  return s;
}

}  // namespace furrow::geometry
