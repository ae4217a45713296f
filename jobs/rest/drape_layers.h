// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <span>

#include "jobs/body/world_body.h"
#include "jobs/rest/drape.h"

namespace furrow::jobs {

/// Garments that were draped over each other, the inner ones first.
struct WornOver {
  std::vector<Draped> garments;
  DrapedLayers layers;
};

/// Drapes the garments of several scenes together (bridge/draping/drape_layers.h), the innermost first, and
/// measures how each fits. The scenes differ in garment and material alone; all are refined as often as the
/// one that needs it most, but not at all if one has a rest state of its own and `choose`. names: what they
/// are called. A garment that falls is held where it lay, and told so. Shows progress; an interrupt stops it,
/// what was reached is returned. Throws as drape_garment() does.
WornOver drape_worn_over(std::span<const io::Scene> scenes, std::span<const std::string> names,
                         const BodyCollider* body, const DrapeSettings& settings, bool choose,
                         const Context& context);

}  // namespace furrow::jobs
