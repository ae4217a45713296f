// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <cmath>
#include <optional>
#include <stdexcept>

#include "geometry/mesh/mesh.h"
#include "io/mesh/mesh_file.h"

/// A file's unit and axes against ours (metres, y up).
namespace furrow::io {

/// Coordinates beyond this [m] are taken for damage: nobody's garment is a million kilometres wide.
inline constexpr double largest_coordinate = 1e9;

inline void check_unit(double metres_per_unit) {
  if (!(metres_per_unit > 0) || !std::isfinite(metres_per_unit))
    throw std::invalid_argument("metres_per_unit must be > 0 and finite, is " +
                                std::to_string(metres_per_unit));
}

/// A direction of the file in our axes.
inline geometry::Vector turned_from_file(const geometry::Vector& v, Axis up) {
  return up == Axis::y ? v : geometry::Vector(v.x(), v.z(), -v.y());
}

/// A position of the file in metres, y up; nothing if it is not finite or beyond largest_coordinate.
inline std::optional<geometry::Point> from_file(double x, double y, double z, const ReadOptions& options) {
  const double s = options.metres_per_unit;
  const geometry::Vector p = turned_from_file({x * s, y * s, z * s}, options.up);
  for (int i = 0; i < 3; ++i)
    if (!(std::abs(p[i]) <= largest_coordinate)) return std::nullopt;
  return CGAL::ORIGIN + p;
}

/// What an error says where from_file() gives nothing.
inline constexpr const char* bad_coordinate =
    "a coordinate is not finite or beyond 1e9 m; correct it or choose the file's unit";

/// A position of ours in the file's unit and axes.
inline geometry::Vector to_file(const geometry::Point& p, const WriteOptions& options) {
  const double s = options.metres_per_unit;
  const geometry::Vector v(p.x() / s, p.y() / s, p.z() / s);
  return options.up == Axis::y ? v : geometry::Vector(v.x(), -v.z(), v.y());
}

}  // namespace furrow::io
