// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "bridge/keeping/keep.h"
#include "jobs/base/inputs.h"

namespace furrow::jobs {

/// A rest state's balance and stability.
Json to_json(const physics::PrestressReport& rest, const physics::Certificate& certificate);
/// The same, with what was done for it.
Json to_json(const bridge::KeptShape& kept);

}  // namespace furrow::jobs
