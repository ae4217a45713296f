// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <span>
#include <string>

#include "io/picture/png_file.h"
#include "io/picture/render.h"

namespace furrow::io {

/// One picture of a strip and the words under it; '\n' begins a new line. Printable ASCII has letters.
struct Panel {
  Image image;
  std::string caption;
};

struct StripOptions {
  double text_height = 0.030;       ///< of capitals, of the tallest panel's height, in [0.005, 0.2]
  int gap = 8;                      ///< between panels and around the strip [pixels], in [0, 1000]
  Colour paper{1.0f, 1.0f, 1.0f};   ///< sRGB, each in [0, 1]
  Colour ink{0.15f, 0.16f, 0.18f};  ///< sRGB, each in [0, 1]
};

/// The panels side by side from left to right, with centred captions under them, to show the stages of one
/// garment (method S1.21). Lower panels are centred in the height of the tallest. If a caption is too wide
/// for its panel, all letters shrink alike until it fits. Without captions no room is kept for them. Throws
/// std::invalid_argument for no panels, a panel whose pixels do not match its sides, or an option out of its
/// range.
Image strip(std::span<const Panel> panels, const StripOptions& options = {});

}  // namespace furrow::io
