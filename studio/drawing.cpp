// SPDX-License-Identifier: GPL-3.0-or-later
#include "studio/drawing.h"

#include <algorithm>
#include <utility>

namespace furrow::studio {

jobs::SceneInput scene_of_drawing(const Json& drawing, const std::filesystem::path& folder) {
  return {io::document_of(drawing.at("settings"), "the project"), folder};
}

Json drawing_of(const Json& settings, const Json& strokes) {
  Json lines = Json::array();
  for (const Json& stroke : strokes) lines.push_back({{"on", true}, {"stroke", stroke}});
  return {{"settings", settings}, {"lines", lines}, {"earlier", Json::array()}};
}

Json strokes_on(const Json& drawing) {
  Json strokes = Json::array();
  for (const Json& line : drawing.at("lines"))
    if (line.value("on", true)) strokes.push_back(line.at("stroke"));
  return strokes;
}

std::string name_of_line(const Json& line) { return line.at("stroke").value("name", "a line"); }

Json row_of(const Json& line) {
  const Json& stroke = line.at("stroke");
  Json row{{"name", name_of_line(line)}, {"on", line.value("on", true)}};
  for (const char* key : {"height", "width", "sharpness", "press", "closed"})
    if (stroke.contains(key) && !stroke[key].is_array()) row[key] = stroke[key];
  row["varies"] = stroke.contains("height") && stroke["height"].is_array();
  return row;
}

std::string free_name(const Json& drawing, const std::string& word) {
  const Json& lines = drawing.at("lines");
  const Json earlier = drawing.value("earlier", Json::array());
  for (int n = 1;; ++n) {
    const std::string name = word + " " + std::to_string(n);
    const auto is_it = [&](const Json& line) { return name_of_line(line) == name; };
    if (std::none_of(lines.begin(), lines.end(), is_it) &&
        std::find(earlier.begin(), earlier.end(), Json(name)) == earlier.end())
      return name;
  }
}

std::string free_name_for(const Json& drawing, const Json& stroke) {
  const Json height = stroke.value("height", Json());
  return free_name(drawing, height.is_number() && height.get<double>() < 0 ? "valley" : "ridge");
}

std::filesystem::path made_for_of(const Json& drawing, const std::filesystem::path& folder) {
  const std::string noted = drawing.value("made_for", "");
  return noted.empty() ? std::filesystem::path() : (folder / noted).lexically_normal();
}

void note_made_for(const std::filesystem::path& body, const std::filesystem::path& folder, Json& drawing) {
  namespace fs = std::filesystem;
  if (body.empty()) return;
  const fs::path full = fs::absolute(body).lexically_normal();
  const fs::path way = full.lexically_relative(fs::absolute(folder).lexically_normal());
  const bool outside = way.empty() || *way.begin() == "..";
  drawing["made_for"] = (outside && body.is_absolute() ? full : way).generic_string();
}

jobs::Sketch open_drawing(const Json& drawing, const std::filesystem::path& folder,
                          jobs::Listener& listener) {
  return jobs::open_sketch(scene_of_drawing(drawing, folder), listener, made_for_of(drawing, folder));
}

void take_as_garment(const std::string& file, const Json& pins, Json& drawing) {
  drawing["settings"]["garment"] = {{"mesh", file}};
  drawing["settings"]["pins"] = pins;
  drawing.erase("made_for");
  const Json lines = std::exchange(drawing["lines"], Json::array());
  for (const Json& line : lines) {
    if (line.value("on", true))
      drawing["earlier"].push_back(name_of_line(line));
    else
      drawing["lines"].push_back(line);
  }
}

namespace {

/// Settings that a motion cannot change on its way.
Json unmoved(Json settings) {
  for (const char* key : {"garment", "pins"}) settings.erase(key);
  return settings;
}

}  // namespace

Json motion_after(const Json& before, const std::string& state, double time, bool pulled) {
  const Json& settings = before.at("settings");
  Json motion = before.value("motion", Json{{"begun", settings}, {"rounds", Json::array()}, {"again", true}});
  const Json strokes = strokes_on(before);
  if (!strokes.empty() && motion.contains("rounds"))
    motion["rounds"].push_back({{"time", motion.value("time", 0.0)}, {"strokes", strokes}});
  if (pulled || !motion.contains("begun") || unmoved(motion["begun"]) != unmoved(settings))
    motion["again"] = false;
  motion["state"] = state;
  motion["time"] = time;
  return motion;
}

std::optional<jobs::SketchMotion> motion_of(const Json& drawing) {
  const Json note = drawing.value("motion", Json::object());
  if (!note.value("again", false)) return std::nullopt;
  jobs::SketchMotion motion{note.at("begun"), {}, note.at("time").get<double>()};
  for (const Json& round : note.at("rounds"))
    motion.rounds.emplace_back(round.at("time").get<double>(), round.at("strokes"));
  return motion;
}

}  // namespace furrow::studio
