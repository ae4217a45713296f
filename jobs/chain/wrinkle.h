// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "bridge/keeping/draw_more.h"
#include "bridge/keeping/keep.h"
#include "geometry/fold/wrinkle.h"
#include "geometry/rest/rest_state.h"
#include "io/scene/scene.h"
#include "io/scene/state_file.h"
#include "jobs/base/ends.h"
#include "jobs/draw/drawn_round.h"

namespace furrow::geometry {
struct CrossingMemory;
}

namespace furrow::jobs {

/// Ridge and valley lines to be drawn on a garment, or into a simulation that was stopped.
struct WrinkleJob {
  MeshInput garment;  ///< not used where there is a state
  StrokeInput strokes;
  Frame frame = {};                         ///< of the files read and written
  std::optional<io::SavedState> state;      ///< drawn into, in place of the garment
  std::filesystem::path state_path;         ///< where it was read from
  std::vector<std::string> without = {};    ///< names of strokes that are left out
  double height = io::SceneLines{}.height;  ///< of strokes that name none [m]; > 0 ridge, < 0 valley
  std::optional<double> width;  ///< of the fold of strokes that name none [m], > 0; none: some five heights,
                                ///< or as smoothing makes it
  double fade = io::SceneLines{}.fade;  ///< with a state: tau of the forces of the new lines [s]; > 0
  geometry::WrinkleOptions options = {};
  std::optional<double> density;   ///< of the cloth [kg/m^2]; none: as the garment notes, else the default
  std::optional<int> max_weights;  ///< skin weights that each vertex keeps; none: as interpolated
  std::optional<SceneInput> keep;  ///< the drawn shape is made to bear its weight under these settings
  /// What is drawn comes to rest as furrow drape lets it, on body or pins of these settings; not with
  /// a state. With keep, too, it is held.
  std::optional<SceneInput> settle = {};
  /// With settle: lines are held as drawn, as far as cloth can (jobs/chain/hold_drawn.h); false: by the rest
  /// state of options.rest alone. Cloth that bends by cross springs has nothing to hold them by.
  bool hold = true;
  /// Without keep and settle, whose scenes say so: which parts go with other cloth, and whether seams that
  /// the file leaves open are one (io::Scene).
  io::SceneAttach attach = {};
  bool join = true;
  /// With settle: body that the garment lies about, from which it is brought to that of these settings, as
  /// drawn; empty: it lies about that one.
  std::filesystem::path made_for = {};
  /// With settle: refinements (Loop) before the lines are drawn, in [0, 4]; none: as many as the gap needs.
  std::optional<int> subdivide = {};
  /// With settle: processor time, drawing included, after which the best state so far is its end [s]; > 0.
  double budget = 60;
  std::filesystem::path smoothed = {};  ///< with settle: the garment as drawn; empty or "-": not written
  std::filesystem::path output;         ///< mesh, or with a state a state, to write; empty or "-": none
  std::filesystem::path inserted;  ///< mesh after insertion and before smoothing; empty or "-": not written
  bool wants_stages = false;       ///< the report has the mesh before and after insertion
  bool wants_quality = true;       ///< and the audit of the rest metric: a fifth of the time
  /// How the garment crosses itself before the lines; none: it is counted, a tenth of the time.
  std::shared_ptr<const CrossedStart> crossed = {};
  /// Of a program that draws on the same garment again and again (geometry/mesh/self_intersections.h).
  std::shared_ptr<geometry::CrossingMemory> crossings = {};
  std::vector<std::string> more_outputs = {};  ///< files that the caller writes: none may replace another
  std::vector<std::string> more_inputs = {};   ///< files that the caller reads: none may be replaced
};

/// Its options, each bound to its field (jobs/base/card.h); and those of them that say how lines are drawn,
/// which are noted in what is drawn.
std::vector<CardRow> card(WrinkleJob& job);
std::vector<CardRow> drawing_card(WrinkleJob& job);

struct Draped;

/// What jobs::wrinkle() did.
struct WrinkleReport {
  DrawnRound drawn;                         ///< the lines; `kept` where the shape is
  io::MeshFile garment;                     ///< with its lines [m], y up
  std::optional<io::SavedState> state;      ///< what goes on from there, where a state was drawn into
  std::optional<WrinkleStages> stages;      ///< where they were wanted
  ClothCrossings crossings;                 ///< of the cloth with itself, as drawn
  std::optional<DrawnQuality> quality;      ///< before the lines, as they were drawn, and after smoothing
  Frame frame;                              ///< of the files written
  std::shared_ptr<const Draped> rest = {};  ///< where it was to come to rest (jobs/rest/drape.h)
  bool budget_spent = false;                ///< that ended the search for rest
  std::vector<Warning> failures = {};       ///< why that is no success; empty: it is
};

/// Draws the lines into the garment (geometry/fold/wrinkle.h) and writes what the job names, each file whole
/// or not at all. Throws physics::Cancelled, nothing written, if the listener cancels; std::invalid_argument
/// for a job that cannot be, geometry::ContentError for files that cannot be used, std::runtime_error for
/// outputs that cannot be written. Cost: below a second for a garment of 10,000 vertices and ten lines.
WrinkleReport wrinkle(const WrinkleJob& job, Listener& listener);

/// The report for programs, and what the command line prints.
Json to_json(const WrinkleReport& report);

}  // namespace furrow::jobs
