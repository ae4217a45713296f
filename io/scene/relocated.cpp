// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/scene/relocated.h"

#include <nlohmann/json.hpp>

#include "io/scene/settings_schema.h"

namespace furrow::io {

Json relocated(const TomlDocument& document, const std::filesystem::path& folder,
               const std::filesystem::path& target) {
  namespace fs = std::filesystem;
  Json root = *document.root;
  const fs::path here = fs::current_path();
  const auto move = [&](Json& table, const std::string& key, const std::string& path) {
    if (!table.is_object() || !table.contains(key) || table[key] == "-" || table[key] == "") return;
    const fs::path given(table[key].get<std::string>());
    if (given.is_absolute()) return;
    const fs::path full = (here / (document.is_of_file(path) ? folder / given : given)).lexically_normal();
    const fs::path relative = full.lexically_relative((here / target).lexically_normal());
    table[key] = (relative.empty() ? full : relative).generic_string();
  };
  if (root.contains("lines") && root["lines"].is_object()) root["lines"] = Json::array({root["lines"]});
  for (const Setting& setting : scene_settings()) {
    if (setting.kind != Kind::path || !root.contains(setting.table())) continue;
    Json& table = root[setting.table()];
    const std::string key = setting.key();
    if (!table.is_array()) move(table, key, setting.path);
    for (std::size_t i = 0; table.is_array() && i < table.size(); ++i)
      move(table[i], key, setting.table() + "." + std::to_string(i) + "." + key);
  }
  return root;
}

}  // namespace furrow::io
