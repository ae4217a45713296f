// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "jobs/body/world_body.h"
#include "jobs/move/simulate.h"

namespace furrow::jobs {

/// Brings a complete garment to rest (bridge/draping/drape.h, no refinement) on a body (null: none) as it
/// lies at time 0 and on its pins, under the scene's material: its positions change, nothing else. Shows
/// progress. `gap`: that the cloth keeps from the body [m]. Cost: some 20 to 60 factorisations. Throws
/// physics::Cancelled where it is cancelled on the way, and as bridge::gather() and bridge::drape() do.
RestStage rest_stage(io::MeshFile& garment, const io::Scene& scene, const std::vector<std::vector<int>>& pins,
                     const WorldBody* body, double gap, const Context& context);

/// That parts of it rest far below where they lay, and what helps; none: none does.
std::optional<Fault> words_of_fall(const io::Scene& scene, const RestStage& stage);

/// "not at rest" before it moved, and what helps.
Fault words_of_unrest(const io::Scene& scene, const RestStage& stage, bool moved);

Json to_json(const RestStage& stage);

}  // namespace furrow::jobs
