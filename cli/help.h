// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <CLI/CLI.hpp>

#include "jobs/base/card.h"

/// How --help is laid out: options in groups, of which the --help of a command
/// with very many shows what most users need, and --help-all all.
namespace furrow::cli {

using group = jobs::Group;
using jobs::Audience;

/// What is added from now on stands in this group.
void begin_group(CLI::App& sub, group name, Audience audience = Audience::everyone);
class HelpFormatter : public CLI::Formatter {
 public:
  std::string make_help(const CLI::App* app, std::string name, CLI::AppFormatMode mode) const override;
};

}  // namespace furrow::cli
