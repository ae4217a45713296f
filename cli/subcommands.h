// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <CLI/CLI.hpp>
#include <string>

namespace furrow::cli {

/// Makes a subcommand known to the program. Each stands in a source of its name, which parses, calls a job
/// and prints: `const Subcommand quality_subcommand(70, add_quality);`
class Subcommand {
 public:
  /// place: where --help lists it, beside those of smaller and of greater numbers. add: adds it, with what it
  /// does; exit_code is set where that fails in a way of its own.
  Subcommand(int place, void (*add)(CLI::App& app, int& exit_code));
  Subcommand(int place, void (*add)(CLI::App& app));
};

/// Adds all subcommands, in the order of their places.
void add_subcommands(CLI::App& app, int& exit_code);

/// The program's version and those of the libraries that it was built with.
std::string version_text();

}  // namespace furrow::cli
