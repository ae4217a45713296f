// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/scene_input.h"

#include <algorithm>

#include "geometry/errors.h"
#include "io/scene_file.h"

namespace furrow::cli {

bool is_scene(const std::string& path) { return std::filesystem::path(path).extension() == ".toml"; }

io::Scene scene_of(const io::TomlDocument& document, const std::filesystem::path& folder) {
  try {
    return io::read_scene(document, folder);
  } catch (const geometry::ContentError& e) {
    const bool a_flag = std::string(e.what()).rfind("--", 0) == 0;  // a fault of the call, not of a file
    if (a_flag) throw UsageError(e.what());
    throw;
  }
}

void take_noted_frame(io::Scene& scene, io::TomlDocument& document) {
  CommonArguments noted;
  cli::take_noted_frame(noted, {scene.garment.string()});
  const auto take = [&](std::optional<std::string>& value, const char* key, const std::string& found,
                        const char* usual) {
    if (value || found == usual) return;
    value = found;
    io::set_value(document, key, found, scene.garment.string());
  };
  take(scene.unit, "unit", noted.noted_unit, "m");
  take(scene.up, "up", noted.noted_up, "y");
}

void check_inputs(const io::Scene& scene, const io::TomlDocument& document, int lines_drawn) {
  const auto check = [&](const std::string& key, const std::filesystem::path& path) {
    const std::string place = document.place(key);
    if (document.name.empty() || place.rfind(document.name, 0) != 0 || path.empty() || path == "-" ||
        std::filesystem::exists(path))
      return;
    throw geometry::ContentError(place + ": " + key + ": there is no file " + path.string() +
                                 "; paths are relative to the file that names them");
  };
  if (lines_drawn < 0) check("garment.mesh", scene.garment);
  if (scene.body) check("body.mesh", scene.body->mesh);
  if (scene.body) check("body.field", scene.body->field);
  for (std::size_t i = static_cast<std::size_t>(std::max(0, lines_drawn)); i < scene.lines.size(); ++i)
    check("lines." + std::to_string(i) + ".strokes", scene.lines[i].strokes);
}

}  // namespace furrow::cli
