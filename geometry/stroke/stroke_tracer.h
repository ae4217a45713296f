// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <string>
#include <vector>

#include "geometry/stroke/trace_stroke.h"

namespace furrow::geometry {

/// Least barycentric of a point on the way of a stroke: it lies strictly inside its face.
inline constexpr double inside_margin = 1e-4;

/// A projected point on the way of a stroke.
struct StrokeHit {
  FacePoint point;      ///< strictly inside its face
  Point position;       ///< [m]
  double parameter;     ///< along the stroke [-]
  bool off_cloth;       ///< beyond the border by more than h/2
  bool degenerate;      ///< the projection lies on an inner edge or vertex
  Point target;         ///< the stroke's own point [m]
  bool starts = false;  ///< a new part of the stroke: not joined to the hit before
};

/// Joins hits, given in order, into sub-strokes. Used by trace_stroke alone.
class StrokeTracer {
 public:
  StrokeTracer(const Mesh& mesh, const SurfaceProjector& projector, const TraceOptions& options)
      : mesh_(mesh), projector_(projector), options_(options) {}

  /// `closed`: the last hit is joined to the first.
  void run(const std::vector<StrokeHit>& hits, bool closed, const std::string& stroke_name);
  std::vector<SubStroke> take_sub_strokes() { return std::move(sub_strokes_); }
  std::vector<std::string> take_warnings() { return std::move(warnings_); }
  std::vector<ProjectedSample> take_samples() { return std::move(samples_); }
  /// A path passed through a vertex, or nearly.
  bool degenerate() const { return degenerate_; }

  /// Makes a hit of a projection: moves it strictly inside its face.
  StrokeHit hit_at(const SurfaceHit& surface_hit, const Point& target, double parameter) const;

 private:
  void start(const StrokeHit& hit);
  void advance(const StrokeHit& from, StrokeHit to);
  bool connect(const StrokeHit& from, const StrokeHit& to, int depth, double length_limit,
               std::vector<EdgeCrossing>& path, double& length) const;
  SurfaceWalk walk(const StrokeHit& from, const StrokeHit& to, bool to_face) const;
  bool gap_between(const StrokeHit& from, const StrokeHit& to) const;
  void leave(const StrokeHit& from, const StrokeHit& towards);
  void enter(const StrokeHit& from, const StrokeHit& at);
  void append(const std::vector<EdgeCrossing>& path, const StrokeHit& from, const StrokeHit& to);
  void add_sample(const StrokeHit& hit, std::size_t index);
  void close_loop(bool complete);
  double length_limit(const StrokeHit& from, const StrokeHit& to) const;

  const Mesh& mesh_;
  const SurfaceProjector& projector_;
  TraceOptions options_;
  std::vector<SubStroke> sub_strokes_;
  std::vector<std::string> warnings_;
  std::vector<ProjectedSample> samples_;
  StrokeHit current_{};
  std::string name_;
  bool degenerate_ = false;
};

}  // namespace furrow::geometry
