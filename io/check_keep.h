// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "io/scene.h"
#include "io/toml_document.h"

namespace furrow::io {

/// What rest = "keep", of the garment or of a round of lines, needs of the rest of a scene: hinges, and a
/// body and pins that stand still. Throws geometry::ContentError that names the place of that setting.
void check_keep(const Scene& scene, const TomlDocument& document);

}  // namespace furrow::io
