// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <Eigen/Core>
#include <filesystem>
#include <limits>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "io/scene/scene.h"

namespace furrow::io {

/// What a number may be. The unit stands in messages.
struct Limits {
  double least, most;
  bool open = false;  ///< `least` itself is refused
  const char* unit = "";
  bool infinite = false;  ///< inf is allowed
};
inline constexpr double no_limit = std::numeric_limits<double>::infinity();
inline constexpr Limits any(const char* unit = "") { return {-no_limit, no_limit, false, unit}; }
inline constexpr Limits not_negative(const char* unit = "") { return {0, no_limit, false, unit}; }
inline constexpr Limits positive(const char* unit = "") { return {0, no_limit, true, unit}; }
/// As messages say it after "must be": "a number > 0 [m]".
std::string range_text(const Limits& limits);

/// Words that were a choice once, each with what a message says of it.
using GoneWords = std::vector<std::pair<std::string, std::string>>;

/// Reads the keys of one table of a document, each with its type and range. Every fault is a
/// geometry::ContentError with file, line and column; a key that nobody read is a fault, too, and the message
/// names the nearest one that there is.
class SettingsTable {
 public:
  /// `folder`: what paths that a file names are relative to.
  SettingsTable(const TomlDocument& document, std::filesystem::path folder, std::string path = "");
  /// Refuses keys that nobody asked for. To be called when all are read.
  void finish() const;

  bool has(const char* key);
  bool has_list(const char* key);  ///< whether it is there as [a, b]
  void read(const char* key, double& value, const Limits& limits);
  void read(const char* key, std::optional<double>& value, const Limits& limits);
  void read(const char* key, int& value, int least, int most);
  void read(const char* key, bool& value);
  void read(const char* key, std::string& value);
  void read(const char* key, std::filesystem::path& value);      ///< as the program can open it
  void read_name_or_index(const char* key, std::string& value);  ///< a text, or a whole number >= 0
  void read(const char* key, Eigen::Vector3d& value);
  void read(const char* key, std::vector<double>& values, std::size_t count);  ///< exactly `count` of them
  void read(const char* key, std::vector<int>& values, int least, int most);
  void read(const char* key, std::vector<std::string>& values);  ///< one string stands for a list of one
  /// One of these words.
  template <class Enum>
  void choose(const char* key, Enum& value, const std::vector<std::pair<std::string, Enum>>& words,
              const GoneWords& gone = {});

  std::optional<SettingsTable> table(const char* key);
  std::vector<SettingsTable> tables(
      const char* key);  ///< an array of tables; one table stands for one of one

  const TomlDocument& document() const { return document_; }
  std::string path_of(const std::string& key) const { return path_.empty() ? key : path_ + "." + key; }
  std::string place_of(const std::string& key) const { return document_.place(path_of(key)); }
  [[noreturn]] void fail(const std::string& key, const std::string& what) const;

 private:
  const nlohmann::ordered_json* find(const char* key);
  [[noreturn]] void refuse_list(const std::string& path, const nlohmann::ordered_json& item) const;
  double number(const char* key, const nlohmann::ordered_json& item, const Limits& limits) const;
  int whole(const char* key, const nlohmann::ordered_json& item, int least, int most) const;
  std::string text(const char* key, const nlohmann::ordered_json& item) const;
  std::size_t choice(const char* key, const std::vector<std::string>& words, const GoneWords& gone);

  const TomlDocument& document_;
  std::filesystem::path folder_;
  std::string path_;
  const nlohmann::ordered_json* node_;
  std::set<std::string> known_;
};

template <class Enum>
void SettingsTable::choose(const char* key, Enum& value,
                           const std::vector<std::pair<std::string, Enum>>& words, const GoneWords& gone) {
  std::vector<std::string> names;
  for (const auto& word : words) names.push_back(word.first);
  if (const std::size_t i = choice(key, names, gone); i < words.size()) value = words[i].second;
}

}  // namespace furrow::io
