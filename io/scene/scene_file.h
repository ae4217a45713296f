// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "io/scene/scene.h"

namespace furrow::io {

/// Reads the settings of a scene (docs/scenes.md lists them). Paths are relative to `folder`, but those that
/// a flag set (their place names no file) to the working directory. Throws geometry::ContentError with file,
/// line and column for an unknown setting (and names the nearest), a wrong type, a value out of its range, or
/// one that is missing.
Scene read_scene(const TomlDocument& document, const std::filesystem::path& folder);

}  // namespace furrow::io
