// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "io/picture/png_file.h"

namespace furrow::io {

/// A texture that shows texture coordinates: squares of alternating brightness, tinted by their place, each
/// with its column (letter) and row (number from the bottom), and a cross of thin lines through it. Text that
/// is mirrored, stretched or cut shows a fault at once. `size`: pixels a side, in [64, 8192]. `squares`: a
/// side, in [1, 26], at least 16 pixels each. Throws std::invalid_argument otherwise.
Image checker_texture(int size = 2048, int squares = 20);

}  // namespace furrow::io
