// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "cli/common.h"
#include "cli/scene_flags.h"
#include "io/scene/scene.h"
#include "io/scene/state_file.h"
#include "io/scene/toml_document.h"

/// From a file's name to a scene that can be run: what `simulate`, `keep` and `chart` share.
namespace furrow::cli {

/// Whether the name is that of a scene file: it ends in .toml.
bool is_scene(const std::string& path);

/// The settings: those of the scene file or the saved state (null: none), then what the command line says.
io::TomlDocument scene_settings(const std::string& in, const std::string& state_path,
                                const std::optional<io::SavedState>& state, const SceneFlags& flags,
                                const CommonArguments& common);

/// The document as a scene. Throws UsageError for a fault of a flag, geometry::ContentError for one of the
/// file.
io::Scene scene_of(const io::TomlDocument& document, const std::filesystem::path& folder);

/// A garment that notes its unit brings it for the body, the strokes and what is written. Reads the file's
/// header.
void take_noted_frame(io::Scene& scene, io::TomlDocument& document);

/// Throws geometry::ContentError for a file that a scene or a state names and that is not there, and says
/// where it is named. `lines_drawn`: rounds of a state that need no file any more; -1: there is no state.
void check_inputs(const io::Scene& scene, const io::TomlDocument& document, int lines_drawn);

}  // namespace furrow::cli
