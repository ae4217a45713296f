// SPDX-License-Identifier: GPL-3.0-or-later
#include "jobs/cloth/recorded_material.h"

#include "geometry/mesh/errors.h"
#include "io/mesh/mesh_file.h"
#include "io/scene/fabrics.h"
#include "io/scene/scene.h"
#include "io/scene/settings_schema.h"
#include "io/scene/settings_table.h"

namespace furrow::jobs {
namespace {

using io::Json;

constexpr const char* cloth[] = {"preset", "membrane", "bending_law", "stiffness", "bending"};

Json material_of(const io::TomlDocument& document) {
  return document.root->value("material", Json::object());
}

bool same_cloth(const Json& a, const Json& b) {
  for (const char* key : cloth)
    if (a.value(key, Json()) != b.value(key, Json())) return false;
  return true;
}

/// "`fabric=cotton` `friction=0.4`"
std::string fields_of(const Json& material) {
  std::string text;
  for (const auto& [key, value] : material.items()) {
    const io::Setting* setting = io::find_setting("material." + key);
    const std::string name = setting && !setting->keyword.empty() ? setting->keyword : "material." + key;
    text += (text.empty() ? "`" : " `") + name + "=" +
            (value.is_string() ? value.get<std::string>() : io::value_text(value)) + "`";
  }
  return text;
}

}  // namespace

bool names_cloth(const io::TomlDocument& document) {
  const Json material = material_of(document);
  for (const char* key : cloth)
    if (material.contains(key)) return true;
  return false;
}

bool take_default_cloth(io::TomlDocument& document, const std::string& who) {
  if (names_cloth(document)) return false;
  io::set_value(document, "material.preset", "cotton", who);
  return true;
}

bool take_default_moving_cloth(io::TomlDocument& document, const std::string& who) {
  const Json simulation = document.root->value("simulation", Json::object());
  return simulation.value("integrator", Json()) != "xpbd" && take_default_cloth(document, who);
}

std::string words_of_other_cloth(const std::filesystem::path& garment, const io::Json& other_cloth) {
  return garment.string() + ": came to rest with " + fields_of(other_cloth) + ", and is other cloth now";
}

std::filesystem::path garment_of(const io::TomlDocument& document, const std::filesystem::path& folder) {
  std::filesystem::path mesh;
  try {
    if (auto garment = io::SettingsTable(document, folder).table("garment")) garment->read("mesh", mesh);
  } catch (const geometry::ContentError&) {
    return {};
  }
  return mesh;
}

RecordedMaterial take_recorded_material(io::TomlDocument& document, const std::filesystem::path& garment,
                                        const MemoryFiles& memory) {
  const io::MeshFile* known = memory.find_mesh(garment);
  const auto record = known ? io::find_wrinkle_record(*known) : io::read_wrinkle_record(garment);
  if (!record || record->material.empty()) return {};
  const Json noted = Json::parse(record->material);
  const Json said = material_of(document);
  if (names_cloth(document)) return {false, same_cloth(noted, said) ? Json() : noted};
  bool taken = false;
  for (const auto& [key, value] : noted.items()) {
    if (said.contains(key)) continue;
    io::set_value(document, "material." + key, value, garment.string());
    taken = true;
  }
  // The masses are in the file: a preset's density is not to change them. An unknown one is refused later.
  for (const io::Fabric& fabric : io::fabrics())
    if (noted.value("preset", Json()) == fabric.name && !said.contains("density") && record->density > 0 &&
        record->density != fabric.density)
      io::set_value(document, "material.density", record->density, garment.string());
  return {taken, Json()};
}

void note_material(io::MeshFile& file, const io::TomlDocument& document, double contact_gap) {
  io::WrinkleRecord record = io::find_wrinkle_record(file).value();
  nlohmann::json material = material_of(document);  // sorted by keys, in whatever order they were said
  material.erase("density");                        // noted by itself
  if (material.value("warp", "") != "none") material.erase("warp");  // the faces have it (f:warp)
  record.material = material.empty() ? "" : material.dump(-1, ' ', false, Json::error_handler_t::replace);
  record.contact_gap = contact_gap;
  io::set_wrinkle_record(file, record);
}

}  // namespace furrow::jobs
