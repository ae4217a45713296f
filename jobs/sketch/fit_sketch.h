// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "jobs/rest/fit.h"
#include "jobs/sketch/sketch.h"

namespace furrow::jobs {

/// How a sketch fits its body, as a display takes it.
struct SketchFit {
  std::vector<std::uint8_t> colours;  ///< red, green and blue of each vertex, in the order of ShownMesh
  std::string words;                  ///< strain or distance, ease, what comes through and what crosses
  std::string legend;                 ///< what the colours mean
};

/// Measures the garment as it is shown, with its strokes, by jobs::fit(). Cloth that crosses other cloth is
/// magenta. Throws std::invalid_argument where there is no body, and as fit() and draw_sketch().
SketchFit fit_sketch(const Sketch& sketch, const Json& strokes, FitColour colour, Listener& listener);

}  // namespace furrow::jobs
