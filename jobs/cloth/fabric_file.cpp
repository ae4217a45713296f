// SPDX-License-Identifier: GPL-3.0-or-later
#include "jobs/cloth/fabric_file.h"

#include <nlohmann/json.hpp>

#include "geometry/mesh/errors.h"
#include "io/base/figure_path.h"
#include "io/scene/settings_table.h"

namespace furrow::jobs {
namespace {

using io::Json;

bool is_file(const Json& preset) {
  return preset.is_string() && io::ending_of(preset.get<std::string>()) == ".toml";
}

Json material_table(const io::TomlDocument& document) {
  return document.root->value("material", Json::object());
}

Json preset_of(const Json& material) {
  return material.is_object() ? material.value("preset", Json()) : Json();
}

}  // namespace

void take_fabric_file(io::TomlDocument& document, const std::filesystem::path& folder) {
  if (!is_file(preset_of(material_table(document)))) return;
  std::filesystem::path path;
  io::SettingsTable(document, folder).table("material")->read("preset", path);
  const io::TomlDocument file = io::read_toml(path);
  const Json fabric = material_table(file);
  if (!fabric.is_object() || fabric.empty())
    throw geometry::ContentError(file.name + ": there is no [material] in it to take a fabric from");
  if (is_file(preset_of(fabric)))
    throw geometry::ContentError(file.place("material.preset") + ": a fabric's file names no other file");
  document.root["material"].erase("preset");
  for (const auto& [key, value] : fabric.items())
    if (!document.root["material"].contains(key))
      io::set_value(document, "material." + key, value, file.place("material." + key));
}

}  // namespace furrow::jobs
