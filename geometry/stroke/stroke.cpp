// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/stroke/stroke.h"

#include <cmath>

#include "geometry/mesh/preconditions.h"
#include "geometry/mesh/property_names.h"

namespace furrow::geometry {

LineShapes line_shapes(std::span<const Stroke> strokes, int first_line) {
  if (first_line < 0 || first_line > most_lines)
    refuse("line_shapes", "first_line must be in [0, " + std::to_string(most_lines) + "], not " +
                              std::to_string(first_line));
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
  constexpr double widest = 1000;  // [m]; a fold takes memory by its width
  const auto width_fault = [&](double w) {
    if (!(w > 0) || !std::isfinite(w)) return fault("width", w, "> 0 (metres)");
    return w > widest ? fault("width", w, "at most 1000 (metres)") : "";
  };
  std::vector<double> widths = stroke.widths;
  if (stroke.width) widths.push_back(*stroke.width);
  for (const double w : widths)
    if (const std::string wrong = width_fault(w); !wrong.empty()) return wrong;
  if (stroke.sharpness && !(*stroke.sharpness >= 0 && *stroke.sharpness <= 1))
    return fault("sharpness", *stroke.sharpness, "in [0, 1]");
  if (!(stroke.press >= 1 && stroke.press <= 1e6)) return fault("press", stroke.press, "in [1, 1e6]");
  std::vector<double> heights = stroke.heights;
  heights.push_back(stroke.height);
  for (double h : heights)
    if (!std::isfinite(h)) return fault("height", h, "finite (metres)");
  if (stroke.taper)
    for (double t : *stroke.taper)
      if (!(t >= 0) || !std::isfinite(t)) return fault("taper", t, ">= 0 (metres)");
  if (!(stroke.smooth >= 0 && stroke.smooth <= 10)) return fault("smooth", stroke.smooth, "in [0, 10]");
  if (!(stroke.set >= 0 && stroke.set <= 1)) return fault("set", stroke.set, "in [0, 1]");
  if (stroke.gather && !(*stroke.gather >= 0.1 && *stroke.gather <= 1))
    return fault("gather", *stroke.gather, "in [0.1, 1], a share of the line's length");
  return "";
}

}  // namespace furrow::geometry
