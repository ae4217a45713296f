// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace furrow::io {

/// A picture of 8-bit sRGB pixels without transparency.
struct Image {
  int width = 0;                  ///< [pixels]
  int height = 0;                 ///< [pixels]
  std::vector<std::uint8_t> rgb;  ///< 3 · width · height values; rows from the top, pixels from the left
};

/// Writes a picture as PNG, by write_atomically(): no reader ever sees half a file. Throws
/// std::invalid_argument if a side is < 1 or rgb has another length; std::runtime_error if it cannot be
/// written.
void write_png(const std::filesystem::path& path, const Image& image);

/// A picture of three numbers a pixel that are not colours: displacements, normals.
struct Image16 {
  int width = 0;                   ///< [pixels]
  int height = 0;                  ///< [pixels]
  std::vector<std::uint16_t> rgb;  ///< 3 · width · height values; rows from the top, pixels from the left
};

/// Writes and reads PNG of 16 bits a channel. The numbers are stored as they are, without gamma or colour
/// space. Writing is atomic, with the errors of the 8-bit write_png. Reading leaves alpha out, and throws
/// geometry::ContentError also for a PNG of fewer bits or without three colours, whose numbers would be
/// coarser than they seem.
void write_png16(const std::filesystem::path& path, const Image16& image);
Image16 read_png16(const std::filesystem::path& path);

/// A PNG's bytes with the text "Software: furrow" before its end (own_mark.h), as those have that are written
/// here.
std::string marked_png(std::string_view bytes);

/// Reads a PNG of any kind; transparent pixels lie on white. Throws geometry::ContentError if the file cannot
/// be read as one, or if it has more than 100 million pixels.
Image read_png(const std::filesystem::path& path);

}  // namespace furrow::io
