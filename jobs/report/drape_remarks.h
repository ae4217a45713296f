// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <span>
#include <vector>

#include "jobs/drape.h"

namespace furrow::jobs {

/// What is to be said of garments that were draped: the body that comes through, a gap that is not kept, what
/// does not rest. Nothing of one that was cancelled, nor of those after it.
std::vector<DrapeRemark> remarks_on(std::span<const Draped> garments);

}  // namespace furrow::jobs
