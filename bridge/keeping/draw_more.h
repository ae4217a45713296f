// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "bridge/arrays/gather.h"
#include "geometry/fold/wrinkle.h"
#include "physics/motion/simulate.h"

namespace furrow::bridge {

struct DrawMoreOptions {
  geometry::WrinkleOptions wrinkle;
  GatherOptions springs;  ///< as those of the simulation; the presses of the new lines are added
  double fade = 0.3;  ///< of what is left of earlier lines, too; tau of the forces that come with the lines
                      ///< [s]; > 0, may be infinite
};

struct DrawMoreReport {
  geometry::WrinkleReport wrinkle;
  physics::Vec3 momentum_before, momentum_after;  ///< sum of m v over what is not held [kg m/s]
  double mean_strain = 0;   ///< of springs or edges of membrane before, mean |l - L| / L [-]
  double largest_jump = 0;  ///< of the compensated forces [N]
};

/// Stop and draw more (method S1.12): lines are drawn into a cloth that is strained and in motion. The mesh
/// holds the moment: positions, v:velocity, rest lengths and masses. Vertices that are pinned belong in
/// wrinkle.held. The plan of steps and the homes of moved pins must be made anew afterwards. Cost: that of
/// wrinkle(). Throws as wrinkle() and gather() do, and std::invalid_argument if the fade is not > 0; mesh and
/// state are then as they were.
///
/// \details
/// - Strain is carried over. A rest length is its intrinsic value times length after / before displacement
///   and smoothing (method S1.18), so that lines of height 0 leave the cloth isometric.
/// - What the state remembers of vertices that stay where they were (contact, friction, layers that touch)
///   goes on; of those that are new or were moved contact begins where they lie.
/// - New vertices get the interpolated velocity. Then the vertices of the changed faces share a correction
///   that keeps the momentum (masses move when edges flip and when a line adds cloth).
/// - Another triangulation of a strained cloth pulls differently. The difference of the spring forces is
///   added to state.compensation, is subtracted in full at first, and fades in with `fade`.
DrawMoreReport draw_more(geometry::Mesh& mesh, physics::SimulateState& state,
                         std::span<const geometry::Stroke> strokes, const DrawMoreOptions& options,
                         const geometry::StageObserver& observer = {});

}  // namespace furrow::bridge
