// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "io/scene/scene.h"
#include "io/scene/toml_document.h"
#include "jobs/context.h"

/// From settings to a scene that can be run: what `simulate`, `keep` and `chart` share.
namespace furrow::jobs {

/// A scene as a job is given it.
struct SceneInput {
  io::TomlDocument settings;     ///< docs/scenes.md; io::read_toml(), io::set_value()
  std::filesystem::path folder;  ///< that the paths in the settings' file are relative to
  MemoryFiles memory = {};       ///< in place of files
};

/// The scene of a file. Throws as io::read_toml().
SceneInput scene_from_file(const std::filesystem::path& toml);

/// Settings that were read, with what the garment's file notes.
struct OpenScene {
  io::Scene scene;
  io::TomlDocument document;
  std::filesystem::path folder;
  Frame frame;
};

/// Whether the name is that of a scene file: it ends in .toml.
bool is_scene(const std::string& path);

/// The document as a scene. Throws std::invalid_argument for a fault of a flag, geometry::ContentError for
/// one of the file.
io::Scene scene_of(const io::TomlDocument& document, const std::filesystem::path& folder);

/// A garment that notes its unit brings it for the body, the strokes and what is written; one in
/// memory has none. Reads the file's header.
void take_noted_frame(io::Scene& scene, io::TomlDocument& document, const MemoryFiles& memory = {});

/// Throws geometry::ContentError for a file that a scene or a state names and that is not there, and says
/// where it is named. `lines_drawn`: rounds of a state that need no file any more; -1: there is no state.
void check_inputs(const io::Scene& scene, const io::TomlDocument& document, int lines_drawn,
                  const MemoryFiles& memory = {});

}  // namespace furrow::jobs
