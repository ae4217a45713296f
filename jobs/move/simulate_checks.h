// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "jobs/base/read_inputs.h"
#include "jobs/move/simulate.h"

/// What can be known to fail is said before the work.
namespace furrow::jobs {

/// Reads the job's settings and checks them: that a state goes on with the garment it has, that inputs are
/// there, that outputs can be written and replace no input. Makes the folders of outputs that a scene file
/// names. Warns of cloth that is not what the garment came to rest with.
/// Throws as simulate().
OpenScene open_scene(const SimulateJob& job, Listener& listener);

}  // namespace furrow::jobs
