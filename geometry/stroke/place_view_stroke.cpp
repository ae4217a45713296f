// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/stroke/place_view_stroke.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "geometry/stroke/stroke_tracer.h"

namespace furrow::geometry {
namespace {

class ViewPlacing {
 public:
  ViewPlacing(const Mesh& mesh, const SurfaceProjector& projector, std::span<const SightLine> sight,
              bool parallel, const std::string& name, double max_distance)
      : mesh_(mesh),
        projector_(projector),
        sight_(sight),
        parallel_(parallel),
        placing_(mesh, name, max_distance) {}

  PlacedStroke run(bool closed) {
    look();
    const std::size_t n = sight_.size(), steps = closed ? n + 1 : n;
    const std::size_t first = first_hit();
    for (std::size_t step = 0; step < steps; ++step) {
      // A closed stroke may start anywhere: start on cloth.
      const std::size_t i = closed ? (first + step) % n : step;
      if (step > 0) go((i + n - 1) % n, i);
      if (hits_[i]) placing_.add(hits_[i]->position);
    }
    return placing_.take(closed);
  }

 private:
  /// The hits of all lines of sight, moved strictly inside their faces.
  void look() {
    std::size_t inside = 0;
    for (std::size_t i = 0; i < sight_.size(); ++i) {
      const auto& [p, d] = sight_[i];
      if (!std::isfinite(p.x() + p.y() + p.z() + d.x() + d.y() + d.z()))
        placing_.refuse(i, "its line of sight is not finite");
      hits_.push_back(projector_.first_hit(p, d));
      if (!hits_.back()) continue;
      FacePoint& hit = hits_.back()->point;
      double sum = 0;
      for (double& b : hit.barycentrics) b = std::max(b, inside_margin), sum += b;
      for (double& b : hit.barycentrics) b /= sum;
      hits_.back()->position = position_of(mesh_, hit);
      inside += area_normal_of(mesh_, hit.face) * d > 0;
    }
    if (std::none_of(hits_.begin(), hits_.end(), [](const auto& h) { return h.has_value(); }))
      placing_.refuse(0,
                      "it and all others miss the garment; is this the camera that the picture was made "
                      "with, and the size the picture's?");
    tell_misses();
    if (inside > 0)
      placing_.warn("at " + std::to_string(inside) +
                    " of its points the picture shows the inside of the cloth");
  }

  void tell_misses() {
    for (std::size_t i = 0; i < hits_.size(); ++i) {
      std::size_t end = i;
      while (end < hits_.size() && !hits_[end]) ++end;
      if (end == i) continue;
      const std::string last = std::to_string(end - 1);
      placing_.warn((end == i + 1 ? "point " + last + " misses"
                                  : "points " + std::to_string(i) + " to " + last + " miss") +
                    " the garment: the line is cut there");
      i = end;
    }
  }

  std::size_t first_hit() const {
    return std::find_if(hits_.begin(), hits_.end(), [](const auto& h) { return h.has_value(); }) -
           hits_.begin();
  }

  /// From one line of sight to the next.
  void go(std::size_t a, std::size_t b) {
    const std::string points = std::to_string(a) + " to " + std::to_string(b);
    if (hits_[a] && hits_[b]) {
      if (hits_[a]->point.face == hits_[b]->point.face) return;
      const double chord = std::sqrt(CGAL::squared_distance(hits_[a]->position, hits_[b]->position));
      const SurfaceWalk way =
          walk(a, hits_[b]->position, hits_[b]->point.face, 3 * chord + 4 * placing_.mean_edge());
      if (way.end == SurfaceWalk::End::reached) return placing_.add_between(way.crossings);
      placing_.warn("no way along the cloth from point " + points + ": it goes on as a new part");
    }
    if (hits_[a]) {
      const auto [way, border] = in_sight(a, b);
      if (border)
        placing_.add_over_border(hits_[a]->position, way);
      else
        placing_.add_between(way);
    }
    placing_.begin_part();
    if (hits_[b]) {
      const auto [way, border] = in_sight(b, a);
      if (border) {
        placing_.add_from_border(hits_[b]->position, way);
      } else {
        for (std::size_t i = way.size(); i-- > 1;)
          placing_.add(CGAL::midpoint(way[i].position, way[i - 1].position));
      }
    }
  }

  SurfaceWalk walk(std::size_t from, const Point& target, std::optional<Face> face, double limit) const {
    const SurfaceHit& hit = *hits_[from];
    const Vector& d = sight_[from].direction;
    // The plane of sight holds both points and the line of sight of one.
    const Vector normal = area_normal_of(mesh_, hit.point.face) * d > 0 ? d : -d;
    return walk_surface(mesh_, hit.point.face, hit.position, target, normal, face, limit);
  }

  bool is_seen(const Point& p, const SightLine& like) const {
    const Vector d = parallel_ ? like.direction : normalized(p - like.origin);
    const Point origin = parallel_ ? p - ((p - like.origin) * like.direction) * like.direction : like.origin;
    const auto hit = projector_.first_hit(origin, d);
    const double depth = std::sqrt(CGAL::squared_distance(origin, p));
    return hit && std::abs(hit->distance - depth) <= 1e-6 * depth;
  }

  /// The way from hit `from` towards another line of sight as far as it can be seen; whether it ends on the
  /// border.
  std::pair<std::vector<EdgeCrossing>, bool> in_sight(std::size_t from, std::size_t towards) const {
    const SightLine &line = sight_[from], &other = sight_[towards];
    const double depth = (hits_[from]->position - line.origin) * line.direction;
    const Point target = other.origin + depth * other.direction;
    SurfaceWalk way = walk(from, target, std::nullopt, std::numeric_limits<double>::infinity());
    for (std::size_t i = 1; i < way.crossings.size(); ++i) {
      if (is_seen(CGAL::midpoint(way.crossings[i - 1].position, way.crossings[i].position), line)) continue;
      way.crossings.resize(i);
      return {way.crossings, false};
    }
    return {way.crossings, way.end == SurfaceWalk::End::border};
  }

  const Mesh& mesh_;
  const SurfaceProjector& projector_;
  std::span<const SightLine> sight_;
  bool parallel_;
  StrokePlacing placing_;
  std::vector<std::optional<SurfaceHit>> hits_;
};

}  // namespace

PlacedStroke place_view_stroke(const Mesh& mesh, const SurfaceProjector& projector,
                               std::span<const SightLine> sight, bool parallel, bool closed,
                               const std::string& stroke_name, double max_distance) {
  return ViewPlacing(mesh, projector, sight, parallel, stroke_name, max_distance).run(closed);
}

}  // namespace furrow::geometry
