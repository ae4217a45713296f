// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "jobs/sketch/sketch.h"

namespace furrow::jobs {

/// Where a sketch is heavy, as a display takes it.
struct SketchMass {
  std::vector<std::uint8_t> colours;  ///< red, green and blue of each vertex, in the order of ShownMesh
  std::string words;                  ///< the whole mass, and the range of the vertices'
  std::string legend;                 ///< what the colours mean
};

/// Masses that vertices have at rest (geometry/rest/masses.h), of the garment with its strokes in its fabric.
/// Throws as draw_sketch() and lump_masses().
SketchMass mass_of_sketch(const Sketch& sketch, const Json& strokes, Listener& listener);

}  // namespace furrow::jobs
