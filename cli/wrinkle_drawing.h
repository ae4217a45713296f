// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "cli/camera_options.h"
#include "cli/common.h"
#include "cli/scene_flags.h"
#include "cli/smoothing_options.h"
#include "geometry/fold/wrinkle.h"
#include "io/scene/scene.h"
#include "io/scene/state_file.h"
#include "io/stroke/drawn_stroke.h"

namespace furrow::cli {

struct WrinkleArguments : CommonArguments {
  std::string in, strokes, state, inserted, preview;
  std::vector<std::string> without;
  double height = geometry::Stroke{}.height, fade = io::SceneLines{}.fade;
  std::string rule = "safe", rest = "drawn", region = "two-ring";
  std::optional<double> density;
  std::optional<int> max_weights;
  geometry::WrinkleOptions options;
  SmoothingArguments smoothing;
  SceneFlags flags;  ///< of --rest keep
  CameraArguments camera;
  const CLI::App* typed = nullptr;  ///< what was on the command line
};

/// A garment, perhaps in motion, and the strokes to be drawn on it.
struct Drawing {
  io::MeshFile file;
  std::string path;
  std::vector<io::DrawnStroke> strokes;
  std::optional<io::SavedState> state;  ///< its mesh is in `file`
};

/// The flags of `wrinkle` that say how lines are drawn, but for those of smoothing.
void add_drawing_options(CLI::App& sub, WrinkleArguments& a);
geometry::WrinkleOptions to_options(const WrinkleArguments& a);

/// Reads garment or state and strokes; or, without strokes, the garment that a wrinkled mesh was made of, and
/// its strokes and options again, over which those of the command line go. Throws UsageError for flags that
/// contradict each other, geometry::ContentError for files that do.
Drawing read_drawing(WrinkleArguments& a);

}  // namespace furrow::cli
