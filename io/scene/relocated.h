// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <filesystem>

#include "io/scene/scene.h"

namespace furrow::io {

/// The settings of a scene with all paths relative to `target` (or absolute where there is no way). Those of
/// the document are relative to `folder`, but those that a flag set to the working directory, as for
/// read_scene().
Json relocated(const TomlDocument& document, const std::filesystem::path& folder,
               const std::filesystem::path& target);

}  // namespace furrow::io
