// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "jobs/sketch/sketch.h"

namespace furrow::jobs {

/// Where the cloth of a sketch crosses itself.
struct SketchTangles {
  std::size_t pairs = 0;              ///< of faces that cross
  std::string words;                  ///< jobs::words() of them, or that nothing crosses
  std::vector<std::uint8_t> colours;  ///< of each vertex, in the order of ShownMesh; what crosses is magenta
  std::optional<std::array<double, 3>> worst;  ///< the middle of the place with most pairs [m]
};

/// Looks for cloth that passes through cloth in the garment as it is shown. Throws as draw_sketch(). Cost:
/// some 3 us a face.
SketchTangles find_tangles(const Sketch& sketch, const Json& strokes, Listener& listener);

/// `base` [red, green, blue of each vertex, in 0 to 255] with the vertices of these faces in magenta.
std::vector<std::uint8_t> marked_crossings(const geometry::Mesh& mesh,
                                           const std::vector<geometry::Index<geometry::Face>>& faces,
                                           std::vector<std::uint8_t> base);

}  // namespace furrow::jobs
