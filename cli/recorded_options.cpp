// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/recorded_options.h"

namespace furrow::cli {

void parse_recorded(CLI::App& options, const std::string& recorded, const CLI::App& typed) {
  std::vector<std::string> again;
  for (const CLI::Option* option : typed.get_options())
    if (option->count() > 0 && !option->get_lnames().empty())
      if (const std::string name = "--" + option->get_lnames()[0]; options.get_option_no_throw(name))
        again.push_back(name + "=" + option->results().back());
  options.parse(recorded);
  options.parse(std::move(again));
}

}  // namespace furrow::cli
