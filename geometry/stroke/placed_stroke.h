// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <span>
#include <string>
#include <vector>

#include "geometry/stroke/stroke.h"
#include "geometry/stroke/trace_stroke.h"
#include "geometry/stroke/walk_surface.h"

namespace furrow::geometry {

/// A stroke that was drawn on a picture, in texture space or between vertices, laid onto the surface: at
/// least one point in each face that it crosses. Where it runs over the border of the mesh its last point
/// lies beyond it, so that the line reaches the border (trace_stroke.h).
struct PlacedStroke {
  std::vector<Point> points;        ///< [m]
  std::vector<std::size_t> breaks;  ///< as Stroke::breaks
  bool closed = false;              ///< a closed stroke that is broken is an open one of several parts
  std::vector<std::string> warnings;
};

/// What is wrong with several strokes, told at once: the first fault as it is, each other one on a line of
/// its own, at most twenty.
class StrokeFaults {
 public:
  /// Passes over what is told already.
  void add(const std::string& fault);
  /// Throws ContentError if there is one.
  void raise() const;

 private:
  std::vector<std::string> faults_;
  std::size_t untold_ = 0;
};

/// Builds a PlacedStroke part by part. Used by place_view_stroke, place_texture_stroke, place_path_stroke.
class StrokePlacing {
 public:
  /// `max_distance` is how far trace_stroke will let a point lie from the surface [m], so that none that is
  /// made beyond the border lies farther. Throws ContentError for a mesh without edges.
  StrokePlacing(const Mesh& mesh, const std::string& stroke_name,
                double max_distance = TraceOptions{}.max_distance);

  /// The next point, of a new part after begin_part().
  void add(const Point& p);
  /// Mid-points of the ways inside the faces between crossings that follow each other.
  void add_between(std::span<const EdgeCrossing> crossings);
  /// The way from `from`, in the face that the first crossing leaves, over the crossings, the last of which
  /// lies on the border, and on beyond it.
  void add_over_border(const Point& from, std::span<const EdgeCrossing> crossings);
  /// The same the other way round, from beyond the border to `to`, which itself is not added.
  void add_from_border(const Point& to, std::span<const EdgeCrossing> crossings);
  void begin_part();
  void warn(const std::string& what) { placed_.warnings.push_back(name_ + ": " + what); }
  [[noreturn]] void refuse(const std::string& what) const;
  [[noreturn]] void refuse(std::size_t point, const std::string& what) const;

  double mean_edge() const { return mean_edge_; }  ///< as it is in space [m]
  /// The result; of a stroke that came back to its start (`closed`) the last point is the first again.
  PlacedStroke take(bool closed);

 private:
  Point beyond_border(const Point& from, const Point& border) const;
  std::string name_;
  double mean_edge_ = 0, max_distance_;
  bool broken_ = false;
  PlacedStroke placed_;
};

}  // namespace furrow::geometry
