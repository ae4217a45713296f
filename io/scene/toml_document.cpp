// SPDX-License-Identifier: GPL-3.0-or-later
#include <toml++/toml.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstring>
#include <nlohmann/json.hpp>
#include <sstream>
#include <stdexcept>

#include "geometry/mesh/errors.h"
#include "geometry/mesh/owned_members.h"
#include "io/base/bytes_file.h"
#include "io/base/nesting.h"
#include "io/scene/scene.h"

template class furrow::geometry::Owned<furrow::io::Json>;

namespace furrow::io {
namespace {

std::string joined(const std::string& path, const std::string& key) {
  return path.empty() ? key : path + "." + key;
}

std::string position(const std::string& name, const toml::source_region& source) {
  return name + ":" + std::to_string(source.begin.line) + ":" + std::to_string(source.begin.column);
}

/// Copies a node and its children, and notes where each stands.
class Copier {
 public:
  explicit Copier(TomlDocument& document) : document_(document) {}

  Json copy(const toml::node& node, const std::string& path) {
    if (!path.empty()) document_.where[path] = position(document_.name, node.source());
    if (const auto* table = node.as_table()) return copy_table(*table, path);
    if (const auto* array = node.as_array()) {
      Json result = Json::array();
      for (std::size_t i = 0; i < array->size(); ++i)
        result.push_back(copy((*array)[i], joined(path, std::to_string(i))));
      return result;
    }
    if (const auto* text = node.as_string()) return text->get();
    if (const auto* whole = node.as_integer()) return whole->get();
    if (const auto* number = node.as_floating_point()) return number->get();
    if (const auto* flag = node.as_boolean()) return flag->get();
    throw geometry::ContentError(position(document_.name, node.source()) + ": " + path +
                                 " is a date or a time; no setting is one");
  }

 private:
  Json copy_table(const toml::table& table, const std::string& path) {
    Json result = Json::object();
    for (const auto& [key, child] : table) {
      const std::string name(key.str());
      result[name] = copy(child, joined(path, name));
      // A value is found by its key's place, which says more than that of the value.
      document_.where[joined(path, name)] = position(document_.name, key.source());
    }
    return result;
  }

  TomlDocument& document_;
};

std::vector<std::string> split(const std::string& path) {
  std::vector<std::string> keys(1);
  for (const char c : path)
    if (c == '.')
      keys.emplace_back();
    else
      keys.back() += c;
  return keys;
}

bool is_index(const std::string& key) {
  return !key.empty() && key.size() < 7 && key.find_first_not_of("0123456789") == std::string::npos;
}

/// The child of `parent` that `key` names, made if it is missing.
Json& child(Json& parent, const std::string& key, const std::string& path) {
  const auto fail = [&](const std::string& why) { throw std::invalid_argument(path + ": " + why); };
  if (key.empty()) fail("an empty key; write table.key");
  if (parent.is_null()) parent = is_index(key) ? Json::array() : Json::object();
  if (parent.is_object()) return parent[key];
  if (!parent.is_array()) fail("'" + key + "' lies in a value that is no table");
  if (!is_index(key)) fail("'" + key + "' lies in an array: write its index from 0");
  const std::size_t index = std::stoul(key);
  if (index > parent.size())
    fail("index " + key + " of an array of " + std::to_string(parent.size()) + "; the next one is " +
         std::to_string(parent.size()));
  if (index == parent.size()) parent.push_back(nullptr);
  return parent[index];
}

/// What the writer of a line that is no TOML may have wanted; the line counts from 1.
std::string advice(const std::string& text, std::size_t line) {
  std::istringstream lines(text);
  std::string found;
  for (std::size_t i = 0; i < line && std::getline(lines, found); ++i) {
  }
  const auto from = [&](std::size_t at) { return found.find_first_not_of(" \t", at); };
  const std::size_t start = from(0), equals = found.find('=');
  if (start != std::string::npos && found[start] == '[') {
    for (const char* list : {"lines", "pins"})
      if (found.compare(start, std::strlen(list) + 2, "[" + std::string(list) + "]") == 0)
        return "several of them are written [[" + std::string(list) + "]] each";
    return "correct it";
  }
  const std::size_t value = equals == std::string::npos ? equals : from(equals + 1);
  const char first = value == std::string::npos ? '0' : found[value];
  if (std::isalpha(static_cast<unsigned char>(first)) || first == '/' || first == '~' || first == '.')
    return "a text needs quotes: " + found.substr(start, equals - start) + "= \"…\"";
  return "correct it";
}

}  // namespace

std::string TomlDocument::place(const std::string& path) const {
  for (std::string at = path; !at.empty(); at.erase(at.rfind('.') == std::string::npos ? 0 : at.rfind('.')))
    if (const auto found = where.find(at); found != where.end()) return found->second;
  return name;
}

bool TomlDocument::is_of_file(const std::string& path) const {
  const std::string here = place(path);
  return here == name || here.rfind(name + ":", 0) == 0;
}

TomlDocument parse_toml(const std::string& text, const std::string& name) {
  TomlDocument document;
  document.name = name;
  if (const int line = line_of_too_long_key(text); line > 0)
    throw geometry::ContentError(name + ":" + std::to_string(line) + ": a key is " + too_deep_text() +
                                 "; no setting is");
  try {
    const toml::table table = toml::parse(text, name);
    document.root = Copier(document).copy(table, "");
  } catch (const toml::parse_error& e) {
    throw geometry::ContentError(position(name, e.source()) + ": " + std::string(e.description()) + "; " +
                                 advice(text, e.source().begin.line));
  }
  return document;
}

TomlDocument read_toml(const std::filesystem::path& path) {
  return parse_toml(read_text(path), path.string());
}

geometry::Owned<Json> empty_table() { return Json::object(); }

TomlDocument document_of(Json root, const std::string& name) {
  TomlDocument document{std::move(root), {}, name};
  const Json flat = document.root->flatten();
  for (const auto& [pointer, item] : flat.items()) {  // "/pins/0/loop"
    std::string path = pointer.empty() ? "" : pointer.substr(1);
    std::replace(path.begin(), path.end(), '/', '.');
    for (; !path.empty(); path.erase(path.rfind('.') == std::string::npos ? 0 : path.rfind('.')))
      document.where[path] = name;
  }
  return document;
}

void make_list(TomlDocument& document, const std::string& key) {
  if (!document.root->contains(key) || !document.root[key].is_object()) return;
  document.root[key] = Json::array({document.root[key]});
  std::map<std::string, std::string> where;
  for (const auto& [path, place] : document.where) {
    if (path.rfind(key + ".", 0) == 0)
      where[key + ".0" + path.substr(key.size())] = place;
    else
      where[path] = place;
  }
  if (where.count(key)) where[key + ".0"] = where[key];
  document.where = std::move(where);
}

void set_value(TomlDocument& document, const std::string& path, Json value, const std::string& where) {
  Json changed = *document.root;  // nothing is changed if a later key fails
  Json* at = &changed;
  const std::vector<std::string> keys = split(path);
  if (keys.size() > most_levels)
    throw std::invalid_argument(path.substr(0, 40) + "…: the key is " + too_deep_text());
  for (const std::string& key : keys) at = &child(*at, key, path);
  *at = std::move(value);
  document.root = std::move(changed);
  std::erase_if(document.where, [&](const auto& entry) { return entry.first.rfind(path + ".", 0) == 0; });
  for (std::string key = path;; key.erase(key.rfind('.'))) {  // a table made on the way was set by the same
    if (key == path || !document.where.count(key)) document.where[key] = where;
    if (key.find('.') == std::string::npos) break;
  }
}

Json parse_value(const std::string& text) {
  try {
    return parse_toml("value = " + text + "\n", "value").root->at("value");
  } catch (const geometry::ContentError&) {
    return text;
  }
}

std::string value_text(const Json& value) {
  std::string text;
  if (value.is_object()) {
    for (const auto& [key, item] : value.items())
      text += (text.empty() ? "{" : ", ") + key + " = " + value_text(item);
    return text.empty() ? "{}" : text + "}";
  }
  if (value.is_array()) {
    for (const Json& item : value) text += (text.empty() ? "[" : ", ") + value_text(item);
    return text.empty() ? "[]" : text + "]";
  }
  if (value.is_number_float() && !std::isfinite(value.get<double>()))  // JSON has no words for these
    return std::isnan(value.get<double>()) ? "nan" : value.get<double>() > 0 ? "inf" : "-inf";
  return value.dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace furrow::io
