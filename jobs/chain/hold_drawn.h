// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "jobs/base/budget.h"
#include "jobs/rest/drape_garment.h"

namespace furrow::jobs {

/// Whether cloth of this material bends by hinges, plain or of a plate: what a rest state and a press act on.
bool can_hold_lines(const io::SceneMaterial& material);

/// Lets a drawn garment come to rest, as drape_garment() does, with the rest state and the least press with
/// which its lines stand as drawn (bridge/keeping/hold_lines.h). Where a line ends below 80 % of its height,
/// or above 125 %, its press rises a step, and the garment comes to rest anew from its drawn shape, as long
/// as the budget has time for that; of all ends the best is returned. Where it would take more than half of
/// the budget to balance what is drawn, that is warned of, and the lines fall as they will. Its file notes
/// each line's press. Lines that the body leaves no room for are warned of first (room_for_lines.h). body:
/// null: it hangs from its pins. Throws as drape_garment() and bridge::hold_lines()
/// do.
Draped hold_drawn(const io::MeshFile& drawn, const io::Scene& scene, const BodyCollider* body,
                  const Budget& budget, const Context& context);

/// Lines that stand between half and 80 % of their height (those below are for lost_lines()): "2 of 5 lines
/// stand lower than they were drawn: ..."; none: no such line.
std::optional<Warning> low_lines(const std::vector<LineReport>& lines);

}  // namespace furrow::jobs
