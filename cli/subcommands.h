// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <CLI/CLI.hpp>
#include <functional>
#include <memory>
#include <string>
#include <type_traits>

#include "cli/common.h"

namespace furrow::cli {

/// Makes a subcommand known to the program. Each stands in a source of its name, which parses, calls a job
/// and prints: `const Subcommand quality_subcommand(70, "quality", "Measure how …", add_quality, quality);`
class Subcommand {
 public:
  /// place: where --help lists it, beside those of smaller and of greater numbers; words: a line, and what
  /// follows it in its own help. add: its options, to which those that all have are added. run: what it does,
  /// with the arguments as they were typed; it returns the exit code, unless that tells of errors alone.
  template <class Arguments, class Run>
  Subcommand(int place, const std::string& name, const std::string& words,
             void (*add)(CLI::App& sub, Arguments&), Run run)
      : Subcommand(place, [=](CLI::App& app, int& exit_code) {
          auto a = std::make_shared<Arguments>();
          CLI::App* sub = app.add_subcommand(name, words);
          add(*sub, *a);
          add_common_options(*sub, *a);
          a->typed = sub;
          sub->callback([a, run, &exit_code] {
            if constexpr (std::is_void_v<std::invoke_result_t<Run, Arguments&>>)
              run(*a);
            else
              exit_code = run(*a);
          });
        }) {}
  /// One that needs the whole program, or has options of its own only.
  Subcommand(int place, std::function<void(CLI::App& app, int& exit_code)> add);
};

/// Adds all subcommands, in the order of their places.
void add_subcommands(CLI::App& app, int& exit_code);

/// The program's version and those of the libraries that it was built with.
std::string version_text();

}  // namespace furrow::cli
