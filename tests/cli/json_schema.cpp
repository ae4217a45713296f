// SPDX-License-Identifier: GPL-3.0-or-later
#include "json_schema.h"

#include <algorithm>
#include <set>
#include <stdexcept>

namespace furrow::tests {
namespace {

using nlohmann::json;
using Faults = std::vector<std::string>;

bool is_of_type(const json& value, const std::string& type) {
  if (type == "null") return value.is_null();
  if (type == "boolean") return value.is_boolean();
  if (type == "integer") return value.is_number_integer();
  if (type == "number") return value.is_number();
  if (type == "string") return value.is_string();
  if (type == "array") return value.is_array();
  if (type == "object") return value.is_object();
  throw std::logic_error("schema: unknown type " + type);
}

void check_keywords(const json& schema) {
  static const std::set<std::string> known{
      "$schema", "$ref",  "$defs",      "title",    "description",          "anyOf",  "enum",
      "type",    "items", "properties", "required", "additionalProperties", "minimum"};
  for (const auto& [key, part] : schema.items())
    if (!known.count(key)) throw std::logic_error("schema: the checker does not know the keyword " + key);
}

void add(Faults& faults, Faults more) { faults.insert(faults.end(), more.begin(), more.end()); }

void check_object(const json& value, const json& schema, const json& root, const std::string& place,
                  Faults& faults) {
  const json properties = schema.value("properties", json::object());
  for (const json& key : schema.value("required", json::array()))
    if (!value.contains(key.get<std::string>())) faults.push_back(place + ": lacks " + key.dump());
  for (const auto& [key, item] : value.items()) {
    if (properties.contains(key))
      add(faults, schema_faults(item, properties[key], root, place + "/" + key));
    else if (schema.contains("additionalProperties") && schema["additionalProperties"] == false)
      faults.push_back(place + ": has '" + key + "', which the schema does not know");
  }
}

}  // namespace

Faults schema_faults(const json& value, const json& schema, const json& root, const std::string& place) {
  check_keywords(schema);
  Faults faults;
  if (schema.contains("$ref"))
    add(faults, schema_faults(value, root.at(json::json_pointer(schema["$ref"].get<std::string>().substr(1))),
                              root, place));
  if (schema.contains("anyOf")) {
    Faults of_all;
    bool fits = false;
    for (const json& part : schema["anyOf"]) {
      const Faults of_one = schema_faults(value, part, root, place);
      fits = fits || of_one.empty();
      add(of_all, of_one);
    }
    if (!fits) add(faults, of_all);
  }
  if (schema.contains("enum") &&
      std::find(schema["enum"].begin(), schema["enum"].end(), value) == schema["enum"].end())
    faults.push_back(place + ": " + value.dump() + " is none of " + schema["enum"].dump());
  if (schema.contains("type")) {
    const json types = schema["type"].is_array() ? schema["type"] : json::array({schema["type"]});
    if (std::none_of(types.begin(), types.end(),
                     [&](const json& type) { return is_of_type(value, type.get<std::string>()); }))
      faults.push_back(place + ": " + value.dump().substr(0, 60) + " is no " + schema["type"].dump());
  }
  if (schema.contains("minimum") && value.is_number() && value < schema["minimum"])
    faults.push_back(place + ": " + value.dump() + " is below " + schema["minimum"].dump());
  if (value.is_object()) check_object(value, schema, root, place, faults);
  if (value.is_array() && schema.contains("items"))
    for (std::size_t i = 0; i < value.size(); ++i)
      add(faults, schema_faults(value[i], schema["items"], root, place + "/" + std::to_string(i)));
  return faults;
}

json parse_strictly(const std::string& text) {
  std::vector<std::set<std::string>> keys;
  return json::parse(text, [&](int, json::parse_event_t event, json& parsed) {
    if (event == json::parse_event_t::object_start) keys.emplace_back();
    if (event == json::parse_event_t::object_end) keys.pop_back();
    if (event == json::parse_event_t::key && !keys.back().insert(parsed.get<std::string>()).second)
      throw std::runtime_error("the key " + parsed.dump() + " stands twice in one object");
    return true;
  });
}

}  // namespace furrow::tests
