// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <string>

#include "io/scene/scene.h"

namespace furrow::io {

/// The command line that says the same as these settings, without the program's name: flags where there is
/// one, --set for the rest. With a state: what differs from the settings that the state had.
std::string equivalent_flags(const Json& settings, const std::string& state, const Json& before);

}  // namespace furrow::io
