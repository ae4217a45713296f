// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/scene/settings_schema.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cstdlib>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>

#include "geometry/mesh/errors.h"
#include "io/base/bytes_file.h"
#include "io/base/field_words.h"
#include "io/scene/scene_file.h"
#include "tests/test_paths.h"

using namespace furrow;
using io::Json, io::Kind, io::Setting;

namespace {

/// Beside these marks docs/scenes.md has what page() prints.
const std::string begin_mark = "<!-- settings: printed from io/scene/settings_schema.cpp -->\n";
const std::string end_mark = "<!-- end of settings -->\n";
const std::filesystem::path scenes_page = tests::source_dir() / "docs" / "scenes.md";

std::string with_powers(std::string text) {
  for (std::size_t at; (at = text.find("^2")) != text.npos;) text.replace(at, 2, "²");
  for (std::size_t at; (at = text.find(">=")) != text.npos;) text.replace(at, 2, "≥");
  for (std::size_t at; (at = text.find("<=")) != text.npos;) text.replace(at, 2, "≤");
  return text;
}

std::string code(const std::string& text) { return text.empty() ? "" : "`" + text + "`"; }

std::string page() {
  std::string text =
      "| table | key | what | may be | default | flag |\n| --- | --- | --- | --- | --- | --- |\n";
  for (const io::SettingTable& table : io::setting_tables()) {
    std::string name = code(table.heading.empty() ? table.name : table.heading);
    for (const Setting& s : io::scene_settings()) {
      if (s.table() != table.name) continue;
      text += "| " + name + " | " + code(s.key()) + " | " + s.what + " | " + with_powers(s.range) + " | " +
              s.usual + " | " + (s.keyword.empty() ? "" : code(io::flag_of(s.keyword))) + " |\n";
      name = "";
    }
  }
  return text;
}

struct Split {
  std::string before, table, after;
};
Split split_page() {
  const std::string text = io::read_text(scenes_page);
  const std::size_t begin = text.find(begin_mark), end = text.find(end_mark);
  if (begin == text.npos || end == text.npos)
    throw geometry::ContentError(scenes_page.string() + ": the marks of its table of settings are missing");
  const std::size_t table = begin + begin_mark.size();
  return {text.substr(0, table), text.substr(table, end - table), text.substr(end)};
}

/// A scene with what must be there, and this value of the setting.
Json scene_with(const Setting& setting, const Json& value) {
  Json root{{"lines", Json::array({{{"strokes", "l.json"}}})},
            {"body", {{"mesh", "b.obj"}}},
            {"pins", Json::array({{{"loop", "top"}}})}};
  Json& table = setting.table().empty() ? root : root[setting.table()];
  (table.is_array() ? table[0] : table)[setting.key()] = value;
  return root;
}

std::string fault_of(const Json& root) {
  try {
    io::read_scene(io::document_of(root, "s.toml"), "");
  } catch (const geometry::ContentError& e) {
    return e.what();
  }
  return "";
}

/// Not of a motion: its tables stand inside others.
bool is_of_scene(const Setting& s) {
  const auto& tables = io::setting_tables();
  return s.table().empty() || std::any_of(tables.begin(), tables.end(), [&](const io::SettingTable& t) {
           return t.name == s.table() && t.heading.find('[') != std::string::npos;
         });
}

Json of_wrong_type(Kind kind) {
  if (kind == Kind::number || kind == Kind::vector || kind == Kind::yes_no) return "soft";
  return kind == Kind::whole ? Json(1.5) : Json(true);
}

bool holds(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

}  // namespace

TEST_CASE("settings: docs/scenes.md has the table that the schema prints") {
  INFO("write it anew: FURROW_WRITE_DOCS=1 build/release/tests/test_io \"settings: docs*\"");
  if (std::getenv("FURROW_WRITE_DOCS")) {
    const Split split = split_page();
    std::ofstream(scenes_page, std::ios::binary) << split.before << page() << split.after;
  }
  CHECK(split_page().table == page());
}

TEST_CASE("settings: each is known to the reader, which refuses a wrong type by the setting's name") {
  int seen = 0;
  for (const Setting& s : io::scene_settings()) {
    if (!is_of_scene(s)) continue;
    const std::string what = fault_of(scene_with(s, of_wrong_type(s.kind)));
    const std::string at = s.table().empty() || s.table() == "lines" || s.table() == "pins" ? "" : s.path;
    INFO(s.path << ": " << what);
    CHECK(holds(what, at.empty() ? s.key() : at));
    CHECK(holds(what, "s.toml"));
    CHECK_FALSE(holds(what, "there is no setting"));
    ++seen;
  }
  CHECK(seen > 60);
}

TEST_CASE("settings: the default of a number or a choice is one of its values") {
  int seen = 0;
  for (const Setting& s : io::scene_settings()) {
    const Json value = io::parse_value(s.usual);
    const bool is_number = (s.kind == Kind::number || s.kind == Kind::whole) && value.is_number();
    const bool has_value = is_number || (s.kind == Kind::choice && holds(s.range, "`" + s.usual + "`"));
    if (!is_of_scene(s) || !has_value || s.path == "body.fps") continue;
    INFO(s.path << " = " << s.usual);
    const std::string what = fault_of(scene_with(s, value));
    // What alone stands against these is a rule: no body without frames has one, say.
    CHECK_FALSE(holds(what, "must be"));
    CHECK_FALSE(holds(what, "is none of"));
    ++seen;
  }
  CHECK(seen > 30);
}

TEST_CASE("settings: paths and flags are told apart, and nobody has a flag without a use for it") {
  std::set<std::string> paths, keywords;
  for (const Setting& s : io::scene_settings()) {
    INFO(s.path);
    CHECK(paths.insert(s.path).second);
    CHECK_FALSE(s.what.empty());
    CHECK_FALSE(s.usual.empty());
    if (s.keyword.empty()) continue;
    CHECK(keywords.insert(s.keyword).second);
    CHECK((s.flag_in & ~s.used) == 0);
  }
}

TEST_CASE("settings: a key in the wrong table is told where it belongs") {
  for (const Setting& s : io::scene_settings()) {
    if (!is_of_scene(s) || s.table().empty() || io::find_setting("pins." + s.key())) continue;
    const std::string what = fault_of(Json{{"pins", Json::array({{{"loop", "top"}, {s.key(), 1}}})}}),
                      wanted = s.table();
    INFO(s.path << ": " << what);
    CHECK(holds(what, "there is no setting 'pins.0." + s.key() + "'; '" + s.key() + "' belongs in "));
    CHECK((holds(what, "[" + wanted + "]")));
  }
  CHECK(io::tables_of_key("mesh") == "[garment] or [body] or [output]");
  CHECK(io::tables_of_key("motion") == "[body] or [[pins]]");
  CHECK(io::tables_of_key("spin") == "motion");
  CHECK(io::tables_of_key("nothing") == "");
}

TEST_CASE("settings: what rest has no use for is named, a table as a whole if nothing of it is of use") {
  Json root = Json::object();
  for (const Setting& s : io::scene_settings())
    if (is_of_scene(s) && s.table() != "lines" && s.table() != "pins") {
      if (s.table().empty())
        root[s.key()] = 1;
      else
        root[s.table()][s.key()] = 1;
    }
  root["garment"]["rest"] = "keep";
  root["pins"] = Json::array({{{"loop", "top"}}, {{"loop", "bottom"}, {"motion", Json::object()}}});
  io::TomlDocument document = io::document_of(root, "s.toml");
  const std::vector<std::string> idle = io::settings_without_use(document, io::used_by::drape);
  for (const char* path :
       {"garment.rest", "garment.velocity", "material.damping", "material.drag", "forces.wind",
        "forces.gusts", "forces.swirl", "simulation.seconds", "simulation.stop_at", "simulation.dt",
        "simulation.force_dt", "simulation.integrator", "simulation.sweeps", "output", "pins.1.motion"})
    CHECK(std::count(idle.begin(), idle.end(), path) == 1);
  CHECK(idle.back() == "pins.1.motion");
  for (const std::string& path : idle) {
    const Setting* setting = io::find_setting(path);
    INFO(path);
    CHECK((path == "output" || path == "pins.1.motion" || !(setting->used & io::used_by::drape)));
  }
  CHECK(io::settings_without_use(document, io::used_by::simulate) ==
        std::vector<std::string>{"garment.layer", "garment.thickness", "garment.touch", "simulation.starts"});
  document.root["garment"]["rest"] = "stored";  // as rest has it
  document.root->erase("output");
  const auto fewer = io::settings_without_use(document, io::used_by::drape);
  CHECK(fewer.size() == idle.size() - 2);
  CHECK(fewer.front() == "garment.velocity");
}
