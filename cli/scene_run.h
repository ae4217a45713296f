// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <optional>

#include "cli/body.h"
#include "io/scene/scene.h"
#include "io/scene/state_file.h"
#include "io/scene/toml_document.h"

namespace furrow::cli {

/// Runs a scene from its beginning, or from a saved state on: lines are drawn at their times, between them
/// the cloth is simulated; writes what scene.output names and prints the report. `document` is what the scene
/// was read from, `folder` what its paths are relative to, `state_path` where the state was read from.
/// `body`: the scene's, if it is built already. `choice`: what integrator and step were chosen by, for the
/// report; null: by nobody. Returns the exit code.
int run_scene(const io::Scene& scene, const io::TomlDocument& document, const std::filesystem::path& folder,
              std::optional<io::SavedState> state, const std::string& state_path,
              const CommonArguments& common, std::shared_ptr<WorldBody> body = nullptr,
              const Json& choice = {});

/// Runs a scene until its last lines are drawn (or to its end), and writes nothing: the garment as it is
/// then; nothing if it was interrupted. Throws std::runtime_error if it diverges.
std::optional<io::SavedState> run_until_drawn(const io::Scene& scene, const io::TomlDocument& document,
                                              const std::filesystem::path& folder,
                                              const CommonArguments& common);

}  // namespace furrow::cli
