// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <CLI/CLI.hpp>

/// How --help is laid out: options in groups, of which the --help of a command
/// with very many shows what most users need, and --help-all all.
namespace furrow::cli {

/// The groups, in the order in which --help shows them.
namespace group {
inline constexpr const char *lines = "Lines", *cloth = "Cloth", *body = "Body and pins", *rest = "Rest",
                            *motion = "Motion", *picture = "Picture", *output = "Output";
}
enum class Audience { everyone, few };

/// What is added from now on stands in this group.
void begin_group(CLI::App& sub, const char* name, Audience audience = Audience::everyone);
class HelpFormatter : public CLI::Formatter {
 public:
  std::string make_help(const CLI::App* app, std::string name, CLI::AppFormatMode mode) const override;
};

}  // namespace furrow::cli
