// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/help.h"

#include <array>
#include <utility>

namespace furrow::cli {
namespace {

constexpr char for_few = '\t';          // at the end of the name of a group
constexpr std::size_t most_shown = 30;  // a command with no more options than that shows them all
// By the groups, in the order in which --help shows them.
constexpr std::array headings{"Options", "Lines",  "Cloth",   "Body and pins",
                              "Rest",    "Motion", "Picture", "Output"};

bool is_for_few(const CLI::Option& option) { return option.get_group().ends_with(for_few); }

}  // namespace

void begin_group(CLI::App& sub, group name, Audience audience) {
  sub.option_defaults()->group(headings[std::size_t(name)] + std::string(audience == Audience::few, for_few));
}

std::string HelpFormatter::make_help(const CLI::App* app, std::string name, CLI::AppFormatMode mode) const {
  if (mode == CLI::AppFormatMode::Sub) return make_expanded(app);
  const bool all = mode == CLI::AppFormatMode::All || app->get_options().size() <= most_shown;
  std::string text = make_description(app) + make_usage(app, std::move(name)) + make_positionals(app);
  std::size_t left_out = 0;
  for (const std::string heading : headings) {
    std::vector<const CLI::Option*> options;
    for (const std::string& group : {heading, heading + for_few})
      for (const CLI::Option* o : app->get_options()) {
        if (!o->nonpositional() || o->get_group() != group) continue;
        if (all || !is_for_few(*o))
          options.push_back(o);
        else
          ++left_out;
      }
    if (!options.empty()) text += make_group(heading, false, options);
  }
  if (left_out > 0)
    text += "\n" + std::to_string(left_out) + " rarer options: furrow " + app->get_name() + " --help-all\n";
  return text + make_subcommands(app, mode) + "\n" + make_footer(app);
}

}  // namespace furrow::cli
