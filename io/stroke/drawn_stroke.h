// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <array>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "geometry/mesh/property_names.h"
#include "geometry/stroke/stroke.h"
#include "io/base/camera.h"

namespace furrow::io {

/// Drawn on a picture of the garment.
struct PictureStroke {
  CameraPicture picture;
  std::vector<std::array<double, 2>> pixels;  ///< (column, row) [pixels], as line_of_sight() counts them
};
/// Drawn in texture space.
struct TextureStroke {
  std::vector<geometry::TextureCoordinate> points;  ///< (u, v)
  std::string group;                                ///< only faces of the group of that name; empty: of any
  std::optional<geometry::Point> near;              ///< of several places the nearest to this point [m]
};
/// Drawn from vertex to vertex along shortest paths.
struct VertexStroke {
  std::vector<std::size_t> vertices;  ///< indices in the garment's file, counted from 0
};

/// A stroke as its file has it. resolve_strokes() lays it onto a garment.
struct DrawnStroke {
  geometry::Stroke stroke;  ///< its points are used where `on` holds std::monostate: drawn in space
  std::variant<std::monostate, PictureStroke, TextureStroke, VertexStroke> on = {};
};

/// "points", "pixels", "texture" or "vertices", as the files call them.
const char* kind_of(const DrawnStroke& stroke);
/// The unit of a stroke's own coordinates: "m", "pixels", "texture", or "" (vertices).
const char* unit_of(const DrawnStroke& stroke);
/// Length of the polyline as drawn, in that unit; without the jumps over its breaks. NaN for vertices.
double drawn_length(const DrawnStroke& stroke);

/// The index of the stroke of that name. Throws geometry::ContentError with the nearest name if there is
/// none, or if several have it.
std::size_t find_stroke(std::span<const DrawnStroke> strokes, const std::string& name);

/// Puts the strokes of these names first, in this order, and the others after them in their own order. Where
/// lines meet, the later one owns what they share. Throws as find_stroke(), and if a name is there twice.
void order_strokes(std::vector<DrawnStroke>& strokes, std::span<const std::string> names);

/// Moves all its points: by three numbers [m] in space, by two in a picture [pixels] or in the texture.
/// Throws std::invalid_argument for another count, numbers that are not finite, and strokes between vertices.
void move_stroke(DrawnStroke& stroke, std::span<const double> by);

}  // namespace furrow::io
