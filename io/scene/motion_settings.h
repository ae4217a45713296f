// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <optional>
#include <vector>

#include "io/scene/settings_schema.h"
#include "io/scene/settings_table.h"
#include "physics/motion/wind.h"

/// Tables that are written inside others: motion with its keyframes, spin, gusts. All throw as SettingsTable
/// does.
namespace furrow::io {

/// Their rows of the schema, as "spin.rate".
std::vector<Setting> settings_of_motion();

/// The table `key` of a body or of pins, if it is there.
void read_motion(SettingsTable& parent, const char* key, physics::RigidMotion& motion);
/// Throws also for an axis without length.
std::optional<physics::Spin> read_spin(SettingsTable& parent, const char* key);
/// Throws also for times that do not increase.
void read_gusts(SettingsTable& parent, const char* key, std::vector<physics::Gust>& gusts);

}  // namespace furrow::io
