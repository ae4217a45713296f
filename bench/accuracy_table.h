// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <fstream>
#include <iostream>
#include <stdexcept>
#include <string>

namespace furrow::bench {

/// A CSV file: a line "# comment", the heading, then rows. It prints its name on standard output.
class Table {
 public:
  Table(const std::string& path, const std::string& comment, const std::string& heading) : file_(path) {
    if (!file_) throw std::runtime_error(path + ": cannot be written");
    file_.precision(12);
    file_ << "# " << comment << '\n' << heading << '\n';
    std::cout << path << std::endl;
  }
  template <typename First, typename... Rest>
  void row(const First& first, const Rest&... rest) {
    file_ << first;
    ((file_ << ',' << rest), ...);
    file_ << std::endl;
  }

 private:
  std::ofstream file_;
};

void write_patch(const std::string& folder);         ///< spring laws x jitter
void write_oscillations(const std::string& folder);  ///< chains, leapfrog, limits, membranes, plates
void write_friction(const std::string& folder);      ///< incline, capstan, tablecloth, braking
void write_twist(const std::string& folder);         ///< ribbons

}  // namespace furrow::bench
