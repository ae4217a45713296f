// SPDX-License-Identifier: GPL-3.0-or-later
#include "journey.h"

#include <array>
#include <catch2/catch.hpp>
#include <fstream>
#include <sstream>

namespace furrow::tests {

namespace fs = std::filesystem;

namespace {

using Place = std::array<double, 3>;

/// The mannequin's file with every vertex moved; returns `as`.
std::string write_moved_body(const std::string& as, Place (*moved)(const Place&)) {
  if (const fs::path folder = fs::path(as).parent_path(); !folder.empty()) fs::create_directories(folder);
  std::ifstream in(source_file("meshes/mannequin.obj"));
  std::ofstream out(as);
  for (std::string line; std::getline(in, line); out << line << "\n") {
    if (!line.starts_with("v ")) continue;
    std::istringstream words(line.substr(2));
    Place p;
    words >> p[0] >> p[1] >> p[2];
    p = moved(p);
    line = "v " + std::to_string(p[0]) + " " + std::to_string(p[1]) + " " + std::to_string(p[2]);
  }
  return as;
}

}  // namespace

Journey::Journey() : before_(fs::current_path()) { fs::current_path(scratch_.path()); }
Journey::~Journey() {
  std::error_code ignored;
  fs::current_path(before_, ignored);
}

std::string Journey::bring(const std::string& path, const std::string& as) const {
  const std::string name = as.empty() ? fs::path(path).filename().string() : as;
  if (const fs::path folder = fs::path(name).parent_path(); !folder.empty()) fs::create_directories(folder);
  fs::copy_file(source_file(path), name);
  return name;
}

std::string Journey::bring_body_of_dress(const std::string& as) const {
  return write_moved_body(as, [](const Place& p) { return Place{100 * p[0], -100 * p[2], 100 * p[1]}; });
}
std::string Journey::bring_body_of_tunic(const std::string& as) const {
  return write_moved_body(as, [](const Place& p) { return Place{p[2] + 0.4, p[1] - 0.3, 0.25 - p[0]}; });
}

nlohmann::json step(const std::string& arguments, int exit_code) {
  const Run run = run_furrow(arguments + " --json");
  INFO("furrow " << arguments << "\n" << run.err);
  REQUIRE(run.exit_code == exit_code);
  return nlohmann::json::parse(run.out);
}

}  // namespace furrow::tests
