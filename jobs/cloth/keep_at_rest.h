// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "bridge/keeping/keep.h"
#include "io/scene/scene.h"
#include "jobs/base/inputs.h"
#include "jobs/body/world_body.h"

/// --rest keep: the shape of a garment, as drawn, becomes its equilibrium.
namespace furrow::jobs {

/// Whether the scene says so of its garment or of a round of time 0.
bool keeps_first_shape(const io::Scene& scene);

/// Completes the garment and gives it the rest state with which it is in equilibrium as it lies, under the
/// scene's material, gravity and pins and on its body (null: none), at a time [s]. Without a body, what hangs
/// on a line of pins is first turned about it into balance, by at most 0.2 rad; what is nearer to the body
/// than the gap is first brought out to it. settled_gap: at which it has rested on the body so far [m]; 0: on
/// none. `moving`: it is in motion; it keeps its velocities, and no force of earlier lines fades in any more,
/// for the shape bears itself. Threads that have yet to draw a line in are no load, and draw it in
/// afterwards. Warns of a shape that is not stable or that no rest state balances. Throws as
/// bridge::keep_shape() and bridge::gather() do.
bridge::KeptShape keep_at_rest(io::MeshFile& file, const io::Scene& scene,
                               const std::vector<std::vector<int>>& pins, const WorldBody* body, double time,
                               double settled_gap, physics::SimulateState* moving, const Context& context);

/// The motion that nothing holds: "1204 vertices are free to fall or slide, at 0.80 m/s^2 towards (0, -1,
/// 0)".
std::string words(const physics::RigidImbalance& imbalance);

/// Warns that a file of that name holds the shape, and not the rest state that keeps it.
void warn_if_shape_only(const std::filesystem::path& mesh, const Context& context);

}  // namespace furrow::jobs
