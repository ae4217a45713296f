// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <span>
#include <vector>

#include "jobs/rest/drape.h"

namespace furrow::jobs {

/// What is to be said of garments that were draped: the body that comes through, a gap that is not kept, what
/// does not rest. Nothing of one that was cancelled, nor of those after it.
std::vector<DrapeRemark> remarks_on(std::span<const Draped> garments);

/// What is to be said of garments that were draped over each other: crossings that are left, a garment that
/// lay inside the one that it is worn over, faces that look inwards.
std::vector<DrapeRemark> remarks_on(const DrapedLayers& layers, std::size_t allowed_crossings);

}  // namespace furrow::jobs
