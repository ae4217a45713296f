// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/stroke/stroke_tracer.h"

#include <algorithm>
#include <cmath>

namespace furrow::geometry {
namespace {

constexpr double degenerate_area =
    1e-6;  ///< a barycentric, or a position on an edge, that counts as on the end
constexpr int bisections = 8;
constexpr std::size_t most_around = 8;  ///< edges around a vertex

double distance(const Point& a, const Point& b) { return std::sqrt(CGAL::squared_distance(a, b)); }

CrossedFace visit_of(Face face, double parameter) {
  CrossedFace visit;
  visit.face = face;
  visit.stroke_parameter = parameter;
  return visit;
}

EdgeCrossing seen_from_beyond(const Mesh& mesh, const EdgeCrossing& x) {
  return {mesh.opposite(x.halfedge), 1 - x.t, x.position};
}

}  // namespace

StrokeHit StrokeTracer::hit_at(const SurfaceHit& hit, const Point& target, double parameter) const {
  StrokeHit result{hit.point, hit.position, parameter, hit.beyond_border > 0.5 * options_.mean_edge,
                   false,     target,       false};
  Barycentrics& b = result.point.barycentrics;
  result.degenerate = !hit.on_border && *std::min_element(b.begin(), b.end()) < degenerate_area;
  double excess = 0;
  for (double& value : b) value = std::max(value - inside_margin, 0.0), excess += value;
  for (double& value : b) value = inside_margin + value * (1 - 3 * inside_margin) / excess;
  result.position = position_of(mesh_, result.point);
  return result;
}

double StrokeTracer::length_limit(const StrokeHit& from, const StrokeHit& to) const {
  return 3 * distance(from.position, to.position) + 4 * options_.mean_edge;
}

SurfaceWalk StrokeTracer::walk(const StrokeHit& from, const StrokeHit& to, bool to_face) const {
  Vector normal = normalized(area_normal_of(mesh_, from.point.face));
  if (to_face) normal = normal + normalized(area_normal_of(mesh_, to.point.face));
  const Point& target = to_face ? to.position : to.target;
  return walk_surface(mesh_, from.point.face, from.position, target, normal,
                      to_face ? std::optional(to.point.face) : std::nullopt,
                      3 * distance(from.position, target) + 4 * options_.mean_edge);
}

bool StrokeTracer::connect(const StrokeHit& from, const StrokeHit& to, int depth, double limit,
                           std::vector<EdgeCrossing>& path, double& length) const {
  if (from.point.face == to.point.face) return true;
  const SurfaceWalk direct = walk(from, to, true);
  if (direct.end == SurfaceWalk::End::reached) {
    path.insert(path.end(), direct.crossings.begin(), direct.crossings.end());
    length += direct.length;
    return length <= limit;
  }
  const Point middle = CGAL::midpoint(from.position, to.position);
  if (depth == 0) {
    // So short a step may still fail beside a notch of the border: go round the notch's vertex.
    const auto round = fewest_crossings(mesh_, from.point.face, to.point.face, middle, most_around);
    path.insert(path.end(), round.begin(), round.end());
    return !round.empty();
  }
  const double radius = 0.75 * distance(from.position, to.position) + 2 * options_.mean_edge;
  const auto nearby = faces_reachable_within(mesh_, from.point.face, middle, radius);
  const StrokeHit half =
      hit_at(projector_.closest_among(middle, nearby), middle, 0.5 * (from.parameter + to.parameter));
  if (half.off_cloth) return false;
  return connect(from, half, depth - 1, limit, path, length) &&
         connect(half, to, depth - 1, limit, path, length);
}

bool StrokeTracer::gap_between(const StrokeHit& from, const StrokeHit& to) const {
  const Point middle = CGAL::midpoint(from.position, to.position);
  return walk(from, to, true).end == SurfaceWalk::End::border &&
         hit_at(projector_.closest(middle), middle, 0).off_cloth;
}

void StrokeTracer::start(const StrokeHit& hit) {
  sub_strokes_.emplace_back().faces.push_back(visit_of(hit.point.face, hit.parameter));
  current_ = hit;
}

void StrokeTracer::append(const std::vector<EdgeCrossing>& path, const StrokeHit& from, const StrokeHit& to) {
  auto& faces = sub_strokes_.back().faces;
  const Vector chord = to.position - from.position;
  const double squared = std::max(chord.squared_length(), 1e-300);
  for (const EdgeCrossing& x : path) {
    degenerate_ = degenerate_ || x.t < degenerate_area || x.t > 1 - degenerate_area;
    faces.back().exit = x;
    const Halfedge beyond = mesh_.opposite(x.halfedge);
    if (mesh_.is_border(beyond)) return;
    const double along = std::clamp(((x.position - from.position) * chord) / squared, 0.0, 1.0);
    faces.push_back(visit_of(mesh_.face(beyond), from.parameter + along * (to.parameter - from.parameter)));
    faces.back().entry = seen_from_beyond(mesh_, x);
  }
}

void StrokeTracer::add_sample(const StrokeHit& hit, std::size_t index) {
  samples_.push_back({hit.position, hit.point, index});
  CrossedFace& visit = sub_strokes_.back().faces.back();
  for (int i = 0; i < 3; ++i) visit.node[i] += hit.point.barycentrics[i];
  visit.stroke_parameter =
      visit.samples == 0 ? hit.parameter : 0.5 * (visit.stroke_parameter + hit.parameter);
  ++visit.samples;
}

void StrokeTracer::leave(const StrokeHit& from, const StrokeHit& towards) {
  append(walk(from, towards, false).crossings, from, towards);
}

/// The sub-stroke starts at the border, where the way back from `at` towards `from` leaves the cloth.
void StrokeTracer::enter(const StrokeHit& from, const StrokeHit& at) {
  const auto back = walk(at, from, false).crossings;
  auto& faces = sub_strokes_.emplace_back().faces;
  for (auto x = back.rbegin(); x != back.rend(); ++x) {
    const EdgeCrossing beyond = seen_from_beyond(mesh_, *x);
    if (mesh_.is_border(beyond.halfedge)) continue;
    faces.push_back(visit_of(mesh_.face(beyond.halfedge), at.parameter));
    faces.back().exit = beyond;
    if (x != back.rbegin()) faces.back().entry = *(x - 1);
  }
  faces.push_back(visit_of(at.point.face, at.parameter));
  if (!back.empty()) faces.back().entry = back.front();
  current_ = at;
}

void StrokeTracer::advance(const StrokeHit& from, StrokeHit to) {
  if (from.point.face == to.point.face) {
    current_ = to;
    return;
  }
  const SurfaceWalk direct = walk(from, to, true);
  if (direct.end == SurfaceWalk::End::reached) {
    append(direct.crossings, from, to);
    current_ = to;
    return;
  }
  if (gap_between(from, to)) {
    leave(from, to);
    enter(from, to);
    return;
  }
  const double radius = 1.5 * distance(from.position, to.target) + 2 * options_.mean_edge;
  const auto nearby = faces_reachable_within(mesh_, from.point.face, from.position, radius);
  const SurfaceHit closest = projector_.closest_among(to.target, nearby);
  if (closest.distance <= options_.max_distance) {
    const StrokeHit local = hit_at(closest, to.target, to.parameter);
    std::vector<EdgeCrossing> path;
    double length = 0;
    if (connect(from, local, bisections, length_limit(from, local), path, length)) {
      append(path, from, local);
      current_ = local;
      return;
    }
  }
  const bool border = direct.end == SurfaceWalk::End::border;
  if (border) leave(from, to);
  warnings_.push_back(name_ + ": broken at " + std::to_string(to.parameter) +
                      " of its length: no way along the cloth");
  if (border) {
    enter(from, to);
  } else {
    start(to);
  }
}

/// Joins the last sub-stroke, which has come back to the first hit, to the first one.
void StrokeTracer::close_loop(bool complete) {
  SubStroke &first = sub_strokes_.front(), &last = sub_strokes_.back();
  if (!complete || last.faces.back().face != first.faces.front().face || first.faces.front().entry) return;
  if (sub_strokes_.size() == 1) {
    if (first.faces.size() == 1) return;
    first.faces.front().entry = last.faces.back().entry;
    first.faces.pop_back();
    first.closed = first.faces.size() > 2;
    return;
  }
  first.faces.front().entry = last.faces.back().entry;
  first.faces.insert(first.faces.begin(), last.faces.begin(), last.faces.end() - 1);
  sub_strokes_.pop_back();
}

void StrokeTracer::run(const std::vector<StrokeHit>& hits, bool closed, const std::string& name) {
  name_ = name;
  const auto on = std::find_if(hits.begin(), hits.end(), [](const StrokeHit& h) { return !h.off_cloth; });
  // A closed stroke may start anywhere: start on cloth.
  const std::size_t n = hits.size(), offset = closed ? static_cast<std::size_t>(on - hits.begin()) : 0;
  const std::size_t steps = closed && n > 1 ? n + 1 : n;
  bool on_cloth = false;
  for (std::size_t i = 0; i < steps; ++i) {
    const StrokeHit& hit = hits[(offset + i) % n];
    const StrokeHit* previous = i > 0 ? &hits[(offset + i - 1) % n] : nullptr;
    if (hit.starts) on_cloth = false;
    if (hit.off_cloth) {
      if (on_cloth) leave(current_, hit);
      on_cloth = false;
      continue;
    }
    if (on_cloth) {
      advance(StrokeHit(current_), hit);
    } else if (previous && !hit.starts) {
      enter(*previous, hit);
    } else {
      start(hit);
    }
    on_cloth = true;
    if (i < n) add_sample(current_, (offset + i) % n);
  }
  if (closed && n > 1) close_loop(on_cloth);
}

}  // namespace furrow::geometry
