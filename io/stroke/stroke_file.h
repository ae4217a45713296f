// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <array>
#include <filesystem>
#include <iosfwd>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "geometry/stroke/stroke.h"
#include "io/base/camera.h"
#include "io/mesh/mesh_file.h"

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
  std::optional<geometry::Coordinates<geometry::Point>>
      near;  ///< of several places the nearest to this point [m]
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

/// Reads strokes by the file name's ending, json or obj. Points and directions are turned, and points scaled,
/// by `options`; heights, widths and cameras are in metres, y up, always. Strict: unknown keys, wrong types
/// and numbers that are not finite are errors. obj: the polylines (`l` elements, two-point ones of an object
/// chained), with the name of their object (`o`, else `g`), whose words h=15mm and w=60mm are height and
/// width of its lines; without, they have the default height. Throws geometry::ContentError with the place in
/// the text, or the stroke's index and key; also if there is no stroke. Throws std::invalid_argument if
/// default_height [m] is not finite.
///
/// \details json is
///     {"strokes": [{"name": "…", "height": 0.02, "width": 0.06, "sharpness": 0.5, "press": 1,
///                   "taper": 0.05, "flare": true, "smooth": 1, "set": 0.5, "gather": 0.7, "closed": false,
///                   …}, …]}
/// "height" and "width" may be lists with a number for each point, "taper" one of two lengths.
/// Each stroke must have one of these (a closed stroke at least three items); the other keys may be missing.
/// - "points": [[x, y, z], …], with "direction": [x, y, z] and "breaks": [index, …];
/// - "pixels": [[column, row], …], with "camera": an object or the name of a file (camera_file.h) beside this
///   one; a "camera" beside "strokes" serves all;
/// - "texture": [[u, v], …], with "group": "…" and "near": [x, y, z];
/// - "vertices": [index, …], counted from 0.
std::vector<DrawnStroke> read_drawn_strokes(const std::filesystem::path& path, double default_height = 0.01,
                                            const ReadOptions& options = {});
/// The same for the text of a json file, which may hold no stroke; `name` stands in messages.
std::vector<DrawnStroke> drawn_strokes_from(std::string_view json, const std::string& name,
                                            const ReadOptions& options = {});
/// The same for a file whose strokes are all drawn in space ("points"); any other stroke is an error.
std::vector<geometry::Stroke> read_strokes(const std::filesystem::path& path, double default_height = 0.01,
                                           const ReadOptions& options = {});

/// Writes strokes as JSON (whatever the ending), in double precision, cameras included, replacing the file if
/// it is there. Throws std::invalid_argument, nothing written, for numbers that are not finite and strokes
/// without points; std::runtime_error if the file cannot be written.
void write_strokes(const std::filesystem::path& path, const std::vector<DrawnStroke>& strokes,
                   const WriteOptions& options = {});
void write_strokes(std::ostream& out, const std::vector<DrawnStroke>& strokes,
                   const WriteOptions& options = {});
void write_strokes(const std::filesystem::path& path, const std::vector<geometry::Stroke>& strokes,
                   const WriteOptions& options = {});
void write_strokes(std::ostream& out, const std::vector<geometry::Stroke>& strokes,
                   const WriteOptions& options = {});

}  // namespace furrow::io
