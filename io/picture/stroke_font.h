// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <array>
#include <string_view>
#include <vector>

#include "io/picture/png_file.h"
#include "io/picture/render.h"

namespace furrow::io {

/// A letter as pen strokes. Units: capitals are 12 high above the baseline at y = 0; y points up.
struct Glyph {
  std::vector<std::vector<std::array<double, 2>>> strokes;  ///< polylines; one repeated point is a dot
  double advance = 0;                                       ///< from this letter's left to the next one's
};

/// The strokes of a printable ASCII character, or an empty box for any other.
Glyph glyph(char character);

/// Width of a line of text [pixels]; `height` of the capitals [pixels].
double text_width(std::string_view text, double height);

/// Draws one line of text, antialiased, from `left` on the baseline at `baseline` (pixels from the left and
/// the top), with capitals `height` pixels high, in (0, 10000]. What lies outside of the image is cut off.
/// Throws std::invalid_argument for another height or a position that is not finite.
void draw_text(Image& image, std::string_view text, double left, double baseline, double height,
               const Colour& colour);

}  // namespace furrow::io
