// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "cli/camera_options.h"
#include "cli/common.h"
#include "cli/scene_flags.h"
#include "cli/smoothing_options.h"
#include "geometry/fold/wrinkle.h"
#include "io/scene/scene.h"
#include "jobs/chain/wrinkle.h"

namespace furrow::cli {

struct WrinkleArguments : CommonArguments {
  std::string in, strokes, state, inserted, smoothed, made_for, subdivide, preview;
  std::vector<std::string> without;
  double height = geometry::Stroke{}.height, fade = io::SceneLines{}.fade;
  std::string rule = "fold", rest = "drawn", region = "two-ring", detail = "normal";
  std::optional<double> width, density;
  std::optional<int> max_weights;
  geometry::WrinkleOptions options;
  SmoothingArguments smoothing;
  bool settle = false;
  double budget = jobs::WrinkleJob{}.budget;
  SceneFlags flags;  ///< of --rest keep and --settle
  CameraArguments camera;
  const CLI::App* typed = nullptr;  ///< what was on the command line
};

/// The flags of `wrinkle` that say how lines are drawn, but for those of smoothing.
void add_drawing_options(CLI::App& sub, WrinkleArguments& a);
geometry::WrinkleOptions to_options(const WrinkleArguments& a);

/// Takes over the options that a wrinkled mesh was made with; those of the command line go over them.
void take_recorded_options(WrinkleArguments& a, const std::string& recorded);

}  // namespace furrow::cli
