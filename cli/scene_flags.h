// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <CLI/CLI.hpp>
#include <list>
#include <string>
#include <vector>

#include "io/scene/settings_schema.h"
#include "jobs/base/inputs.h"

namespace furrow::cli {

/// Flags that set settings of a scene: those of io/scene/settings_schema.h, and --set, which sets any.
class SceneFlags {
 public:
  /// Those that the subcommand has, one of io::used_by; --set for those of a garment that moves.
  void add_to(CLI::App& sub, unsigned subcommand);
  /// Writes what was given on the command line into the document, flags first, then --set in their order.
  /// Throws UsageError for a --set without a key or with one that cannot be.
  void apply(io::TomlDocument& document) const;
  /// What was given and this subcommand has, too, as words of a call of it; without outputs and --set.
  std::vector<std::string> words(unsigned subcommand) const;
  std::string first() const;  ///< the name of one of them that was given, but for --set; "": none was

 private:
  struct Given {
    const io::Setting* setting;
    std::string text = {};
    bool is_on = false;  ///< of yes_no
    CLI::Option* option = nullptr;
  };
  void add_pin_flags(CLI::App& sub, unsigned subcommand);

  std::list<Given> given_;  // a list: CLI11 keeps pointers to the texts
  std::vector<std::string> pin_boxes_, pin_loops_, pin_groups_, sets_;
  std::vector<int> pin_vertices_;
};

/// The settings of a scene file, a saved state (null: none) or a garment alone, then what the command line
/// says over them: unit and axis, flags, --set.
io::TomlDocument scene_settings(const std::string& in, const std::string& state_path,
                                const std::optional<io::SavedState>& state, const SceneFlags& flags,
                                const jobs::Frame& frame);

/// Writes each key=value of --set into the document, in their order. Throws UsageError as
/// SceneFlags::apply().
void apply_sets(io::TomlDocument& document, const std::vector<std::string>& sets);

}  // namespace furrow::cli
