// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/subcommands.h"

#include <map>
#include <stdexcept>

namespace furrow::cli {
namespace {

/// By place. Sources fill it before main() begins, in an order that the linker chooses.
std::map<int, std::function<void(CLI::App&, int&)>>& known_subcommands() {
  static std::map<int, std::function<void(CLI::App&, int&)>> known;
  return known;
}

}  // namespace

Subcommand::Subcommand(int place, std::function<void(CLI::App&, int&)> add) {
  if (!known_subcommands().emplace(place, std::move(add)).second)
    throw std::logic_error("two subcommands have the place " + std::to_string(place));
}

void add_subcommands(CLI::App& app, int& exit_code) {
  for (const auto& [place, add] : known_subcommands()) add(app, exit_code);
}

}  // namespace furrow::cli
