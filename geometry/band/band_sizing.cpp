// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/band/band_sizing.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "physics/base/cancel_scope.h"

namespace furrow::geometry {
namespace {

constexpr double growth = 0.35;                         ///< of the edge with the distance from the band [-]
constexpr double half_band = 0.55;                      ///< of the width
constexpr double border_growth = 1;                     ///< the same with the distance from a border
constexpr double crest_ends = 0.1, flank_begins = 0.3;  ///< distances from the curve, in widths
constexpr double turn = 0.35;  ///< largest angle between two faces at the crest [rad]
constexpr double inner_share = 1.0 / 14, border_share = 1.0 / 28;  ///< least edge at a crest, in widths
/// Between folds of the same sign this far apart, in widths, lies a valley as round as their crests. Nearer
/// ones join to one fold.
constexpr double nearest_neighbour = 0.6, farthest_neighbour = 1.2;
constexpr double half_valley = 0.1, valley_rises = 0.1;  ///< of the width
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

/// With at least a share of the width, however round the crest.
double edge_at_crest(double width, double height, double share, Detail detail, double least_edge) {
  const double factor = detail == Detail::coarse ? 1.4 : detail == Detail::fine ? 0.7 : 1;
  const double radius =
      height == 0 ? std::numeric_limits<double>::infinity() : width * width / (20 * std::abs(height));
  return std::max(least_edge, factor * std::max(share * width, std::min(width / 8, turn * radius)));
}

using Boxes = std::vector<Eigen::AlignedBox3d>;

Boxes boxes_of(std::span<const FoldCurve> curves) {
  Boxes boxes(curves.size());
  for (std::size_t c = 0; c < curves.size(); ++c)
    for (const Eigen::Vector3d& p : curves[c].points) boxes[c].extend(p);
  return boxes;
}

/// Distance from a point of a curve to the nearest fold of the same sign of another line, if that is so near
/// that there is a valley between them as round as the crest; else infinity [m].
double way_to_neighbour(std::span<const FoldCurve> curves, const Boxes& boxes, const FoldCurve& curve,
                        std::size_t i) {
  const double least = nearest_neighbour * curve.width[i], most = farthest_neighbour * curve.width[i];
  double nearest = most;
  for (std::size_t c = 0; c < curves.size(); ++c) {
    if (curves[c].line == curve.line || boxes[c].exteriorDistance(curve.points[i]) >= nearest) continue;
    for (std::size_t j = 0; j < curves[c].points.size(); ++j)
      if (curves[c].height[j] * curve.height[i] > 0)
        nearest = std::min(nearest, (curves[c].points[j] - curve.points[i]).norm());
  }
  return nearest >= least && nearest < most ? nearest : std::numeric_limits<double>::infinity();
}

/// From each point along the curve to the border, infinite if no end lies on it [m].
std::vector<double> ways_to_border(const FoldCurve& curve) {
  constexpr double far = std::numeric_limits<double>::infinity();
  std::vector<double> ways(curve.points.size(), far), arc{0};
  for (std::size_t i = 1; i < curve.points.size(); ++i)
    arc.push_back(arc.back() + (curve.points[i] - curve.points[i - 1]).norm());
  for (std::size_t i = 0; i < ways.size(); ++i) {
    if (curve.begins_at_border) ways[i] = arc[i];
    if (curve.ends_at_border) ways[i] = std::min(ways[i], arc.back() - arc[i]);
  }
  return ways;
}

}  // namespace

double crest_edge(double width, double height, Detail detail, double least_edge) {
  return edge_at_crest(width, height, inner_share, detail, least_edge);
}

BandSizing::BandSizing(std::span<const FoldCurve> curves, Detail detail, double least_edge) {
  const Boxes boxes = boxes_of(curves);
  for (const FoldCurve& curve : curves) {
    const std::vector<double> to_border = ways_to_border(curve);
    std::vector<Edges> edges;
    for (std::size_t i = 0; i < curve.points.size(); ++i) {
      physics::throw_if_cancelled("wrinkle");
      const double w = curve.width[i];
      const double at_border =
          edge_at_crest(w, curve.height[i], border_share, detail, least_edge) + border_growth * to_border[i];
      const double h = std::min(crest_edge(w, curve.height[i], detail, least_edge), at_border);
      const double flank = crest_edge(w, 0, detail, least_edge);  // not as round as the crest
      const double valley = at_border < flank
                                ? way_to_neighbour(curves, boxes, curve, i) / 2 - half_valley * w
                                : std::numeric_limits<double>::infinity();
      edges.push_back({h, flank, std::min(flank, at_border), half_band * w, valley});
    }
    add_segments(curve, edges);
    on_curves_.emplace_back();
    for (const Edges& e : edges) on_curves_.back().push_back(e.crest);
  }
  if (segments_.empty()) return;
  boxes_.reserve(segments_.size());
  boxes_.emplace_back();
  build(0, 0, static_cast<int>(segments_.size()));
}

void BandSizing::add_segments(const FoldCurve& curve, const std::vector<Edges>& edges) {
  const std::size_t n = curve.points.size();
  for (std::size_t i = 0; i + (curve.closed ? 0 : 1) < n; ++i) {
    const std::size_t j = (i + 1) % n;
    segments_.push_back({point_of(curve.points[i]), point_of(curve.points[j]), edges[i], edges[j]});
  }
}

BandSizing::Box BandSizing::bounds(int first, int count) const {
  constexpr double far = std::numeric_limits<double>::infinity();
  Box box{{far, far, far}, {-far, -far, -far}, far, 0, far, 0, false, first, 0};
  for (int i = first; i < first + count; ++i) {
    const Segment& s = segments_[i];
    for (int k = 0; k < 3; ++k) {
      box.low[k] = std::min({box.low[k], s.a[k], s.b[k]});
      box.high[k] = std::max({box.high[k], s.a[k], s.b[k]});
    }
    box.least_h = std::min({box.least_h, s.at_a.crest, s.at_b.crest});
    box.most_h = std::max({box.most_h, s.at_a.crest, s.at_b.crest});
    box.least_flank = std::min({box.least_flank, s.at_a.flank, s.at_b.flank});
    box.most_reach = std::max({box.most_reach, s.at_a.reach, s.at_b.reach});
    box.has_valley = box.has_valley || std::isfinite(s.at_a.valley) || std::isfinite(s.at_b.valley);
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
  const auto at = [&](double Edges::*of) { return s.at_a.*of + t * (s.at_b.*of - s.at_a.*of); };
  // One end may know of no neighbour.
  const bool beside = std::isfinite(s.at_a.valley) && std::isfinite(s.at_b.valley);
  return {{at(&Edges::crest), at(&Edges::flank), at(&Edges::valley_edge), at(&Edges::reach),
           beside ? at(&Edges::valley) : std::numeric_limits<double>::infinity()},
          d};
}

/// As wanted(), of the least edges and the greatest width of the box; less what rounding may be.
double BandSizing::lower_bound(const Box& box, double distance) {
  constexpr double rounding = 1 - 1e-12;
  const double width = box.most_reach / half_band;
  const double off = (distance / width - crest_ends) / (flank_begins - crest_ends);
  const double share = box.has_valley ? 0 : std::clamp(off, 0.0, 1.0);
  return rounding * (box.least_h + share * (box.least_flank - box.least_h) +
                     growth * std::max(0.0, distance - box.most_reach));
}

double BandSizing::wanted(const Segment& segment, const Point& p) {
  const auto [at, distance] = nearest_of(segment, p);
  const double beyond = distance - at.reach, width = (distance - beyond) / half_band;
  const double off = (distance / width - crest_ends) / (flank_begins - crest_ends);
  const double before = (at.valley - distance) / (valley_rises * width);
  double edge = at.crest + std::clamp(off, 0.0, 1.0) * (at.flank - at.crest);
  if (before < 1) edge = std::min(edge, at.valley_edge + std::max(before, 0.0) * (at.flank - at.valley_edge));
  return edge + growth * std::max(0.0, beyond);
}

bool BandSizing::in_band(const Point& p) const {
  std::vector<int> stack;
  if (!boxes_.empty()) stack.push_back(0);
  while (!stack.empty()) {
    const Box& box = boxes_[stack.back()];
    stack.pop_back();
    if (distance_to(box.low, box.high, p) > box.most_reach + box.most_h) continue;
    for (int i = box.first; i < box.first + box.count; ++i) {
      const Nearest near = nearest_of(segments_[i], p);
      if (near.distance - near.at.reach <= near.at.crest) return true;
    }
    if (box.count == 0) stack.insert(stack.end(), {box.first, box.first + 1});
  }
  return false;
}

double BandSizing::at(const Point& p, double most) const {
  if (boxes_.empty()) return most;
  const auto least = [&](const Box& box) { return lower_bound(box, distance_to(box.low, box.high, p)); };
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
