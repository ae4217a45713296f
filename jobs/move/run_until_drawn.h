// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <optional>

#include "jobs/base/read_inputs.h"

namespace furrow::jobs {

/// Runs a scene until its last lines are drawn, or to its end, and writes nothing: the garment as it is then;
/// nothing if it was cancelled. Throws std::runtime_error if it diverges.
std::optional<io::SavedState> run_until_drawn(const OpenScene& scene, const Context& context);

}  // namespace furrow::jobs
