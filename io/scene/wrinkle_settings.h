// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "io/scene/scene.h"
#include "io/scene/settings_table.h"

namespace furrow::io {

/// Reads how a round of lines is drawn and what it does to the rest state: the keys that `furrow wrinkle` has
/// as flags. Throws as SettingsTable does.
void read_wrinkle_options(SettingsTable& table, SceneLines& lines);

}  // namespace furrow::io
