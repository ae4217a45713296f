// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/stroke/placed_stroke.h"

#include <algorithm>
#include <cmath>

#include "geometry/mesh/edge_metric.h"
#include "geometry/mesh/errors.h"

namespace furrow::geometry {

StrokePlacing::StrokePlacing(const Mesh& mesh, const std::string& stroke_name, double max_distance)
    : name_(stroke_name.empty() ? "the stroke" : "stroke \"" + stroke_name + "\""),
      max_distance_(max_distance) {
  if (mesh.number_of_faces() == 0) throw ContentError("the mesh has no faces to draw on");
  double sum = 0;
  for (Edge e : mesh.edges()) sum += spatial_length(mesh, e);
  mean_edge_ = sum / static_cast<double>(mesh.number_of_edges());
}

void StrokePlacing::refuse(const std::string& what) const { throw ContentError(name_ + ": " + what); }

void StrokePlacing::refuse(std::size_t point, const std::string& what) const {
  throw ContentError(name_ + ", point " + std::to_string(point) + ": " + what);
}

void StrokePlacing::begin_part() { broken_ = !placed_.points.empty(); }

void StrokePlacing::add(const Point& p) {
  if (broken_) placed_.breaks.push_back(placed_.points.size());
  broken_ = false;
  placed_.points.push_back(p);
}

void StrokePlacing::add_between(std::span<const EdgeCrossing> crossings) {
  for (std::size_t i = 1; i < crossings.size(); ++i)
    add(CGAL::midpoint(crossings[i - 1].position, crossings[i].position));
}

/// trace_stroke takes a point for one beyond the border from h/2 on. Where that is farther than it lets a
/// point lie from the surface the line ends in the last face.
Point StrokePlacing::beyond_border(const Point& from, const Point& border) const {
  const double step = 0.6 * mean_edge_;
  return step < max_distance_ ? border + step * normalized(border - from) : CGAL::midpoint(from, border);
}

void StrokePlacing::add_over_border(const Point& from, std::span<const EdgeCrossing> crossings) {
  if (crossings.empty()) return;
  add_between(crossings);
  const Point& last = crossings.size() > 1 ? crossings[crossings.size() - 2].position : from;
  add(beyond_border(last, crossings.back().position));
}

void StrokePlacing::add_from_border(const Point& to, std::span<const EdgeCrossing> crossings) {
  if (crossings.empty()) return;
  const Point& last = crossings.size() > 1 ? crossings[crossings.size() - 2].position : to;
  add(beyond_border(last, crossings.back().position));
  for (std::size_t i = crossings.size(); i-- > 1;)
    add(CGAL::midpoint(crossings[i].position, crossings[i - 1].position));
}

PlacedStroke StrokePlacing::take(bool closed) {
  placed_.closed = closed && placed_.breaks.empty() && placed_.points.size() > 3;
  if (placed_.closed) placed_.points.pop_back();
  return std::move(placed_);
}

void StrokeFaults::add(const std::string& fault) {
  constexpr std::size_t most = 20;
  if (std::find(faults_.begin(), faults_.end(), fault) != faults_.end()) return;
  if (faults_.size() < most)
    faults_.push_back(fault);
  else
    ++untold_;
}

void StrokeFaults::raise() const {
  if (faults_.empty()) return;
  std::string text = faults_.front();
  for (std::size_t i = 1; i < faults_.size(); ++i) text += "\n  " + faults_[i];
  if (untold_) text += "\n  and " + std::to_string(untold_) + " more";
  throw ContentError(text);
}

}  // namespace furrow::geometry
