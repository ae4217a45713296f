// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <string>

namespace furrow::io {

/// The text with A to Z as a to z, whatever the locale; for endings of file names.
inline std::string lower_case(std::string text) {
  for (char& c : text)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c + ('a' - 'A'));
  return text;
}

}  // namespace furrow::io
