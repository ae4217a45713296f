// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <filesystem>
#include <string>
#include <vector>

namespace furrow::io {

/// An option of a case as the plan has it.
struct BatchValue {
  std::string column;              ///< "garment", or the long name of an option without its dashes
  std::vector<std::string> texts;  ///< none: a flag
  std::string words() const;       ///< for people; a flag: "yes"
};

/// One call of furrow.
struct BatchCase {
  std::string name;  ///< 16 hexadecimal digits of what its files hold, its options and the version
  std::vector<BatchValue> values;      ///< of the plan's columns
  std::vector<std::string> arguments;  ///< subcommand, garments, options; files by absolute path, no outputs
  bool has_body = false;               ///< one, that its files name themselves
};

/// Cases to be computed on one machine or many (docs/batches.md).
struct BatchPlan {
  std::string title;
  std::string command;               ///< drape, simulate, keep, wrinkle or fit
  std::filesystem::path output;      ///< folder of results, absolute
  std::string mesh = "ply";          ///< ending of the meshes written; "": none
  bool picture = true;               ///< one of each case, where the command draws one
  std::vector<std::string> report;   ///< figures in the page: paths in the command's report, "fit.strain.p99"
  std::vector<std::string> columns;  ///< that differ from case to case
  std::vector<BatchCase> cases;
  std::size_t repeated = 0;  ///< cases left out as others have the same name

  /// Whether the command draws a picture of what it finds.
  bool draws() const;
};

/// Reads a plan. `version` of the program, on which names depend. Throws geometry::ContentError with file,
/// line and column for an unknown key, a wrong type, a list of cases (CSV) that cannot be read, a file that
/// is missing, or more than a million cases. Cost: each file that cases name is read once.
BatchPlan read_batch_plan(const std::filesystem::path& path, const std::string& version);

}  // namespace furrow::io
