// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <CLI/CLI.hpp>
#include <string>
#include <vector>

/// What the command line knows of itself, for completion and man pages: nothing is written twice.
namespace furrow::cli {

struct OptionWords {
  std::vector<std::string> names;    ///< "-o", "--output"; of a positional one its name alone: "garment"
  std::string value;                 ///< what it takes: "TEXT", "NUMBER"; "": nothing, it is a flag
  std::vector<std::string> choices;  ///< the words that it takes; empty: any
  std::string help;
  bool is_positional = false, is_required = false, is_repeatable = false;
};

struct CommandWords {
  std::string name;                   ///< "drape"
  std::string summary;                ///< a line
  std::string details;                ///< more lines; "": none
  std::vector<std::string> examples;  ///< calls
  std::vector<OptionWords> options;
};

/// The subcommand, or the program itself.
CommandWords words_of(const CLI::App& app);
/// Its subcommands in the order of --help, but for those that --help does not show.
std::vector<const CLI::App*> shown_subcommands(const CLI::App& app);

/// The completion script for "bash", "zsh" or "fish".
std::string completion_script(const CLI::App& app, const std::string& shell);

/// The page of the program (man section 1), or of one of its subcommands, as roff.
std::string man_page(const CLI::App& app);
std::string man_page(const CLI::App& app, const CLI::App& subcommand);

}  // namespace furrow::cli
