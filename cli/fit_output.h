// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <span>
#include <string>
#include <vector>

#include "bridge/fit_report.h"
#include "cli/camera_options.h"
#include "cli/common.h"
#include "io/picture/fit_colours.h"

/// What a fit report becomes outside: JSON, colours, pictures.
namespace furrow::cli {

/// All numbers of a report, SI units; what is not known is null.
Json to_json(const bridge::FitReport& report, const bridge::FitOptions& options);

/// Words for under a picture of a quantity, e.g. "3.0 % of the cloth strained over 5 %\nease: waist +4.1 cm".
std::string fit_words(const bridge::FitReport& report, const bridge::FitOptions& options,
                      io::FitQuantity quantity);

/// The colours that show a report's thresholds: strain to twice tight_strain, distance to 1.2 loose_distance,
/// or to `limit` [-] or [m].
io::FitScale fit_scale(io::FitQuantity quantity, const bridge::FitOptions& options,
                       const std::optional<double>& limit = {});

/// Colours a garment by an attribute that fit_report() wrote. Throws geometry::ContentError if it is missing.
void colour_garment(geometry::Mesh& garment, const io::FitScale& scale);

/// A coloured garment on its body, and the words below.
struct FitPanel {
  const geometry::Mesh* garment = nullptr;
  const geometry::Mesh* body = nullptr;
  std::string caption;
};

/// Panels side by side, from one camera, with one legend. One panel alone, with no view chosen, is shown from
/// the front and from the back.
io::Image fit_picture(std::span<const FitPanel> panels, const io::FitScale& scale,
                      const CameraArguments& camera, bool view_chosen, const CommonArguments& common);

}  // namespace furrow::cli
