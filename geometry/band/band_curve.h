// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <map>
#include <vector>

#include "geometry/mesh/mesh.h"
#include "geometry/stroke/fold_curve.h"

namespace furrow::geometry {

/// A fold's curve as a polyline that knows its arc length, and the vertices that lie on it so far.
class BandCurve {
 public:
  /// `h`: edge length wanted at each point [m].
  BandCurve(const FoldCurve& curve, std::vector<double> h);

  int line() const { return line_; }

  struct Near {
    double along = 0;     ///< arc length of the nearest point [m]
    double distance = 0;  ///< [m]
  };
  bool closed() const { return closed_; }
  double length() const { return arc_.back(); }
  std::size_t segments() const { return arc_.size() - 1; }
  double arc(std::size_t i) const { return arc_[i]; }
  const Point& point(std::size_t i) const { return points_[i]; }
  Point at(double along) const;
  double h_at(double along) const;
  /// In [0, length): closed curves go on from the beginning.
  double wrapped(double along) const;
  /// The way from one place to another in the curve's direction, of a closed curve in [0, length) [m].
  double ahead(double from, double to) const;
  /// Segment i holds that place.
  std::size_t segment_at(double along) const;
  /// The nearest point of segments first to last, counted on beyond the last one if closed.
  Near nearest(const Point& p, std::ptrdiff_t first, std::ptrdiff_t last) const;
  /// The nearest point within `span` of arc length on either side of `along`.
  Near nearest(const Point& p, double along, double span) const;

  std::map<double, Vertex> vertices;  ///< those on the curve, by arc length

 private:
  int line_;
  bool closed_;
  std::vector<Point> points_;  ///< of a closed curve, the first one again at the end
  std::vector<double> arc_, h_;
};

}  // namespace furrow::geometry
