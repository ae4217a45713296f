// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace furrow::io {

/// What became of a program that was run.
struct ProgramRun {
  int exit_code = 0;             ///< -1 if a signal ended it
  int signal = 0;                ///< that ended it; 0: none
  double seconds = 0;            ///< of the clock [s]
  double processor_seconds = 0;  ///< of it and its children [s]
  std::size_t peak_bytes = 0;    ///< of resident memory
  std::string out, err;          ///< what it wrote
};

/// Runs a program, standard input closed, and waits for its end. What it writes goes through unnamed files in
/// the system's folder for such. `program` is looked for in PATH if it has no slash. Throws
/// std::runtime_error if it cannot be started.
ProgramRun run_program(const std::filesystem::path& program, const std::vector<std::string>& arguments);

/// The file of the program that runs; empty where the system does not tell.
std::filesystem::path this_program();

}  // namespace furrow::io
