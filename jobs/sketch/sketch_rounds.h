// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "jobs/sketch/sketch.h"

namespace furrow::jobs {

/// Adds the strokes, at a time [s], as a round under the options of the sketch's own one to the rounds that
/// are drawn before, and gives all of them to the scene; without strokes, those alone. The strokes are in the
/// scene's memory.
void add_round(const Sketch& sketch, const Json& strokes, double time, Json rounds, SceneInput& scene);

}  // namespace furrow::jobs
