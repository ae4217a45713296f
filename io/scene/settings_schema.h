// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "io/scene/scene.h"

namespace furrow::io {

class SettingsTable;
struct Scene;

/// Subcommands that read settings of a scene, as bits.
namespace used_by {
inline constexpr unsigned nobody = 0, simulate = 1, keep = 2, chart = 4, drape = 8, wrinkle = 16;
inline constexpr unsigned moving = simulate | keep | chart;  ///< of a garment that moves
inline constexpr unsigned all = moving | drape | wrinkle;
}  // namespace used_by

enum class Kind { number, whole, yes_no, text, choice, path, vector, list, table };

/// What is known of one setting. All that reads, names, checks or documents a setting takes it from here.
struct Setting {
  /// "material.friction"; "lines.time": of each in the list; "spin.rate": of each such table inside others.
  std::string path = {};
  /// Of Python, and with dashes the flag: "body_unit"; "": the path alone reaches it; "=": the key.
  std::string keyword = "=";
  unsigned shown_in = used_by::nobody;  ///< whose --help shows it; elsewhere --help-all alone does
  std::string what = {};                ///< in Markdown; other settings by their keys, in backticks
  std::string usual = {};               ///< the default in words; "": the value that a new Scene has
  /// Who has a use for it. `drape` warns of what it has none for, unless it refuses it with words of its own.
  unsigned used = used_by::all;
  unsigned flag_in = used_by::moving;  ///< who has the flag; nobody: it is an option of all subcommands
  Kind kind = Kind::text;              ///< filled in by the row, as the next one
  std::string range = {};              ///< in words, with the unit: "> 0 [m]"

  std::string table() const;  ///< "material"; "" at the root
  std::string key() const;    ///< "friction"
  /// "`body_unit`", "`lines.time`": as messages name it.
  std::string name() const { return "`" + (keyword.empty() ? path : keyword) + "`"; }
  /// Whether the command line gives it as it stands, without TOML's quotes.
  bool is_text() const { return kind == Kind::text || kind == Kind::choice || kind == Kind::path; }
};

/// A table of a scene, and how one writes it: "pins", "[[pins]]".
struct SettingTable {
  std::string name, heading;
};

/// All settings; their flags stand in this order in --help.
const std::vector<Setting>& scene_settings();
/// The tables that hold them, as docs/scenes.md lists them; "" first: the root.
const std::vector<SettingTable>& setting_tables();
/// What a setting is, its unit and its default, for help: without links, other settings by the names that
/// `name` gives.
std::string described(const Setting& setting, const std::function<std::string(const Setting&)>& name);
/// The setting with this path; null: there is none.
const Setting* find_setting(std::string_view path);

/// Reads the settings of the table with this name into the scene; of a list or of the body, into its last
/// one, which must be there. Throws as SettingsTable does.
void read_settings(SettingsTable& table, const std::string& name, Scene& scene);
/// Reads one of them alone.
void read_setting(SettingsTable& table, const std::string& path, Scene& scene);

/// The tables that a key belongs in as one would write them, "[simulation]"; empty for a key that none has.
std::string tables_of_key(std::string_view key);

/// The paths that the document says and that the subcommand, one bit of used_by, has no use for. A table of
/// which it uses nothing is named as a whole.
std::vector<std::string> settings_without_use(const TomlDocument& document, unsigned subcommand);

}  // namespace furrow::io
