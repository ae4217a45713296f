// SPDX-License-Identifier: GPL-3.0-or-later
#include "jobs/scene_input.h"

#include <algorithm>

#include "geometry/mesh/errors.h"
#include "io/scene/scene_file.h"
#include "io/scene/scene_rules.h"
#include "jobs/frame.h"

namespace furrow::jobs {

SceneInput scene_from_file(const std::filesystem::path& toml) {
  return {io::read_toml(toml), toml.parent_path()};
}

bool is_scene(const std::string& path) { return std::filesystem::path(path).extension() == ".toml"; }

namespace {

/// Does it; a fault of a flag is one of the call, not of a file.
template <class Work>
auto blaming_flags(const Work& work) {
  try {
    return work();
  } catch (const geometry::ContentError& e) {
    if (std::string(e.what()).rfind("--", 0) == 0) throw std::invalid_argument(e.what());
    throw;
  }
}

}  // namespace

io::Scene scene_of(const io::TomlDocument& document, const std::filesystem::path& folder) {
  return blaming_flags([&] { return io::read_scene(document, folder); });
}

void take_noted_frame(io::Scene& scene, io::TomlDocument& document, const MemoryFiles& memory) {
  if (memory.holds(scene.garment)) return;
  Frame noted;
  jobs::take_noted_frame(noted, {scene.garment.string()});
  const auto take = [&](std::optional<std::string>& value, const char* key, const std::string& found,
                        const char* usual) {
    if (value || found == usual) return;
    value = found;
    io::set_value(document, key, found, scene.garment.string());
  };
  take(scene.unit, "unit", noted.noted_unit, "m");
  take(scene.up, "up", noted.noted_up, "y");
}

void check_inputs(const io::Scene& scene, const io::TomlDocument& document, int lines_drawn,
                  const MemoryFiles& memory) {
  const auto check = [&](const std::string& key, const std::filesystem::path& path) {
    const std::string place = document.place(key);
    if (document.name.empty() || place.rfind(document.name, 0) != 0 || path.empty() || path == "-" ||
        memory.holds(path) || std::filesystem::exists(path))
      return;
    throw geometry::ContentError(place + ": " + key + ": there is no file " + path.string() +
                                 "; paths are relative to the file that names them");
  };
  blaming_flags([&] { io::check_keep_stands_still(scene, document, lines_drawn); });
  if (lines_drawn < 0) check("garment.mesh", scene.garment);
  if (scene.body) check("body.mesh", scene.body->mesh);
  if (scene.body) check("body.field", scene.body->field);
  for (std::size_t i = static_cast<std::size_t>(std::max(0, lines_drawn)); i < scene.lines.size(); ++i)
    check("lines." + std::to_string(i) + ".strokes", scene.lines[i].strokes);
}

}  // namespace furrow::jobs
