// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "bridge/drape.h"
#include "bridge/fit_report.h"
#include "cli/body.h"
#include "io/scene/scene.h"

namespace furrow::cli {

/// An elastic band: a border loop's name, and its length over the loop's [-].
struct Band {
  std::string loop;
  double length;
};

/// What furrow drape knows beyond a scene.
struct DrapeSettings {
  bool plain = false;
  double residual = physics::SettleOptions{}.tolerance;
  std::optional<double> contact_depth;  ///< that cloth may lie inside the gap [m]; none: no limit
  double penetration = 0.005;           ///< depth to which the body may come through the cloth [m]
  std::optional<int> iterations;        ///< none: those of the method
  std::vector<Band> bands;
  double band_stiffness = 50;       ///< [N]
  double bending_friction = 0;      ///< [N]
  std::filesystem::path animation;  ///< of the finest level, a frame an iteration; empty: none
};

struct Draped {
  io::MeshFile file;
  bridge::DrapeReport report;
  bridge::FitReport fit;
  bridge::FitOptions fit_options;
  double gap = 0;           ///< that was to be kept from the body [m]
  std::size_t too_near = 0; /**< vertices that keep less than nine tenths of a gap that was not raised, by
                                 more than the field's tolerance */
  bool falls = false;       ///< nothing carries it: its forces balance at no time
  bool animated = false;    ///< the animation was written
  double seconds = 0;       ///< that the fit took, without reading [s]
  std::string name;
};

/// Reads a scene's garment, fits it on the body and measures how it fits. Shows progress; an interrupt stops
/// it, what was reached is returned. Bands become struts of the garment, in place of those that its loop had.
/// Throws as reading, bridge::drape() and bridge::fit_report() do.
Draped drape_garment(const io::Scene& scene, const BodyCollider& body, const DrapeSettings& settings,
                     const CommonArguments& common);

}  // namespace furrow::cli
