// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <csignal>
#include <cstdlib>
#include <iostream>
#include <new>
#include <string>
#include <vector>

#include "cli/common.h"
#include "cli/help.h"
#include "cli/print_text.h"
#include "cli/subcommands.h"
#include "cli/usage_words.h"
#include "geometry/mesh/errors.h"
#include "jobs/base/budget.h"
#include "physics/base/progress.h"

namespace {

using namespace furrow;

bool has_subcommand(const CLI::App& app, const std::string& word) {
  const auto subs = app.get_subcommands({});
  return std::any_of(subs.begin(), subs.end(), [&](const CLI::App* sub) { return sub->get_name() == word; });
}

/// The message for a first word that is no subcommand, with the nearest one.
std::string unknown_subcommand(const CLI::App& app, const std::string& word) {
  std::vector<std::string> names;
  for (const CLI::App* sub : app.get_subcommands({})) names.push_back(sub->get_name());
  const std::string nearest = cli::nearest_of(names, word);
  return "there is no subcommand '" + word + "'" +
         (nearest.empty() ? "; furrow --help lists them" : "; did you mean '" + nearest + "'?");
}

/// The message for words that a subcommand does not know: of an option with the nearest one.
std::string unknown_words(const CLI::App& app) {
  const CLI::App& sub = app.get_subcommands().empty() ? app : *app.get_subcommands().front();
  std::vector<std::string> names;
  for (const CLI::Option* option : sub.get_options())
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  const std::vector<std::string> words = app.remaining(true);
  const std::string word = words.empty() ? "" : words.front().substr(0, words.front().find('='));
  const std::string nearest = word.rfind("--", 0) == 0 ? cli::nearest_of(names, word) : "";
  const std::string command = "furrow" + (&sub == &app ? "" : " " + sub.get_name());
  return word + ": " + command +
         (word.rfind("-", 0) == 0 ? " has no such option" : " takes no further argument") +
         (nearest.empty() ? "; " + command + " --help tells more" : "; did you mean " + nearest + "?");
}

/// The words of the command line, less the first; `furrow` alone and `furrow help [NAME]` ask for help.
std::vector<std::string> words_of(int argc, char** argv) {
  std::vector<std::string> words(argv + 1, argv + argc);
  if (words.empty()) return {"--help"};
  if (words[0] != "help") return words;
  if (words.size() == 1) return {"--help"};
  return {words[1], "--help"};
}

int fail(int code, const std::string& message) {
  std::cerr << "error: " << cli::worded(message) << "\n";
  return code;
}

int run(int argc, char** argv) {
  CLI::App app{
      "Furrow: cloth that wrinkles where you draw.\n"
      "Lengths are metres, masses kilograms, times seconds, unless an option says otherwise.\n\n"
      "  furrow wrinkle shirt.obj lines.json -o wrinkled.ply\n"
      "  furrow simulate wrinkled.ply --body body.obj -o worn.ply\n"
      "  furrow render worn.ply --body body.obj -o worn.png"};
  app.name("furrow");
  app.formatter(std::make_shared<cli::HelpFormatter>());
  app.set_help_all_flag("--help-all", "Print the rarer options, too, and exit");
  app.set_version_flag("-V,--version", cli::version_text());
  app.require_subcommand(1);
  int exit_code = cli::exit_ok;
  cli::add_subcommands(app, exit_code);
  const std::vector<std::string> words = words_of(argc, argv);
  if (words[0].rfind("-", 0) != 0 && !has_subcommand(app, words[0]))
    return fail(cli::exit_usage, unknown_subcommand(app, words[0]));
  try {
    app.parse(std::vector<std::string>(words.rbegin(), words.rend()));  // CLI11 takes them off the end
  } catch (const CLI::Success& e) {
    return app.exit(e);
  } catch (const CLI::ExtrasError&) {
    return fail(cli::exit_usage, unknown_words(app));
  } catch (const CLI::ParseError& e) {
    return fail(cli::exit_usage,
                cli::words_of_error(app, words[0], e.what()) + "; furrow " + words[0] + " --help tells more");
  }
  return exit_code;
}

}  // namespace

int main(int argc, char** argv) {
  std::signal(SIGXFSZ, SIG_IGN);  // a file beyond the user's limit is an error, told like a full disk
  try {
    return run(argc, argv);
  } catch (const jobs::BudgetSpent& e) {
    return fail(cli::exit_not_converged, e.what());
  } catch (const physics::Cancelled&) {
    return fail(cli::exit_interrupted, "interrupted before anything was written");
  } catch (const cli::UsageError& e) {
    return fail(cli::exit_usage, e.what());
  } catch (const std::invalid_argument& e) {
    return fail(cli::exit_usage, e.what());
  } catch (const geometry::ContentError& e) {
    return fail(cli::exit_unreadable, e.what());
  } catch (const std::bad_alloc&) {
    return fail(cli::exit_failed, "not enough memory; try a smaller mesh or a larger --tolerance");
  } catch (const std::exception& e) {
    return fail(cli::exit_failed, e.what());
  }
}
