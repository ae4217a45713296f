// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/scene/relocated.h"

#include <map>
#include <vector>

namespace furrow::io {

Json relocated(const TomlDocument& document, const std::filesystem::path& folder,
               const std::filesystem::path& target) {
  namespace fs = std::filesystem;
  Json root = document.root;
  const fs::path here = fs::current_path();
  const auto move = [&](Json& table, const char* key, const std::string& path) {
    if (!table.is_object() || !table.contains(key) || table[key] == "-" || table[key] == "") return;
    const fs::path given(table[key].get<std::string>());
    if (given.is_absolute()) return;
    const fs::path full = (here / (document.is_of_file(path) ? folder / given : given)).lexically_normal();
    const fs::path relative = full.lexically_relative((here / target).lexically_normal());
    table[key] = (relative.empty() ? full : relative).generic_string();
  };
  for (const auto& [table, keys] : std::map<std::string, std::vector<const char*>>{
           {"garment", {"mesh"}},
           {"body", {"mesh", "field", "frames"}},
           {"output", {"mesh", "state", "inserted", "smoothed", "animation", "body"}}})
    for (const char* key : keys)
      if (root.contains(table)) move(root[table], key, table + "." + key);
  if (!root.contains("lines")) return root;
  if (root["lines"].is_object()) root["lines"] = Json::array({root["lines"]});
  for (std::size_t i = 0; i < root["lines"].size(); ++i)
    move(root["lines"][i], "strokes", "lines." + std::to_string(i) + ".strokes");
  return root;
}

}  // namespace furrow::io
