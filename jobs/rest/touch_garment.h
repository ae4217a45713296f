// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <span>

#include "jobs/rest/drape_plan.h"

namespace furrow::jobs {

/// Does the touches of the settings, and of their file, to a garment, one after the other. After each, the
/// cloth around it comes to rest at this gap from the body [m] and off other cloth, while all farther cloth
/// is held as it lies. Returns what each came to, without what remains of it. Throws
/// std::invalid_argument, naming the touch, for one that takes hold of nothing; geometry::ContentError for a
/// garment that has no rest state, as it does not rest yet; physics::Cancelled if interrupted.
std::vector<TouchReport> touch_garment(GivenGarment& garment, const BodyCollider* body,
                                       const DrapeSettings& settings, double gap, const Context& context);

/// What remains of each in the garment at rest, where no later touch took hold, wherever that lies; not known
/// where vertices were taken out.
void measure_remains(const geometry::Mesh& at_rest, std::vector<TouchReport>& touches);

/// For reports, without places.
Json to_json(const std::vector<TouchReport>& touches);

}  // namespace furrow::jobs
