// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <CLI/CLI.hpp>
#include <list>
#include <string>
#include <vector>

#include "io/scene/toml_document.h"

namespace furrow::cli {

/// The flags of `simulate`: each sets one setting of a scene (docs/scenes.md), and --set sets any.
class SceneFlags {
 public:
  /// at_rest: only those that say what a garment hangs in that stands still: material, gravity, pins, body.
  void add_to(CLI::App& sub, bool at_rest = false);
  /// Writes what was given on the command line into the document, flags first, then --set in their order.
  /// Throws UsageError for a --set without a key or with one that cannot be.
  void apply(io::TomlDocument& document) const;
  std::string first() const;  ///< the name of one of them that was given, but for --set; "": none was
  /// --tolerance as a share of the garment, "1%", for which integrator and step are chosen; else "".
  std::string accuracy() const;

 private:
  struct Given {
    const char* path;
    bool is_text;
    std::string flag, text;
    CLI::Option* option = nullptr;
  };
  std::list<Given> given_;  // a list: CLI11 keeps pointers to the texts
  bool force_dt_ = false;
  std::vector<std::string> pin_boxes_, pin_loops_, pin_groups_, sets_;
  std::vector<int> pin_vertices_;
};

/// Writes each key=value of --set into the document, in their order. Throws UsageError as
/// SceneFlags::apply().
void apply_sets(io::TomlDocument& document, const std::vector<std::string>& sets);

/// The command line that says the same as these settings, without the program's name: flags where there is
/// one, --set for the rest. With a state: what differs from the settings that the state had.
std::string equivalent_flags(const io::Json& settings, const std::string& state, const io::Json& before);

}  // namespace furrow::cli
