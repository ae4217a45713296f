// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <array>
#include <optional>
#include <vector>

namespace furrow::geometry {
struct SightLine;
}

namespace furrow::io {

using Position = std::array<double, 3>;  ///< (x, y, z) [m]; y up, the front of a person looks along +z

/// A pinhole camera with a perspective picture, or one whose lines of sight are parallel.
struct Camera {
  Position eye{0, 0, 3};          ///< where it stands [m]
  Position target{0, 0, 0};       ///< what lies in the middle of the picture [m]; not the eye
  Position up{0, 1, 0};           ///< points up in the picture; not along the line of sight
  double field_of_view_deg = 28;  ///< vertical opening [degrees], in [1, 150]
  /// Parallel lines of sight (orthographic): the height of the picture [m], > 0; the opening is then not
  /// used. Even then only what lies before the eye is seen.
  std::optional<double> parallel_height = {};
};

/// A picture that a camera has made.
struct CameraPicture {
  Camera camera;
  int width = 1200, height = 1200;  ///< [pixels], in [1, 16384]
};
/// Throws std::invalid_argument, which names the value that is out of its range.
void check(const CameraPicture& picture);

/// The line of sight through a place of the picture. (column, row) of a pixel, counted from 0 at the upper
/// left, is its middle, as viewers show it; fractions lie between. check() must have passed.
geometry::SightLine line_of_sight(const CameraPicture& picture, double column, double row);

/// Where the automatic camera looks from.
struct View {
  double azimuth_deg = 25;        ///< 0: from the front (+z), 90: from +x [degrees], finite
  double elevation_deg = 8;       ///< above the horizon [degrees], in [-85, 85]
  double field_of_view_deg = 28;  ///< vertical opening [degrees], in [1, 150]
  double margin = 0.06;           ///< empty part of the picture at each border, in [0, 0.45]
};

/// The nearest camera in that direction which sees all points inside the margins, in the middle between them:
/// each side of the pyramid of sight touches its support point, solved in closed form. `aspect` = width /
/// height of the picture, in [0.01, 100]. Cost: linear in the points. Throws std::invalid_argument for no
/// points, points that all coincide, or a value out of its range.
Camera frame_points(const std::vector<Position>& points, double aspect, const View& view = {});

}  // namespace furrow::io
