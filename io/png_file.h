// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <cstdint>
#include <filesystem>
#include <vector>

namespace furrow::io {

/// A picture of 8-bit sRGB pixels without transparency.
struct Image {
  int width = 0;                  ///< [pixels]
  int height = 0;                 ///< [pixels]
  std::vector<std::uint8_t> rgb;  ///< 3 · width · height values; rows from the top, pixels from the left
};

/// Writes a picture as PNG: to a temporary beside it, then renames, so that no reader ever sees half a file.
/// Throws std::invalid_argument if a side is < 1 or rgb has another length; std::runtime_error if it cannot
/// write.
void write_png(const std::filesystem::path& path, const Image& image);

/// Reads a PNG of any kind; transparent pixels lie on white. Throws geometry::ContentError if the file cannot
/// be read as one, or if it has more than 100 million pixels.
Image read_png(const std::filesystem::path& path);

}  // namespace furrow::io
