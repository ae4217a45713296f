// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <array>
#include <span>
#include <vector>

#include "geometry/insert/insertion.h"
#include "geometry/mesh/mesh.h"
#include "geometry/stroke/fold_curve.h"

namespace furrow::geometry {

/// Edge length h wanted at the crest of a fold [m], of its width and height [m]: at most 20 degrees between
/// two faces where the crest is roundest (radius R = width^2 / (20 |height|)), so h = max(width / 14,
/// min(width / 8, 0.35 R)), times the detail's factor, and at least `least_edge` [m].
double crest_edge(double width, double height, Detail detail, double least_edge);

/// The edge length wanted at a point of space: h within 0.1 width of a curve, that of a fold without height
/// (width / 8) from 0.3 width on, h again in the valley towards a fold of the same sign beside it, and beyond
/// 0.55 width 0.35 of the distance more; the least of all curves. Where a curve ends at a border, h is as
/// small as width / 22 there, since a hem shows a steep section's turns. A tree of boxes over the segments of
/// the curves: O(n log n) to build, but for n^2 of folds side by side, and about O(log n) to ask.
class BandSizing {
 public:
  BandSizing(std::span<const FoldCurve> curves, Detail detail, double least_edge);

  /// Edge length wanted at `p` [m], or `most` if that is less. The lower `most`, the faster.
  double at(const Point& p, double most) const;
  /// Whether a curve is within 0.55 of its width, and an h.
  bool in_band(const Point& p) const;
  /// h at each point of each curve [m].
  const std::vector<std::vector<double>>& on_curves() const { return on_curves_; }

 private:
  struct Edges {
    double crest, flank, valley_edge;  ///< edge lengths wanted at the crest, on flanks, in a valley [m]
    double reach;                      ///< distance from the curve up to which they are [m]
    double valley;  ///< that from which the crest's is wanted again; infinite: no fold beside it [m]
  };
  struct Segment {
    Point a, b;
    Edges at_a, at_b;
  };
  struct Box {
    std::array<double, 3> low, high;
    double least_h, most_h, least_flank, most_reach;
    bool has_valley;
    int first, count;  ///< count > 0: segments of a leaf; else children `first` and `first` + 1
  };
  void add_segments(const FoldCurve& curve, const std::vector<Edges>& edges);
  void build(int box, int first, int count);
  Box bounds(int first, int count) const;
  /// Not above the edge that any segment of the box wants at this distance from the box, or farther [m].
  static double lower_bound(const Box& box, double distance);
  struct Nearest {
    Edges at;  ///< the nearest point of a segment
    double distance;
  };
  static Nearest nearest_of(const Segment& segment, const Point& p);
  static double wanted(const Segment& segment, const Point& p);

  std::vector<std::vector<double>> on_curves_;
  std::vector<Segment> segments_;
  std::vector<Box> boxes_;
};

}  // namespace furrow::geometry
