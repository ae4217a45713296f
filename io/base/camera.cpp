// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/base/camera.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <string>

#include "geometry/stroke/place_view_stroke.h"

namespace furrow::io {
namespace {

using Eigen::Vector3d;

constexpr double degree = std::numbers::pi / 180;

void check_range(const char* name, double value, double low, double high) {
  if (!(value >= low && value <= high)) {
    throw std::invalid_argument(std::string(name) + ": " + std::to_string(value) + " is not in [" +
                                std::to_string(low) + ", " + std::to_string(high) + "]");
  }
}

/// Largest value of coordinate − slope · depth and of −coordinate − slope · depth: where two opposite sides
/// of the pyramid of sight rest on the points.
struct Support {
  double plus = -std::numeric_limits<double>::infinity();
  double minus = -std::numeric_limits<double>::infinity();
  void add(double coordinate, double depth, double slope) {
    plus = std::max(plus, coordinate - slope * depth);
    minus = std::max(minus, -coordinate - slope * depth);
  }
  double apex_depth(double slope) const { return -(plus + minus) / (2 * slope); }
  double apex_coordinate() const { return (plus - minus) / 2; }
};

Vector3d vector(const Position& p) { return {p[0], p[1], p[2]}; }

}  // namespace

void check(const CameraPicture& picture) {
  const Camera& c = picture.camera;
  for (const Position* p : {&c.eye, &c.target, &c.up})
    if (!vector(*p).allFinite())
      throw std::invalid_argument("camera: a number of eye, target or up is not finite");
  check_range("camera: width", picture.width, 1, 16384);
  check_range("camera: height", picture.height, 1, 16384);
  check_range("camera: field of view", c.field_of_view_deg, 1, 150);
  if (c.parallel_height && !(*c.parallel_height > 0 && std::isfinite(*c.parallel_height)))
    throw std::invalid_argument("camera: the height of a parallel picture must be > 0 m, not " +
                                std::to_string(*c.parallel_height));
  const Vector3d sight = vector(c.target) - vector(c.eye), up = vector(c.up);
  if (!(sight.norm() > 0)) throw std::invalid_argument("camera: eye and target are at one place");
  if (!(sight.cross(up).norm() > 1e-6 * sight.norm() * up.norm()))
    throw std::invalid_argument("camera: up is zero or lies along the line of sight");
}

geometry::SightLine line_of_sight(const CameraPicture& picture, double column, double row) {
  const Camera& c = picture.camera;
  const Vector3d forward = (vector(c.target) - vector(c.eye)).normalized();
  const Vector3d right = forward.cross(vector(c.up)).normalized(), up = right.cross(forward);
  const double half = c.parallel_height ? *c.parallel_height / 2 : std::tan(c.field_of_view_deg / 2 * degree);
  const double x = (column + 0.5 - picture.width / 2.0) * 2 / picture.height * half;
  const double y = (1 - 2 * (row + 0.5) / picture.height) * half;
  const Vector3d aside = x * right + y * up, eye = vector(c.eye);
  const Vector3d origin = c.parallel_height ? Vector3d(eye + aside) : eye;
  const Vector3d direction = c.parallel_height ? forward : Vector3d((forward + aside).normalized());
  return {{origin.x(), origin.y(), origin.z()}, {direction.x(), direction.y(), direction.z()}};
}

Camera frame_points(const std::vector<Position>& points, double aspect, const View& view) {
  check_range("aspect", aspect, 0.01, 100);
  check_range("azimuth_deg", view.azimuth_deg, -1e6, 1e6);
  check_range("elevation_deg", view.elevation_deg, -85, 85);
  check_range("field_of_view_deg", view.field_of_view_deg, 1, 150);
  check_range("margin", view.margin, 0, 0.45);
  if (points.empty()) throw std::invalid_argument("points: none to frame");
  const double azimuth = view.azimuth_deg * degree, elevation = view.elevation_deg * degree;
  const Vector3d forward = -Vector3d(std::sin(azimuth) * std::cos(elevation), std::sin(elevation),
                                     std::cos(azimuth) * std::cos(elevation));
  const Vector3d right = forward.cross(Vector3d::UnitY()).normalized();
  const Vector3d up = right.cross(forward);
  const double slope_y = std::tan(view.field_of_view_deg / 2 * degree) * (1 - 2 * view.margin);
  const double slope_x = slope_y * aspect;

  Support horizontal, vertical;
  Vector3d low = Vector3d::Constant(std::numeric_limits<double>::infinity()), high = -low;
  for (const Position& position : points) {
    const Vector3d p = vector(position);
    if (!p.allFinite()) throw std::invalid_argument("points: a coordinate is not finite");
    horizontal.add(right.dot(p), forward.dot(p), slope_x);
    vertical.add(up.dot(p), forward.dot(p), slope_y);
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  const double size = (high - low).norm();
  if (!(size > 0)) throw std::invalid_argument("points: all at one place, nothing to frame");
  const Vector3d middle = (low + high) / 2;
  // At least a tenth of the size before the foremost point: a line along the sight would put the eye on its
  // end.
  const double depth = std::min(
      {horizontal.apex_depth(slope_x), vertical.apex_depth(slope_y), forward.dot(middle) - size * 0.6});
  const Vector3d eye =
      horizontal.apex_coordinate() * right + vertical.apex_coordinate() * up + depth * forward;
  const Vector3d target = eye + (forward.dot(middle) - depth) * forward;
  return {
      {eye.x(), eye.y(), eye.z()}, {target.x(), target.y(), target.z()}, {0, 1, 0}, view.field_of_view_deg};
}

}  // namespace furrow::io
