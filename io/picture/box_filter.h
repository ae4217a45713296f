// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "io/picture/png_file.h"

namespace furrow::io {

/// A picture whose pixels are the means, in linear light, of `factor` × `factor` pixels of the one given:
/// made large and then smaller, edges get finer. Throws std::invalid_argument for a factor < 1 or
/// one that does not divide both sides, or if the pixels do not match the sides.
Image box_filter(const Image& image, int factor);

}  // namespace furrow::io
