// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <string_view>

namespace furrow::studio {

/// A file of the page, as it was bundled into the program (cmake/studio.cmake).
struct PageFile {
  std::string_view path, type, bytes;
  bool gzipped;
};

/// Null: there is none. Paths begin with '/'.
const PageFile* find_page_file(std::string_view path);

}  // namespace furrow::studio
