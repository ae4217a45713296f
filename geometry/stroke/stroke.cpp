// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/stroke/stroke.h"

#include <cmath>

#include "geometry/mesh/property_names.h"

namespace furrow::geometry {

LineShapes line_shapes(std::span<const Stroke> strokes, int first_line) {
  LineShapes shapes{std::vector<double>(static_cast<std::size_t>(first_line), 1),
                    std::vector<double>(static_cast<std::size_t>(first_line), unset_value)};
  for (const Stroke& stroke : strokes) {
    shapes.presses.push_back(stroke.press);
    shapes.widths.push_back(stroke.width.value_or(unset_value));
  }
  return shapes;
}

std::string shape_fault(const Stroke& stroke) {
  const auto fault = [](const char* key, double value, const char* range) {
    return "'" + std::string(key) + "' = " + std::to_string(value) + " must be " + range;
  };
  if (stroke.width && (!(*stroke.width > 0) || !std::isfinite(*stroke.width)))
    return fault("width", *stroke.width, "> 0 (metres)");
  if (stroke.sharpness && !(*stroke.sharpness >= 0 && *stroke.sharpness <= 1))
    return fault("sharpness", *stroke.sharpness, "in [0, 1]");
  if (!(stroke.press >= 1 && stroke.press <= 1e6)) return fault("press", stroke.press, "in [1, 1e6]");
  for (double h : stroke.heights)
    if (!std::isfinite(h)) return fault("height", h, "finite (metres)");
  for (double w : stroke.widths)
    if (!(w > 0) || !std::isfinite(w)) return fault("width", w, "> 0 (metres)");
  if (stroke.taper)
    for (double t : *stroke.taper)
      if (!(t >= 0) || !std::isfinite(t)) return fault("taper", t, ">= 0 (metres)");
  if (!(stroke.smooth >= 0 && stroke.smooth <= 10)) return fault("smooth", stroke.smooth, "in [0, 10]");
  if (!(stroke.set >= 0 && stroke.set <= 1)) return fault("set", stroke.set, "in [0, 1]");
  return "";
}

}  // namespace furrow::geometry
