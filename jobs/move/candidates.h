// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "io/scene/scene.h"
#include "jobs/base/read_inputs.h"
#include "jobs/cloth/scene_cloth.h"
#include "jobs/move/chart.h"

namespace furrow::jobs {

/// What is tried on a scene: leapfrog at 0.9 and 0.45 of the limit, rk4 at 0.9, backward
/// Euler at 1/60, 1/240, 1/960 s, XPBD at 1/240, 1/1200 s where the cloth is of springs alone (both with the
/// scene's iterations), implicit at 1/60, 1/240 s, TR-BDF2 at 1/60, 1/120 s, and last what the scene itself
/// says if that is none of these. `dt_limit` is leapfrog's [s].
std::vector<Candidate> candidates_for(const SceneCloth& scene, double dt_limit);
/// Leapfrog at a quarter of the cheapest explicit step, 0.225 of the limit (or of what dt_max leaves of it).
Candidate reference_candidate(const SceneCloth& scene, double dt_limit);

/// The scene's options with the candidate's, to run for `seconds`.
physics::SimulateOptions options_of(const Candidate& candidate, const SceneCloth& scene, double seconds);

/// "`integrator=leapfrog` `dt=0.0001`": what makes `furrow simulate SCENE` run so. `scene_dt`: the scene
/// names a step, so that one must be named in its place.
std::string flags_of(const Candidate& candidate, bool scene_dt);
/// The same as settings of a document.
void set_candidate(io::TomlDocument& document, const Candidate& candidate);
/// As a scene file names it.
const char* name_of(physics::Integrator integrator);

/// Seconds of one thread that a run of this length takes by the table in cost_table.h, before it [s]. Where
/// there is a body, half of the vertices that are near it at the start, or a tenth of all, ask for its
/// distance in a step.
double predicted_cost(const Candidate& candidate, const SceneCloth& scene, double seconds);
/// And after it, from what it counted [s].
double counted_cost(const physics::SimulateReport& report, const Candidate& candidate,
                    const SceneCloth& scene);

}  // namespace furrow::jobs
