// SPDX-License-Identifier: GPL-3.0-or-later
#include "studio/drawing.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <utility>

namespace furrow::studio {
namespace {

bool is_text(const Json& value) { return value.is_string(); }
bool is_number(const Json& value) { return value.is_number(); }

/// Whether a key is missing or holds what it should.
bool may_hold(const Json& table, const char* key, bool (*is_it)(const Json&)) {
  const auto found = table.find(key);
  return found == table.end() || is_it(*found);
}

bool is_line(const Json& line) {
  return line.is_object() && may_hold(line, "on", [](const Json& on) { return on.is_boolean(); }) &&
         line.contains("stroke") && line["stroke"].is_object() && may_hold(line["stroke"], "name", is_text);
}

bool is_round(const Json& round) {
  return round.is_object() && round.contains("time") && round["time"].is_number() &&
         round.contains("strokes") && round["strokes"].is_array();
}

bool is_list_of(const Json& list, bool (*is_it)(const Json&)) {
  return list.is_array() && std::all_of(list.begin(), list.end(), is_it);
}

bool is_motion(const Json& motion) {
  if (!motion.is_object() || !may_hold(motion, "state", is_text) || !may_hold(motion, "time", is_number))
    return false;
  if (!may_hold(motion, "again", [](const Json& again) { return again.is_boolean(); })) return false;
  if (!may_hold(motion, "begun", [](const Json& begun) { return begun.is_object(); })) return false;
  if (!may_hold(motion, "rounds", [](const Json& list) { return is_list_of(list, is_round); })) return false;
  return !motion.value("again", false) ||
         (motion.contains("begun") && motion.contains("rounds") && motion.contains("time"));
}

}  // namespace

std::string fault_of_drawing(const Json& drawing) {
  if (!drawing.is_object()) return "it holds no drawing";
  if (!drawing.contains("settings") || !drawing["settings"].is_object()) return "it has no settings";
  if (!drawing.contains("lines") || !is_list_of(drawing["lines"], is_line)) return "its lines are no lines";
  if (!may_hold(drawing, "earlier", [](const Json& list) { return is_list_of(list, is_text); }))
    return "its earlier lines are no names";
  if (!may_hold(drawing, "middle", is_number)) return "its middle is no number";
  if (!may_hold(drawing, "made_for", is_text)) return "the body that it was made for is no path";
  return may_hold(drawing, "motion", is_motion) ? "" : "its motion is none";
}

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
  for (const char* key : {"height", "width", "sharpness", "press", "gather", "closed"})
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

std::string word_of(const Json& stroke) {
  if (stroke.contains("gather")) return "gather";
  const Json height = stroke.value("height", Json());
  const auto is_low = [](const Json& h) { return h.is_number() && h.get<double>() < 0; };
  const bool is_valley = height.is_array() ? std::ranges::any_of(height, is_low) : is_low(height);
  return is_valley ? "valley" : "ridge";
}

std::string free_name_for(const Json& drawing, const Json& stroke) {
  return free_name(drawing, word_of(stroke));
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
