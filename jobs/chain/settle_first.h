// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <optional>

#include "io/scene/scene.h"
#include "jobs/base/budget.h"
#include "jobs/base/inputs.h"

namespace furrow::jobs {

/// Brings a scene's garment to rest on its body, at this gap [m], before lines are drawn on it. Returns the
/// files in memory with which the scene, without refinement, then draws: the garment as it rests, with the
/// rest state that it was made with, and the strokes of time 0, moved with the cloth below them. None:
/// nothing carries the garment, or it was cancelled. Cost: that of a drape. Throws as drape_garment() and
/// io::resolve_strokes() do.
std::optional<MemoryFiles> settle_first(const io::Scene& scene, double gap, const Budget& budget,
                                        const Context& context);

/// Warns that a scene's garment was refined so many times before its lines were drawn, as its gap needs.
/// as_given: the option that leaves it as it is.
void warn_of_refining(const io::Scene& scene, int times, const std::string& as_given, const Context& context);

}  // namespace furrow::jobs
