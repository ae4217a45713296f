// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <string>

namespace furrow::io {

using Json = nlohmann::ordered_json;

/// Settings as a tree, and where each came from. A path joins keys and indices with dots: "pins.0.box".
struct TomlDocument {
  Json root = nlohmann::ordered_json::object();
  std::map<std::string, std::string> where;  ///< by path: "scene.toml:12:5", or the flag that set it
  std::string name;                          ///< of the file, for messages

  /// Where the value, or the nearest table around it, was written.
  std::string place(const std::string& path) const;
  /// Whether the file says it, and not a flag.
  bool is_of_file(const std::string& path) const;
};

/// Reads a TOML file (version 1.0). Throws geometry::ContentError with file, line and column if it cannot be
/// read, is no TOML, or holds a date or a time, which no setting is.
TomlDocument read_toml(const std::filesystem::path& path);
/// The same from text; `name` stands in messages.
TomlDocument parse_toml(const std::string& text, const std::string& name);

/// A document of settings that were made elsewhere, all of them from `name`.
TomlDocument document_of(Json root, const std::string& name);
/// Where a table stands in place of a list of tables, makes it the list's only one.
void make_list(TomlDocument& document, const std::string& key);

/// Sets one value, making the tables and arrays on the way; an index may be at most one past an array's end.
/// Throws std::invalid_argument if the path runs through a value that is no table or array.
void set_value(TomlDocument& document, const std::string& path, Json value, const std::string& where);
/// A value as one would type it behind `key=`: TOML where it is such (numbers, true, [1, 2], {a = 1},
/// "text"), else a string as it stands.
Json parse_value(const std::string& text);
/// The value as TOML in one line, so that parse_value() gives it back.
std::string value_text(const nlohmann::ordered_json& value);

}  // namespace furrow::io
