// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace furrow::io {

/// Reads JSON strictly: unknown keys, wrong types and numbers that are not finite are errors, which say
/// where. All functions throw geometry::ContentError "NAME: PLACE WHAT".
class JsonFields {
 public:
  using Json = nlohmann::ordered_json;
  explicit JsonFields(std::string name) : name_(std::move(name)) {}

  std::string place;  ///< what an error says after the file's name: "stroke 3: "
  [[noreturn]] void fail(const std::string& what) const;

  /// The file's text; a fault is named with line and column.
  Json parse(std::string_view text) const;
  /// Refuses keys that are not in the list, and names the nearest one that is.
  void check_keys(const Json& object, const std::vector<std::string>& valid) const;
  double number(const Json& value, const char* key) const;
  std::string text(const Json& value, const char* key) const;
  bool truth(const Json& value, const char* key) const;
  /// A whole number >= 0.
  std::size_t index(const Json& value, const char* key) const;
  /// `count` numbers; `shape` says which: "three numbers [x, y, z]".
  std::vector<double> numbers(const Json& value, const char* key, std::size_t count, const char* shape) const;
  const std::string& name() const { return name_; }

 private:
  std::string name_;
};

}  // namespace furrow::io
