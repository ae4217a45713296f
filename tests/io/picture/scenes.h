// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <cmath>
#include <functional>
#include <numbers>

#include "io/picture/render.h"

namespace furrow::tests {

/// Rows × columns of squares, each cut in two; the map gives the place of (u, v) in [0, 1]².
inline io::RenderMesh grid(int rows, int columns, const std::function<io::Position(double, double)>& place) {
  io::RenderMesh mesh;
  for (int i = 0; i <= rows; ++i) {
    for (int j = 0; j <= columns; ++j) mesh.vertices.push_back(place(double(j) / columns, double(i) / rows));
  }
  for (int i = 0; i < rows; ++i) {
    for (int j = 0; j < columns; ++j) {
      const int a = i * (columns + 1) + j, b = a + 1, c = b + columns + 1, d = a + columns + 1;
      mesh.triangles.push_back({a, b, c});
      mesh.triangles.push_back({a, c, d});
    }
  }
  return mesh;
}

/// A square of the given half side about a middle, facing +z.
inline io::RenderMesh square(io::Position middle, double half, const io::Colour& colour) {
  io::RenderMesh mesh = grid(1, 1, [&](double u, double v) {
    return io::Position{middle[0] + half * (2 * u - 1), middle[1] + half * (2 * v - 1), middle[2]};
  });
  mesh.colour = colour;
  mesh.style = io::Style::body;
  return mesh;
}

inline io::RenderMesh sphere(double radius, int rows = 96) {
  io::RenderMesh mesh = grid(rows, 2 * rows, [&](double u, double v) {
    const double longitude = 2 * std::numbers::pi * u, latitude = std::numbers::pi * (v - 0.5);
    return io::Position{radius * std::cos(latitude) * std::sin(longitude), radius * std::sin(latitude),
                        radius * std::cos(latitude) * std::cos(longitude)};
  });
  mesh.style = io::Style::body;
  return mesh;
}

/// Options of a small picture seen from straight ahead at the given distance.
inline io::RenderOptions from_the_front(int side, double distance) {
  io::RenderOptions options;
  options.width = options.height = side;
  options.quality = io::Quality::draft;
  options.threads = 1;
  options.camera = io::Camera{{0, 0, distance}, {0, 0, 0}, {0, 1, 0}, 30};
  return options;
}

inline std::array<int, 3> pixel(const io::Image& image, int column, int row) {
  const std::size_t at = 3 * (std::size_t(row) * image.width + column);
  return {image.rgb[at], image.rgb[at + 1], image.rgb[at + 2]};
}

inline std::array<int, 3> background_pixel(int row, int height) {
  const io::Colour c = io::background_colour(row, height);
  return {int(std::lround(255 * c[0])), int(std::lround(255 * c[1])), int(std::lround(255 * c[2]))};
}

inline bool is_reddish(const std::array<int, 3>& p) { return p[0] > 1.5 * p[1] && p[0] > 1.5 * p[2]; }
inline bool is_greenish(const std::array<int, 3>& p) { return p[1] > 1.5 * p[0] && p[1] > 1.5 * p[2]; }
inline bool is_bluish(const std::array<int, 3>& p) { return p[2] > 1.5 * p[0] && p[2] > 1.5 * p[1]; }

inline constexpr io::Colour pure_red{0.9f, 0.1f, 0.1f}, pure_green{0.1f, 0.9f, 0.1f},
    pure_blue{0.1f, 0.1f, 0.9f};

}  // namespace furrow::tests
