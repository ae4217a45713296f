// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <span>
#include <string>
#include <vector>

#include "io/picture/fit_colours.h"
#include "io/picture/render.h"
#include "jobs/rest/fit.h"

/// What a fit report becomes in a picture: colours, panels, words.
namespace furrow::jobs {

/// Words for under a picture of a quantity, e.g. "3.0 % of the cloth strained over 5 %\nease: waist +4.1 cm".
std::string fit_words(const bridge::FitReport& report, const bridge::FitOptions& options, FitColour colour);

/// The colours that show a report's thresholds: strain to twice tight_strain, distance to 1.2 loose_distance,
/// or to `limit` [-] or [m].
io::FitScale fit_scale(FitColour colour, const bridge::FitOptions& options,
                       const std::optional<double>& limit = {});

/// Colours a garment by an attribute that fit_report() wrote. Throws geometry::ContentError if it is missing.
void colour_garment(geometry::Mesh& garment, const io::FitScale& scale);

/// A coloured garment on its body, and the words below.
struct FitPanel {
  const geometry::Mesh* garment = nullptr;
  const geometry::Mesh* body = nullptr;
  std::string caption;
  std::vector<geometry::Index<geometry::Face>> crossed =
      {};                                        ///< faces that cross other cloth; they are marked
  std::vector<const geometry::Mesh*> over = {};  ///< more coloured garments, worn over it
};

/// The words for them: "; 43 pairs of faces cross (magenta)"; none: "".
std::string crossing_words(const ClothCrossings& crossings);

/// What each panel shows; a camera is chosen for all of them.
std::vector<io::RenderScene> fit_scenes(std::span<const FitPanel> panels);

/// Panels side by side, from one camera, with one legend if `legend`. One panel alone, with no view chosen,
/// is shown from the front and from the back. `scenes` are those of the panels.
io::Image fit_picture(std::span<const FitPanel> panels, std::span<const io::RenderScene> scenes,
                      const io::FitScale& scale, io::RenderOptions options, bool view_chosen,
                      Listener& listener, bool legend = true);

}  // namespace furrow::jobs
