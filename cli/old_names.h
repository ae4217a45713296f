// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <string>
#include <vector>

namespace furrow::cli {

/// An option that was called otherwise before: docs/reports.md has the table.
struct OldName {
  const char* command;
  const char* old_name;  ///< "--compare"
  const char* new_name;  ///< "--fabrics"
  /// Which values it is about: any; shares such as 1%; NAME=VALUE, of which new_name ends in the key that
  /// goes before '=' now.
  enum class Values { any, shares, of_a_name } values = Values::any;
};
const std::vector<OldName>& old_names();

/// The words of a command line with the present names, and a note for each that was an old one.
struct PresentWords {
  std::vector<std::string> words, notes;
};
PresentWords with_present_names(std::vector<std::string> words);

}  // namespace furrow::cli
