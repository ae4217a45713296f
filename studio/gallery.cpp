// SPDX-License-Identifier: GPL-3.0-or-later
#include "studio/gallery.h"

#include <algorithm>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>

#include "jobs/base/project_files.h"
#include "jobs/base/read_inputs.h"

namespace furrow::studio {
namespace {

std::string picture_url(const std::filesystem::path& file) {
  constexpr std::uintmax_t most = 256 << 10;
  std::error_code none;
  const std::uintmax_t size = std::filesystem::file_size(file, none);
  if (none || size > most) return "";
  std::ifstream in(file, std::ios::binary);
  return jobs::data_url("image/png", {std::istreambuf_iterator<char>(in), {}});
}

}  // namespace

std::vector<GalleryItem> gallery(const std::filesystem::path& folder) {
  std::vector<GalleryItem> items;
  std::error_code none;
  for (const auto& entry : std::filesystem::directory_iterator(folder, none)) {
    if (entry.path().extension() != ".toml") continue;
    const std::string title =
        jobs::settings_of(entry.path().string(), "", std::nullopt).root->value("title", "");
    if (!title.empty())
      items.push_back({entry.path().stem().string(), title, entry.path(),
                       picture_url(std::filesystem::path(entry.path()).replace_extension(".png"))});
  }
  std::ranges::sort(items, {}, &GalleryItem::title);
  return items;
}

}  // namespace furrow::studio
