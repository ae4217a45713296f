// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "cli/common.h"
#include "cli/scene_flags.h"
#include "io/scene/state_file.h"
#include "jobs/inputs.h"

/// What the command line makes of a scene: what `simulate`, `keep`, `drape` and `chart` share.
namespace furrow::cli {

/// The settings: those of the scene file or the saved state (null: none), then what the command line says.
io::TomlDocument scene_settings(const std::string& in, const std::string& state_path,
                                const std::optional<io::SavedState>& state, const SceneFlags& flags,
                                const CommonArguments& common);

}  // namespace furrow::cli
