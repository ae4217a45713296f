// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "tests/cli/run_furrow.h"

/// A journey is what a user does: one program after the other, with the options that the README gives, in a
/// folder of the user's own, with relative names.
namespace furrow::tests {

/// A scratch folder that is the working directory of the test and its programs as long as this lives.
class Journey {
 public:
  Journey();
  ~Journey();
  Journey(const Journey&) = delete;
  Journey& operator=(const Journey&) = delete;

  /// Copies a file of the source tree into the folder, under its own name or another, and gives that name.
  std::string bring(const std::string& path, const std::string& as = "") const;
  /// Writes the mannequin as the body of meshes/dress_cm.obj or of meshes/tunic.obj: in that garment's unit,
  /// axes and place.
  std::string bring_body_of_dress(const std::string& as) const;
  std::string bring_body_of_tunic(const std::string& as) const;

 private:
  ScratchDirectory scratch_;
  std::filesystem::path before_;
};

/// Runs `furrow ARGUMENTS --json`, requires that it exits with `exit_code`, and gives its report.
nlohmann::json step(const std::string& arguments, int exit_code = 0);

}  // namespace furrow::tests
