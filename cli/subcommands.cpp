// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/subcommands.h"

#include <functional>
#include <map>
#include <stdexcept>

namespace furrow::cli {
namespace {

using AddSubcommand = std::function<void(CLI::App&, int&)>;

/// By place. Sources fill it before main() begins, in an order that the linker chooses.
std::map<int, AddSubcommand>& known_subcommands() {
  static std::map<int, AddSubcommand> known;
  return known;
}

void make_known(int place, AddSubcommand add) {
  if (!known_subcommands().emplace(place, std::move(add)).second)
    throw std::logic_error("two subcommands have the place " + std::to_string(place));
}

}  // namespace

Subcommand::Subcommand(int place, void (*add)(CLI::App&, int&)) { make_known(place, add); }

Subcommand::Subcommand(int place, void (*add)(CLI::App&)) {
  make_known(place, [add](CLI::App& app, int&) { add(app); });
}

void add_subcommands(CLI::App& app, int& exit_code) {
  for (const auto& [place, add] : known_subcommands()) add(app, exit_code);
}

}  // namespace furrow::cli
