// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace furrow::io {

/// Numbers names in the order of their first use, in a list that the caller owns.
class NameTable {
 public:
  /// `names` is empty and outlives the table.
  explicit NameTable(std::vector<std::string>& names) : names_(names) {}

  /// The index of a name, added where new; -1 for the empty name.
  int index(std::string_view name) {
    if (name.empty()) return -1;
    const auto [found, is_new] = known_.emplace(name, static_cast<int>(names_.size()));
    if (is_new) names_.emplace_back(name);
    return found->second;
  }

 private:
  std::vector<std::string>& names_;
  std::map<std::string, int, std::less<>> known_;
};

}  // namespace furrow::io
