// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <optional>

#include "io/scene/settings_table.h"
#include "physics/body/rigid_motion.h"

namespace furrow::io {

/// Reads the table `motion` of a body or of pins, if it is there: pivot, keyframes, spin. Throws as
/// SettingsTable does.
void read_motion(SettingsTable& parent, physics::RigidMotion& motion);

/// The table `key`: centre, axis, rate, start, ramp. Throws as SettingsTable does, and for an axis without
/// length.
std::optional<physics::Spin> read_spin(SettingsTable& parent, const char* key);

}  // namespace furrow::io
