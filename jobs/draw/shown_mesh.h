// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "geometry/mesh/mesh.h"

namespace furrow::jobs {

/// Of an edge across which the texture differs, and of no line.
inline constexpr std::int32_t seam_edge = std::numeric_limits<std::int32_t>::min();

/// An edge of a drawn line, and whose; or of a seam.
struct ShownEdge {
  std::uint32_t from, to;
  std::int32_t line;  ///< index among the lines that are shown; or seam_edge
};

/// A mesh as a display takes it.
struct ShownMesh {
  std::vector<float> positions;  ///< three numbers a vertex [m]
  /// Where each vertex would lie without the heights of its lines [m]: strokes are drawn on that surface.
  std::vector<float> undrawn;
  std::vector<std::uint32_t> faces;  ///< three vertices each
  std::vector<ShownEdge> edges;
  std::vector<std::uint32_t> pinned;  ///< vertices that are held
};

/// `undrawn`: a point for each vertex, or empty where they lie there. Lines count from `first_line` on. O(n).
ShownMesh shown_mesh(const geometry::Mesh& mesh,
                     std::span<const geometry::Coordinates<geometry::Point>> undrawn = {},
                     int first_line = 0);

}  // namespace furrow::jobs
