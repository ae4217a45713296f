// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <span>

#include "cli/common.h"
#include "io/picture/render.h"

namespace furrow::cli {

/// From where a picture is taken, how large it is and how it is made.
struct CameraArguments {
  std::string view = "three-quarter", eye, target, up_vector, size = "1200,1200", quality = "normal", camera,
              save_camera;
  double field_of_view = io::View{}.field_of_view_deg;
  std::optional<double> parallel;
  double thickness = io::RenderOptions{}.thickness;
  int oversample = 1;
  bool wire = false;
};
void add_camera_options(CLI::App& sub, CameraArguments& camera);

/// Options for scenes that are to be seen from one camera: of its file, or as told, or the automatic one.
/// Throws UsageError for options that exclude each other or are out of range.
io::RenderOptions render_options(std::span<const io::RenderScene> scenes, const CameraArguments& camera);

/// Writes the camera to its file if that is wanted, and says it for a report.
Json save_camera(const io::RenderOptions& options, const CameraArguments& camera);

}  // namespace furrow::cli
