// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "io/scene/scene.h"
#include "io/scene/toml_document.h"

namespace furrow::io {

/// What rest = "keep", of the garment or of a round of lines, needs of the rest of a scene: hinges. Throws
/// geometry::ContentError that names the place of that setting.
void check_keep(const Scene& scene, const TomlDocument& document);

/// What it needs besides, when it is done: a body and pins that stand still. lines_drawn: rounds that are in
/// the garment already; < 0: the scene begins. Errors as above.
void check_keep_stands_still(const Scene& scene, const TomlDocument& document, int lines_drawn);

}  // namespace furrow::io
