// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/scene/equivalent_flags.h"

#include <nlohmann/json.hpp>

#include "io/base/field_words.h"
#include "io/scene/settings_schema.h"

namespace furrow::io {
namespace {

std::string quoted(const std::string& text) {
  if (!text.empty() && text.find_first_of(" \t\n'\"\\$`&|;<>()[]{}*?#~!") == std::string::npos) return text;
  std::string result = "'";
  for (const char c : text) result += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return result + "'";
}

/// One setting: its flag, or --set.
std::string setting_flags(const Json& value, const std::string& path) {
  const Setting* setting = find_setting(path);
  if (setting && setting->used == used_by::nobody) return "";
  if (!setting || setting->keyword.empty())
    return " " + flag_of("set", quoted(path + "=" + value_text(value)));
  const std::string name = " " + flag_of(setting->keyword);
  if (setting->kind == Kind::yes_no) return value == true ? name : "";
  return name + " " + quoted(value.is_string() ? value.get<std::string>() : value_text(value));
}

bool is_tables(const Json& value) { return value.is_array() && !value.empty() && value[0].is_object(); }

/// Flags or --set for the value and all below it.
void list_flags(const Json& value, const std::string& path, std::string& text) {
  if (path == "garment.mesh")
    text = " " + quoted(value.get<std::string>()) + text;
  else if (value.is_object())
    for (const auto& [key, item] : value.items())
      list_flags(item, path.empty() ? key : path + "." + key, text);
  else if (is_tables(value))
    for (std::size_t i = 0; i < value.size(); ++i) list_flags(value[i], path + "." + std::to_string(i), text);
  else
    text += setting_flags(value, path);
}

/// What is in `now` and not, or otherwise, in `before`; lists of tables keep their length.
Json difference(const Json& now, const Json& before) {
  Json result = now;
  if (now.is_object() && before.is_object()) {
    for (const auto& [key, item] : now.items()) {
      if (!before.contains(key)) continue;
      if (item == before[key])
        result.erase(key);
      else
        result[key] = difference(item, before[key]);
    }
  } else if (is_tables(now) && is_tables(before) && now.size() == before.size()) {
    for (std::size_t i = 0; i < now.size(); ++i) result[i] = difference(now[i], before[i]);
  }
  return result;
}

}  // namespace

std::string equivalent_flags(const Json& settings, const std::string& state, const Json& before) {
  std::string text;
  list_flags(state.empty() ? settings : difference(settings, before), "", text);
  return "simulate" + (state.empty() ? "" : " " + flag_of("state", quoted(state))) + text;
}

}  // namespace furrow::io
