// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/base/json_fields.h"

#include <algorithm>
#include <cmath>

#include "geometry/mesh/errors.h"
#include "io/base/nearest_word.h"
#include "io/base/nesting.h"
#include "io/base/text_scanner.h"

namespace furrow::io {
namespace {

/// The library's message without its own marks "[json.exception.…] parse error at line 1, column 2: ".
std::string reason(std::string text) {
  if (const auto end = text.find("] "); text.starts_with('[') && end != text.npos) text.erase(0, end + 2);
  if (const auto colon = text.find(": "); text.starts_with("parse error") && colon != text.npos)
    text.erase(0, colon + 2);
  return text;
}

}  // namespace

void JsonFields::fail(const std::string& what) const {
  throw geometry::ContentError(name_ + ": " + place + what);
}

JsonFields::Json JsonFields::parse(std::string_view text) const {
  if (is_nested_too_deep(text))
    throw geometry::ContentError(name_ + ": no valid JSON: " + too_deep_text() + "; correct it");
  try {
    return Json::parse(text.begin(), text.end());
  } catch (const Json::parse_error& error) {
    const std::size_t at = std::min(error.byte > 0 ? error.byte - 1 : 0, text.size());
    const std::string_view before = text.substr(0, at);
    const auto line = 1 + std::count(before.begin(), before.end(), '\n');
    const auto last = before.rfind('\n');
    const std::size_t column = last == before.npos ? at + 1 : at - last;
    throw geometry::ContentError(name_ + ":" + std::to_string(line) + ":" + std::to_string(column) +
                                 ": no valid JSON: " + reason(error.what()) + "; correct it");
  } catch (const Json::exception& error) {
    throw geometry::ContentError(name_ + ": no valid JSON: " + reason(error.what()) + "; correct it");
  }
}

void JsonFields::check_keys(const Json& object, const std::vector<std::string>& valid) const {
  for (const auto& [key, value] : object.items()) {
    if (std::find(valid.begin(), valid.end(), key) != valid.end()) continue;
    fail("unknown key " + in_quotes(key) + "; did you mean '" + nearest_word(key, valid) + "'?");
  }
}

double JsonFields::number(const Json& value, const char* key) const {
  if (!value.is_number()) fail(std::string("'") + key + "' must hold numbers, holds a " + value.type_name());
  const double x = value.get<double>();
  if (!std::isfinite(x)) fail(std::string("'") + key + "' holds a number that is not finite");
  return x;
}

std::string JsonFields::text(const Json& value, const char* key) const {
  if (!value.is_string()) fail(std::string("'") + key + "' must be a text");
  return value.get<std::string>();
}

bool JsonFields::truth(const Json& value, const char* key) const {
  if (!value.is_boolean()) fail(std::string("'") + key + "' must be true or false");
  return value.get<bool>();
}

std::size_t JsonFields::index(const Json& value, const char* key) const {
  const double x = number(value, key);
  if (!(x >= 0 && x <= 1e15) || x != std::floor(x))
    fail(std::string("'") + key + "' must hold whole numbers, counted from 0, not " + value.dump());
  return static_cast<std::size_t>(x);
}

std::vector<double> JsonFields::numbers(const Json& value, const char* key, std::size_t count,
                                        const char* shape) const {
  if (!value.is_array() || value.size() != count)
    fail(std::string("'") + key + "': " + shape + " are needed");
  std::vector<double> list;
  for (const Json& item : value) list.push_back(number(item, key));
  return list;
}

}  // namespace furrow::io
