// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/band/band_sizing.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace furrow::geometry {
namespace {

constexpr double growth = 0.35;                         ///< of the edge with the distance from the band [-]
constexpr double half_band = 0.55;                      ///< of the width
constexpr double crest_ends = 0.1, flank_begins = 0.3;  ///< distances from the curve, in widths
constexpr double turn = 0.35;  ///< largest angle between two faces at the crest [rad]
constexpr int leaf_size = 4;

Point point_of(const Eigen::Vector3d& p) { return {p.x(), p.y(), p.z()}; }

double distance_to(const std::array<double, 3>& low, const std::array<double, 3>& high, const Point& p) {
  double squared = 0;
  for (int k = 0; k < 3; ++k) {
    const double out = std::max({low[k] - p[k], 0.0, p[k] - high[k]});
    squared += out * out;
  }
  return std::sqrt(squared);
}

}  // namespace

double crest_edge(double width, double height, Detail detail, double least_edge) {
  const double factor = detail == Detail::coarse ? 1.4 : detail == Detail::fine ? 0.7 : 1;
  const double radius =
      height == 0 ? std::numeric_limits<double>::infinity() : width * width / (20 * std::abs(height));
  return std::max(least_edge, factor * std::max(width / 14, std::min(width / 8, turn * radius)));
}

BandSizing::BandSizing(std::span<const FoldCurve> curves, Detail detail, double least_edge) {
  for (const FoldCurve& curve : curves) {
    std::vector<double> h, flank;
    for (std::size_t i = 0; i < curve.points.size(); ++i) {
      h.push_back(crest_edge(curve.width[i], curve.height[i], detail, least_edge));
      flank.push_back(crest_edge(curve.width[i], 0, detail, least_edge));  // not as round as the crest
    }
    add_segments(curve, h, flank);
    on_curves_.push_back(std::move(h));
  }
  if (segments_.empty()) return;
  boxes_.reserve(segments_.size());
  boxes_.emplace_back();
  build(0, 0, static_cast<int>(segments_.size()));
}

void BandSizing::add_segments(const FoldCurve& curve, const std::vector<double>& h,
                              const std::vector<double>& flank) {
  const std::size_t n = curve.points.size();
  for (std::size_t i = 0; i + (curve.closed ? 0 : 1) < n; ++i) {
    const std::size_t j = (i + 1) % n;
    segments_.push_back({point_of(curve.points[i]), point_of(curve.points[j]), h[i], h[j],
                         half_band * curve.width[i], half_band * curve.width[j], flank[i], flank[j]});
  }
}

BandSizing::Box BandSizing::bounds(int first, int count) const {
  constexpr double far = std::numeric_limits<double>::infinity();
  Box box{{far, far, far}, {-far, -far, -far}, far, 0, 0, first, 0};
  for (int i = first; i < first + count; ++i) {
    const Segment& s = segments_[i];
    for (int k = 0; k < 3; ++k) {
      box.low[k] = std::min({box.low[k], s.a[k], s.b[k]});
      box.high[k] = std::max({box.high[k], s.a[k], s.b[k]});
    }
    box.least_h = std::min({box.least_h, s.h_a, s.h_b});
    box.most_h = std::max({box.most_h, s.h_a, s.h_b});
    box.most_reach = std::max({box.most_reach, s.reach_a, s.reach_b});
  }
  return box;
}

void BandSizing::build(int at, int first, int count) {
  Box box = bounds(first, count);
  if (count <= leaf_size) {
    box.count = count;
    boxes_[at] = box;
    return;
  }
  int axis = 0;
  for (int k : {1, 2})
    if (box.high[k] - box.low[k] > box.high[axis] - box.low[axis]) axis = k;
  const int half = count / 2;
  std::nth_element(
      segments_.begin() + first, segments_.begin() + first + half, segments_.begin() + first + count,
      [&](const Segment& s, const Segment& t) { return s.a[axis] + s.b[axis] < t.a[axis] + t.b[axis]; });
  box.first = static_cast<int>(boxes_.size());
  boxes_[at] = box;
  boxes_.resize(boxes_.size() + 2);
  build(box.first, first, half);
  build(box.first + 1, first + half, count - half);
}

BandSizing::Nearest BandSizing::nearest_of(const Segment& s, const Point& p) {
  const Vector along = s.b - s.a;
  const double squared = along.squared_length();
  const double t = squared > 0 ? std::clamp(((p - s.a) * along) / squared, 0.0, 1.0) : 0;
  const double d = std::sqrt((p - (s.a + t * along)).squared_length());
  const auto at = [t](double a, double b) { return a + t * (b - a); };
  return {at(s.h_a, s.h_b), at(s.flank_a, s.flank_b), d, d - at(s.reach_a, s.reach_b)};
}

double BandSizing::wanted(const Segment& segment, const Point& p) {
  const Nearest at = nearest_of(segment, p);
  const double width = (at.distance - at.beyond) / half_band;
  const double off = (at.distance / width - crest_ends) / (flank_begins - crest_ends);
  return at.h + std::clamp(off, 0.0, 1.0) * (at.flank - at.h) + growth * std::max(0.0, at.beyond);
}

bool BandSizing::in_band(const Point& p) const {
  std::vector<int> stack;
  if (!boxes_.empty()) stack.push_back(0);
  while (!stack.empty()) {
    const Box& box = boxes_[stack.back()];
    stack.pop_back();
    if (distance_to(box.low, box.high, p) > box.most_reach + box.most_h) continue;
    for (int i = box.first; i < box.first + box.count; ++i) {
      const Nearest at = nearest_of(segments_[i], p);
      if (at.beyond <= at.h) return true;
    }
    if (box.count == 0) stack.insert(stack.end(), {box.first, box.first + 1});
  }
  return false;
}

double BandSizing::at(const Point& p, double most) const {
  if (boxes_.empty()) return most;
  const auto least = [&](const Box& box) {
    return box.least_h + growth * std::max(0.0, distance_to(box.low, box.high, p) - box.most_reach);
  };
  double best = most;
  std::array<int, 64> stack;
  int size = 0;
  if (least(boxes_[0]) < best) stack[size++] = 0;
  while (size > 0) {
    const Box& box = boxes_[stack[--size]];
    if (least(box) >= best) continue;
    for (int i = box.first; i < box.first + box.count; ++i) best = std::min(best, wanted(segments_[i], p));
    if (box.count > 0) continue;
    const double left = least(boxes_[box.first]), right = least(boxes_[box.first + 1]);
    const int nearer = right < left ? 1 : 0;
    if (std::max(left, right) < best) stack[size++] = box.first + 1 - nearer;
    if (std::min(left, right) < best) stack[size++] = box.first + nearer;
  }
  return best;
}

}  // namespace furrow::geometry
