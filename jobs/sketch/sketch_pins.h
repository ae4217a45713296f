// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <array>
#include <string>
#include <vector>

#include "jobs/sketch/sketch.h"

/// Pins as a person sets them: by a border loop, or vertex by vertex. They stand in the settings' "pins" as
/// docs/scenes.md has them; what else stands there stays.
namespace furrow::jobs {

/// A border loop of a garment before its lines, longest first.
struct SketchBorder {
  std::string name;            ///< "top", "bottom", else its index
  double length = 0;           ///< [m]
  std::array<double, 3> at{};  ///< the mean of its vertices [m]
  bool held = false;           ///< all of its vertices are pinned
};
std::vector<SketchBorder> borders_of(const Sketch& sketch);

/// The border with the vertex that is nearest to a point [m]. Throws std::invalid_argument if the cloth has
/// no border. O(vertices of the borders).
std::size_t nearest_border(const Sketch& sketch, const std::array<double, 3>& point);

/// The pins with that border held, or let go. Throws std::invalid_argument if there is no such border, or if
/// pins of another kind hold it.
Json with_border(const Sketch& sketch, std::size_t border, bool held);

/// The pins with the vertex nearest to a point [m] held; where it is held, let go. Throws
/// std::invalid_argument where pins of another kind hold it, or nothing is as near as `reach` [m].
Json with_vertex_toggled(const Sketch& sketch, const std::array<double, 3>& point, double reach);

/// The pins with all these vertices held, or let go; those that are drawn lines' alone, which come after the
/// garment's own, are passed over. Throws std::invalid_argument if nothing would change.
Json with_vertices(const Sketch& sketch, const std::vector<int>& vertices, bool held);

/// The pins for a mesh that was made of the sketch's, whose vertices come first in it: border loops by the
/// index that they have there, single vertices with those that split edges between them.
Json pins_after(const Sketch& sketch, const io::MeshFile& made);

}  // namespace furrow::jobs
