// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <optional>

#include "bridge/keeping/keep.h"
#include "io/mesh/mesh_file.h"
#include "io/scene/state_file.h"
#include "jobs/base/ends.h"

namespace furrow::jobs {

/// What jobs::keep() did.
struct KeepReport {
  bool settled = false;        ///< on its body first, before a scene's lines were drawn: nothing held it
  bool ran = false;            ///< false: it was cancelled before there were lines to keep
  bridge::KeepReport lines;    ///< verdicts, rest state, certificate
  io::WrinkleRecord record;    ///< of the garment as drawn: names of lines
  io::MeshFile garment;        ///< with its new rest state [m], y up
  ClothCrossings crossings;    ///< of the cloth with itself
  EndFacts end;                ///< of the shape that is kept
  std::filesystem::path mesh;  ///< the settings' output; "-": not written
  std::filesystem::path saved_state;   ///< the same
  Frame frame;                         ///< of the files written
  bool budget_spent = false;           ///< that ended it
  std::vector<Warning> warnings = {};  ///< about the result; those on the way went to the listener

  /// Whether every line stands at the height that was asked for, perhaps with help.
  bool all_hold() const;
};

/// "held", "held with press x10", "held with struts of 3 N/m", "lowered to h = 4.2 mm of 10 mm asked", or
/// "cannot hold: ..." or "not known: interrupted". What is off by more than 5 % is never called held without
/// its height.
std::string words(const bridge::KeptLine& line, const io::WrinkleRecord& record);

Json to_json(const KeepReport& report);

/// A garment whose lines are to be kept: of a scene, or of a saved state.
struct KeepJob {
  SceneInput scene;
  std::optional<io::SavedState>
      state;  ///< with lines drawn on the cloth as it hangs or lies; none: the scene draws
  std::filesystem::path state_path;  ///< where it was read from
  double seconds = 5;                ///< how long each trial runs forward from rest [s]; > 0
  double gust = 12;                  ///< and an acceleration to each of four sides [m/s^2]; >= 0
  double kept = 0.95;                ///< share of its height with which a line holds [-], in (0, 1)
  bool balance = true;               ///< what hangs on a line of pins is first turned into balance
  bool settle = true;  ///< on a body: a garment that it does not hold as it lies comes to rest first
  bool help = true;    ///< press, struts or a lower height where the rest state alone does not hold
  bool whole = false;  ///< what lies between the lines is pressed, too, where it could give way
  std::vector<std::string> more_outputs = {};  ///< files that the caller writes: none may replace another
  double budget = 300;  ///< processor time after which the last rest state is the end [s]; > 0
};

/// Its options (jobs/base/card.h).
std::vector<CardRow> card(KeepJob& job);

/// Gives a garment the rest state that keeps its drawn lines, tells of each whether it will hold
/// (bridge/keeping/keep.h), and writes the mesh and the state that the settings' output names, each file
/// whole or not at all; a mesh named "-" is in the report alone. A job that is cancelled on the way to its
/// lines has nothing to report (`ran`), before its first rest state it throws physics::Cancelled; later, the
/// last one stands. Throws as jobs::simulate().
KeepReport keep(const KeepJob& job, Listener& listener);

}  // namespace furrow::jobs
