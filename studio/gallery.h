// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <filesystem>
#include <string>
#include <vector>

namespace furrow::studio {

/// A garment or scene that comes with the program.
struct GalleryItem {
  std::string name;  ///< of its file, without ".toml"
  std::string title;
  std::filesystem::path scene;
  std::string picture = {};  ///< a PNG as a data URL; "": there is none
};

/// The scenes of a folder, those without a title left out, by title; none where there is no such folder. The
/// picture of skirt.toml is skirt.png beside it, of at most 256 KiB.
std::vector<GalleryItem> gallery(const std::filesystem::path& folder);

}  // namespace furrow::studio
