// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "bridge/gather.h"
#include "geometry/fold/wrinkle.h"
#include "physics/motion/simulate_state.h"

namespace furrow::bridge {

struct DrawMoreOptions {
  geometry::WrinkleOptions wrinkle;
  GatherOptions springs;  ///< as the simulation's; what the new lines press is added
  double fade = 0.3;  ///< of what is left of earlier lines, too; tau of the forces that come with the lines
                      ///< [s]; > 0, may be infinite
};

struct DrawMoreReport {
  geometry::WrinkleReport wrinkle;
  physics::Vec3 momentum_before, momentum_after;  ///< sum of m v over what is not held [kg m/s]
  double mean_strain = 0;   ///< of springs or edges of membrane before, mean |l - L| / L [-]
  double largest_jump = 0;  ///< of the compensated forces [N]
};

/// Stop and draw more (method S1.12): lines are drawn into a cloth that is strained and in motion. Vertices
/// that are pinned belong into wrinkle.held.
///  - The mesh holds the moment: positions, v:velocity, rest lengths and masses. Strain is carried over: a
///    rest length is its intrinsic value times length after / before displacement and smoothing (method
///    S1.18), so that lines of height 0 leave the cloth isometric.
///  - New vertices get the interpolated velocity; then the vertices of the changed faces share what keeps the
///    momentum as it was (masses move when edges flip and when a line adds cloth).
///  - Another triangulation of a strained cloth pulls differently: the difference of the spring forces is
///  added to state.compensation, is taken off in full at first and fades in with
///    `fade`.
///  - The plan of steps and the homes of moved pins are to be made anew.
/// Throws as wrinkle() and gather() do, and std::invalid_argument if the fade is not > 0; mesh and state are
/// then as they were. Cost: that of wrinkle().
DrawMoreReport draw_more(geometry::Mesh& mesh, physics::SimulateState& state,
                         std::span<const geometry::Stroke> strokes, const DrawMoreOptions& options,
                         const geometry::StageObserver& observer = {});

}  // namespace furrow::bridge
