// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <optional>

#include "bridge/keeping/draw_more.h"
#include "io/mesh/mesh_file.h"
#include "io/scene/scene.h"
#include "io/stroke/stroke_file.h"
#include "jobs/base/inputs.h"
#include "jobs/draw/drawn_round.h"

namespace furrow::jobs {

/// What a round of lines is drawn into.
struct LineTarget {
  io::MeshFile& file;
  std::string garment;                       ///< the file that it was read from, for drawing it again; or ""
  std::optional<double> density;             ///< [kg/m^2]; none: as before, or the default
  physics::SimulateState* moving = nullptr;  ///< the garment is in motion
  bridge::GatherOptions springs;             ///< of its simulation, if it is
  std::vector<std::vector<int>> pins = {};   ///< of its simulation: these vertices keep their places
};

/// The file that a scene's lines are drawn on, for drawing them again; "": it is refined first, or in memory.
std::string garment_file(const io::Scene& scene, const Context& context);

/// Draws the lines into the garment and notes them in its wrinkle record, going on from earlier rounds: their
/// ids, the mean rest lengths before any line, the density.
LineRound draw_lines(const LineTarget& target, const std::vector<io::DrawnStroke>& strokes,
                     const io::SceneLines& lines, const geometry::StageObserver& observer = {});

/// Leaves out the strokes with these names. Throws std::invalid_argument if none is left.
void leave_out(std::vector<io::DrawnStroke>& strokes, const std::vector<std::string>& names);

/// The strokes of a round, without those that are left out.
std::vector<io::DrawnStroke> read_strokes(const io::SceneLines& lines, const Context& context);

/// The strokes of each round of the scene, so that a fault is known before the work; empty for those before
/// `first`. Warns of rounds that come too late to be drawn.
std::vector<std::vector<io::DrawnStroke>> read_rounds(const io::Scene& scene, int first,
                                                      const Context& context);

/// Writes the stages of a round that the output names; `file` has all but the mesh. All must outlive it.
geometry::StageObserver stage_writer(const io::SceneOutput& output, const io::MeshFile& file,
                                     const Context& context);

}  // namespace furrow::jobs
