// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "jobs/drape.h"
#include "jobs/run/body.h"

namespace furrow::jobs {

/// Reads a scene's garment, fits it on the body and measures how it fits. Shows progress; an interrupt stops
/// it, what was reached is returned. Bands become struts of the garment, in place of those that its loop had.
/// Throws as reading, bridge::drape() and bridge::fit_report() do.
Draped drape_garment(const io::Scene& scene, const BodyCollider& body, const DrapeSettings& settings,
                     const Context& context);

}  // namespace furrow::jobs
