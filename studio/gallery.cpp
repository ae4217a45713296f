// SPDX-License-Identifier: GPL-3.0-or-later
#include "studio/gallery.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "jobs/base/read_inputs.h"

namespace furrow::studio {

std::vector<GalleryItem> gallery(const std::filesystem::path& folder) {
  std::vector<GalleryItem> items;
  std::error_code none;
  for (const auto& entry : std::filesystem::directory_iterator(folder, none)) {
    if (entry.path().extension() != ".toml") continue;
    const std::string title =
        jobs::settings_of(entry.path().string(), "", std::nullopt).root->value("title", "");
    if (!title.empty()) items.push_back({entry.path().stem().string(), title, entry.path()});
  }
  std::ranges::sort(items, {}, &GalleryItem::title);
  return items;
}

}  // namespace furrow::studio
