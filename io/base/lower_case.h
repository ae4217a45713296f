// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <filesystem>
#include <string>

namespace furrow::io {

/// The text with A to Z as a to z, whatever the locale; for endings of file names.
inline std::string lower_case(std::string text) {
  for (char& c : text)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c + ('a' - 'A'));
  return text;
}

/// ".ply" of "worn.PLY": the one way in which formats are told by names.
inline std::string ending_of(const std::filesystem::path& path) {
  return lower_case(path.extension().string());
}

}  // namespace furrow::io
