// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/scene/settings_table.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <sstream>

#include "geometry/mesh/errors.h"
#include "io/base/nearest_word.h"
#include "io/scene/settings_schema.h"

namespace furrow::io {
namespace {

/// Follows a path that exists.
const Json& node_at(const TomlDocument& document, const std::string& path) {
  const Json* at = &*document.root;
  std::istringstream keys(path);
  for (std::string key; std::getline(keys, key, '.');)
    at = at->is_array() ? &(*at)[std::stoul(key)] : &at->at(key);
  return *at;
}

}  // namespace

std::string range_text(const Limits& l) {
  std::ostringstream text;
  text << "a number";
  if (l.least != -no_limit) text << (l.open ? " > " : " >= ") << l.least;
  if (l.most != no_limit) text << (l.least != -no_limit ? " and <= " : " <= ") << l.most;
  if (*l.unit) text << " [" << l.unit << "]";
  return text.str();
}

SettingsTable::SettingsTable(const TomlDocument& document, std::filesystem::path folder, std::string path)
    : document_(document),
      folder_(std::move(folder)),
      path_(std::move(path)),
      node_(&node_at(document, path_)) {
  if (!node_->is_object()) refuse_list(path_, *node_);
}

void SettingsTable::refuse_list(const std::string& path, const Json& item) const {
  const bool tables = item.is_array() && !item.empty() && item[0].is_object();
  throw geometry::ContentError(document_.place(path) + ": " + path +
                               (tables ? " may be there once; write [" + path + "], not [[" + path + "]]" +
                                             (path == "garment" ? "; `furrow drape` alone takes several" : "")
                                       : " = " + value_text(item) + " must be a table of settings" +
                                             (item.is_string() && (path == "garment" || path == "body")
                                                  ? "; write " + path + ".mesh = " + value_text(item)
                                                  : "")));
}

void SettingsTable::fail(const std::string& key, const std::string& what) const {
  const Json* item = node_->contains(key) ? &node_->at(key) : nullptr;
  const std::string value = item && !item->is_object() ? " = " + value_text(*item) : "";
  throw geometry::ContentError(place_of(key) + ": " + path_of(key) + value + " " + what);
}

void SettingsTable::finish() const {
  const std::vector<std::string> words(known_.begin(), known_.end());
  for (const auto& [key, item] : node_->items()) {
    if (known_.count(key)) continue;
    const std::string tables = tables_of_key(key);
    const bool is_fabric = key == "fabric" && known_.count("preset");  // the flag's name
    throw geometry::ContentError(
        place_of(key) + ": there is no setting '" + path_of(key) + "'" +
        (!tables.empty() ? "; '" + key + "' belongs in " + tables
         : words.empty() ? ""
                         : "; did you mean '" + (is_fabric ? "preset" : nearest_word(key, words)) + "'?"));
  }
}

const Json* SettingsTable::find(const char* key) {
  known_.insert(key);
  const auto item = node_->find(key);
  return item == node_->end() ? nullptr : &*item;
}

bool SettingsTable::has(const char* key) { return find(key) != nullptr; }

bool SettingsTable::has_list(const char* key) {
  const Json* item = find(key);
  return item && item->is_array();
}

double SettingsTable::number(const char* key, const Json& item, const Limits& limits) const {
  const double value = item.is_number() ? item.get<double>() : NAN;
  const bool high_enough = limits.open ? value > limits.least : value >= limits.least;
  if (!(std::isfinite(value) || (limits.infinite && std::isinf(value))) || !high_enough ||
      value > limits.most)
    fail(key, "must be " + range_text(limits));
  return value;
}

int SettingsTable::whole(const char* key, const Json& item, int least, int most) const {
  if (!item.is_number_integer() || item.get<std::int64_t>() < least || item.get<std::int64_t>() > most)
    fail(key, "must be a whole number from " + std::to_string(least) + " to " + std::to_string(most));
  return item.get<int>();
}

std::string SettingsTable::text(const char* key, const Json& item) const {
  if (!item.is_string() || item.get<std::string>().empty()) fail(key, "must be a text in quotes");
  return item.get<std::string>();
}

void SettingsTable::read(const char* key, double& value, const Limits& limits) {
  if (const Json* item = find(key)) value = number(key, *item, limits);
}
void SettingsTable::read(const char* key, std::optional<double>& value, const Limits& limits) {
  if (const Json* item = find(key)) value = number(key, *item, limits);
}
void SettingsTable::read(const char* key, int& value, int least, int most) {
  if (const Json* item = find(key)) value = whole(key, *item, least, most);
}
void SettingsTable::read(const char* key, bool& value) {
  const Json* item = find(key);
  if (!item) return;
  if (!item->is_boolean()) fail(key, "must be true or false");
  value = item->get<bool>();
}
void SettingsTable::read(const char* key, std::string& value) {
  if (const Json* item = find(key)) value = text(key, *item);
}

void SettingsTable::read(const char* key, std::filesystem::path& value) {
  const Json* item = find(key);
  if (!item) return;
  const std::filesystem::path given = text(key, *item);
  const bool from_file = document_.is_of_file(path_of(key));
  value = from_file && given != "-" ? (folder_ / given).lexically_normal() : given;
}

void SettingsTable::read_name_or_index(const char* key, std::string& value) {
  const Json* item = find(key);
  if (!item) return;
  if (!item->is_number_integer()) return read(key, value);
  value = std::to_string(whole(key, *item, 0, 1 << 30));
}

void SettingsTable::read(const char* key, std::vector<double>& values, std::size_t count) {
  const Json* item = find(key);
  if (!item) return;
  if (!item->is_array() || item->size() != count)
    fail(key, "must be a list of " + std::to_string(count) + " numbers");
  values.clear();
  for (const Json& element : *item) values.push_back(number(key, element, any()));
}

void SettingsTable::read(const char* key, Eigen::Vector3d& value) {
  std::vector<double> numbers;
  read(key, numbers, 3);
  if (!numbers.empty()) value = {numbers[0], numbers[1], numbers[2]};
}

void SettingsTable::read(const char* key, std::vector<int>& values, int least, int most) {
  const Json* item = find(key);
  if (!item) return;
  if (!item->is_array()) fail(key, "must be a list of whole numbers");
  values.clear();
  for (const Json& element : *item) values.push_back(whole(key, element, least, most));
}

void SettingsTable::read(const char* key, std::vector<std::string>& values) {
  const Json* item = find(key);
  if (!item) return;
  values.clear();
  if (item->is_string()) return values.push_back(text(key, *item));
  if (!item->is_array()) fail(key, "must be a text or a list of texts");
  for (const Json& element : *item) values.push_back(text(key, element));
}

std::size_t SettingsTable::choice(const char* key, const std::vector<std::string>& words,
                                  const GoneWords& gone) {
  const Json* item = find(key);
  if (!item) return words.size();
  const std::string word = text(key, *item);
  const auto at = std::find(words.begin(), words.end(), word);
  if (at == words.end()) {
    for (const auto& [old, help] : gone)
      if (word == old) fail(key, help);
    std::string list;
    for (const std::string& w : words) list += (list.empty() ? "" : ", ") + w;
    fail(key, "is none of " + list + "; did you mean " + nearest_word(word, words) + "?");
  }
  return static_cast<std::size_t>(at - words.begin());
}

std::optional<SettingsTable> SettingsTable::table(const char* key) {
  const Json* item = find(key);
  if (!item) return std::nullopt;
  if (!item->is_object()) refuse_list(path_of(key), *item);
  return SettingsTable(document_, folder_, path_of(key));
}

std::vector<SettingsTable> SettingsTable::tables(const char* key) {
  const Json* item = find(key);
  std::vector<SettingsTable> list;
  if (!item) return list;
  if (item->is_object()) return {SettingsTable(document_, folder_, path_of(key))};
  if (!item->is_array()) fail(key, std::string("must be a list of tables, [[") + path_of(key) + "]]");
  for (std::size_t i = 0; i < item->size(); ++i)
    list.emplace_back(document_, folder_, path_of(key) + "." + std::to_string(i));
  return list;
}

}  // namespace furrow::io
