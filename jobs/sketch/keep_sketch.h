// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "jobs/sketch/sketch.h"

namespace furrow::jobs {

/// What was found of a line that is to be kept.
struct KeptSketchLine {
  std::string name;
  std::string
      verdict;        ///< "held", "pressed", "strutted", "lowered", "may_hold", "cannot_hold" or "not_known"
  std::string words;  ///< "held with press x10": jobs::words()
  std::optional<std::array<double, 3>> end;  ///< its upper end, as it is shown [m]; none: it has no vertices
};

/// A sketch whose lines were kept.
struct KeptSketch {
  io::MeshFile file;  ///< with the rest state that keeps them [m]
  std::vector<KeptSketchLine> lines;
  bool all_hold = false;
  std::string legend;                ///< what the colours of verdicts mean
  std::vector<std::string> remarks;  ///< of what is wrong with it
};

/// Gives the garment the rest state that keeps the strokes, and the lines that it has already, as
/// jobs::keep() does with its defaults, under the sketch's settings. Throws as keep(); std::invalid_argument
/// where there is no line; physics::Cancelled if the listener cancels, at whatever time.
KeptSketch keep_sketch(const Sketch& sketch, const Json& strokes, Listener& listener);

}  // namespace furrow::jobs
