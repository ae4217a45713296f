// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/picture/eye.h"

#include <Eigen/Dense>
#include <algorithm>
#include <limits>

namespace furrow::io {

using Eigen::Vector3d;

constexpr double wire_darkness = 0.45;  // what is left of the light on an edge

Eye::Eye(const PreparedScene& scene, const RayScene& rays, const Shader& shader, const RenderOptions& options)
    : scene_(scene),
      rays_(rays),
      shader_(shader),
      width_(options.width),
      height_(options.height),
      wire_pixels_(options.wire_pixels) {}

Look Eye::look(double x, double y) const {
  const auto [start, ray] = sight(x, y);
  const auto hit = rays_.nearest_surface(start, ray);
  // Half a radius in front of the surface: neither the sides of a valley nor the thickness of the cloth may
  // swallow its line.
  const double reach =
      hit ? hit->distance + 0.5 * scene_.line_radius.at(hit->distance) + 1.5 * scene_.half_thickness
          : std::numeric_limits<double>::infinity();
  Look look;
  look.is_near_thin = rays_.is_line_near(start, ray, reach);
  if (look.is_near_thin)
    if (const auto line = rays_.nearest_line(start, ray, reach)) look.line = shader_.line(ray, *line);
  if (look.line || !hit) return look;
  look.surface = shader_.see(ray, *hit);
  const double to_edge = wire_pixels_ > 0 ? to_wire(x, y, *hit) : std::numeric_limits<double>::infinity();
  if (to_edge < wire_pixels_) look.surface->reflected *= wire_darkness;
  look.is_near_thin = look.is_near_thin || to_edge < std::max(wire_pixels_, thin_reach);
  return look;
}

Eye::Sight Eye::sight(double x, double y) const {
  const PreparedCamera& c = scene_.camera;
  const double a = (x - width_ / 2.0) * 2 / height_ * c.slope, b = (1 - 2 * y / height_) * c.slope;
  const Vector3d aside = a * c.right + b * c.up;
  if (c.parallel) return {c.eye + aside, c.forward};
  return {c.eye, (c.forward + aside).normalized()};
}

/// The place of a point in the picture [pixels].
Eigen::Vector2d Eye::place(const Vector3d& p) const {
  const PreparedCamera& c = scene_.camera;
  const Vector3d d = p - c.eye;
  const double scale = height_ / 2.0 / c.slope / (c.parallel ? 1 : std::max(c.forward.dot(d), 1e-6));
  return {width_ / 2.0 + scale * c.right.dot(d), height_ / 2.0 - scale * c.up.dot(d)};
}

/// The distance to an edge of the cloth's mesh [pixels]. Rims have no edges of their own.
double Eye::to_wire(double x, double y, const SurfaceHit& hit) const {
  const PreparedMesh& mesh = scene_.meshes[hit.mesh];
  if (mesh.style != Style::cloth || (mesh.first_rim >= 0 && hit.triangle >= mesh.first_rim))
    return std::numeric_limits<double>::infinity();
  const auto& t = mesh.triangles[hit.triangle];
  const Eigen::Vector2d p(x, y);
  double least = std::numeric_limits<double>::infinity();
  for (int i = 0; i < 3; ++i) {
    const Eigen::Vector2d a = place(mesh.vertices[t[i]]), side = place(mesh.vertices[t[(i + 1) % 3]]) - a;
    const double length2 = side.squaredNorm();
    const double along = length2 > 0 ? std::clamp((p - a).dot(side) / length2, 0.0, 1.0) : 0;
    least = std::min(least, (a + along * side - p).norm());
  }
  return least;
}

}  // namespace furrow::io
