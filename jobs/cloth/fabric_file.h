// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <filesystem>

#include "io/scene/scene.h"

namespace furrow::jobs {

/// Where material.preset names a file (.toml), as `furrow fabric fit` writes it, puts the settings of that
/// file's [material] in its place; what the document says beside it goes before them. `folder`: as for
/// io::read_scene(). Throws geometry::ContentError for a file that cannot be read, has no [material], or
/// names another file in turn.
void take_fabric_file(io::TomlDocument& document, const std::filesystem::path& folder);

}  // namespace furrow::jobs
