// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <algorithm>
#include <functional>
#include <span>
#include <sstream>

#include "io/scene/settings_schema.h"
#include "io/scene/settings_table.h"

/// How a row of the schema reaches the field of a struct that it sets: FIELD(material.poisson) is a function
/// `At` that returns it.
#define FIELD(path) \
  [](auto& target) -> auto& { return target.path; }

namespace furrow::io {

inline std::string text_of(double value) { return (std::ostringstream() << value).str(); }
inline std::string text_of(const std::string& text) { return text.empty() ? "none" : text; }
inline std::string text_of(const std::filesystem::path& path) { return text_of(path.string()); }
inline std::string text_of(const Eigen::Vector3d& v) {
  return "[" + text_of(v.x()) + ", " + text_of(v.y()) + ", " + text_of(v.z()) + "]";
}
template <class T>
std::string text_of(const std::vector<T>& list) {
  return list.empty() ? "none" : std::to_string(list.size());
}
template <class T>
std::string text_of(const std::optional<T>& value) {
  return value ? text_of(*value) : "none";
}

template <class At>
struct Number {
  At at;
  Limits limits;
  static constexpr Kind kind = Kind::number;
  std::string range() const { return range_text(limits).substr(2) + (limits.infinite ? ", or inf" : ""); }
  void read(SettingsTable& table, const char* key, auto& target) const {
    table.read(key, at(target), limits);
  }
  std::string usual(const auto& fresh) const { return text_of(at(fresh)); }
};

template <class At>
struct Whole {
  At at;
  int least, most;
  static constexpr Kind kind = Kind::whole;
  std::string range() const { return std::to_string(least) + " to " + std::to_string(most); }
  void read(SettingsTable& table, const char* key, auto& target) const {
    table.read(key, at(target), least, most);
  }
  std::string usual(const auto& fresh) const { return std::to_string(at(fresh)); }
};

/// What its type alone says how to read: a text, a path, a vector, a list of texts.
template <class At>
struct Plain {
  Kind kind;
  std::string words;
  At at;
  std::string range() const { return words; }
  void read(SettingsTable& table, const char* key, auto& target) const { table.read(key, at(target)); }
  std::string usual(const auto& fresh) const { return text_of(at(fresh)); }
};

template <class At>
Plain<At> plain(At at, Kind kind, const std::string& words) {
  return {kind, words, at};
}
template <class At>
Plain<At> text(At at) {
  return {Kind::text, "text", at};
}
template <class At>
Plain<At> path(At at) {
  return {Kind::path, "file", at};
}
template <class At>
Plain<At> vector(At at, const std::string& unit) {
  return {Kind::vector, "[x, y, z]" + (unit.empty() ? "" : " [" + unit + "]"), at};
}

template <class Value, class At>
struct Choice {
  At at;
  std::vector<std::pair<std::string, Value>> words;
  GoneWords gone;
  static constexpr Kind kind = Kind::choice;
  std::string range() const {
    std::string list;
    for (const auto& [word, value] : words) list += (list.empty() ? "`" : ", `") + word + "`";
    return list;
  }
  void read(SettingsTable& table, const char* key, auto& target) const {
    table.choose<Value>(key, at(target), words, gone);
  }
  std::string usual(const auto& fresh) const {
    const auto found = std::find_if(words.begin(), words.end(),
                                    [&](const auto& word) { return word.second == Value(at(fresh)); });
    return found == words.end() ? "none" : found->first;
  }
};
template <class Value, class At>
Choice<Value, At> choice(At at, std::vector<std::pair<std::string, Value>> words, GoneWords gone = {}) {
  return {at, std::move(words), std::move(gone)};
}

/// true and false, for a field with a value for each.
template <class At, class Value>
struct Switch {
  At at;
  Value off, on;
  static constexpr Kind kind = Kind::yes_no;
  std::string range() const { return "true, false"; }
  void read(SettingsTable& table, const char* key, auto& target) const {
    bool is_on = at(target) == on;
    table.read(key, is_on);
    at(target) = is_on ? on : off;
  }
  std::string usual(const auto& fresh) const { return at(fresh) == on ? "true" : "false"; }
};

/// What has a reader of its own: a function of the table, the key and the target.
template <class Read>
struct Own {
  Kind kind;
  std::string words;
  Read read;
  std::string range() const { return words; }
  std::string usual(const auto&) const { return "none"; }
};

template <class At>
Number<At> number(At at, const Limits& limits) {
  return {at, limits};
}
template <class At>
Whole<At> whole(At at, int least, int most) {
  return {at, least, most};
}
template <class At, class Value>
Switch<At, Value> yes_no(At at, Value off, Value on) {
  return {at, off, on};
}
template <class Read>
Own<Read> own(Kind kind, const std::string& words, Read read) {
  return {kind, words, read};
}

/// A T that nothing was said of.
template <class T>
T fresh() {
  return {};
}

/// A setting, and how it is read into a T.
template <class T>
struct Row {
  Setting setting;
  std::string key;
  std::function<void(SettingsTable&, const char* key, T&)> read;

  template <class Value>
  Row(Setting words, Value value) : setting(std::move(words)), key(setting.key()) {
    setting.kind = value.kind;
    setting.range = value.range();
    if (setting.usual.empty()) setting.usual = value.usual(fresh<T>());
    read = [value](SettingsTable& table, const char* name, T& target) { value.read(table, name, target); };
  }
};

/// Reads the settings of the table `name` into the target, in the order of the rows.
template <class T>
void read_rows(SettingsTable& table, const std::string& name, std::span<const Row<T>> rows, T& target) {
  for (const Row<T>& row : rows)
    if (row.setting.table() == name) row.read(table, row.key.c_str(), target);
}

}  // namespace furrow::io
