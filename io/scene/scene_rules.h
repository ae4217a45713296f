// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "io/scene/scene.h"
#include "io/scene/settings_table.h"

/// What settings need of each other; what each may be by itself says settings_schema.cpp. All throw
/// geometry::ContentError that names the place of a setting.
namespace furrow::io {

/// Settings of lines, and options of `wrinkle`, that drawing by this rule would not look at.
std::vector<std::string> options_without_use(geometry::InsertionRule rule);

void check_lines(SettingsTable& table, const Scene& scene);  ///< of the last round
void check_body(SettingsTable& table, const Scene& scene);
void check_material(SettingsTable& table, const Scene& scene);
void check_pins(SettingsTable& table, const Scene& scene);  ///< of the last set
void check_simulation(SettingsTable& table, const Scene& scene);

/// What settle = true, and the output at rest, need of the rest of a scene: a body or pins, and settle.
void check_settle(const Scene& scene, const TomlDocument& document);
/// What rest = "keep", of the garment or of a round of lines, needs of the rest of a scene: hinges.
void check_keep(const Scene& scene, const TomlDocument& document);
/// What it needs besides, when it is done: a body and pins that stand still. lines_drawn: rounds that are in
/// the garment already; < 0: the scene begins.
void check_keep_stands_still(const Scene& scene, const TomlDocument& document, int lines_drawn);

}  // namespace furrow::io
