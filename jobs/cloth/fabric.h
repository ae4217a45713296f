// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "geometry/mesh/mesh.h"
#include "io/scene/scene.h"
#include "jobs/base/inputs.h"

namespace furrow::jobs {

/// Cusick's drape test: a round specimen of radius 15 cm held flat on a disc of 9 cm, the warp along x.
struct DiscJob {
  io::SceneMaterial material;
  int rings = 20;                      ///< of the mesh; a multiple of 5, so that one lies on the disc's edge
  std::vector<int> folds = {6, 7, 8};  ///< of the starts, one each
  double bending_friction = 0;         ///< moment a metre that a crease bears before it gives way [N]; >= 0
};
struct DiscReport {
  double coefficient = 0;      ///< (shadow - disc) / (specimen - disc) of the rest with the lowest energy [-]
  double least = 0, most = 0;  ///< over the starts that rest [-]
  double energy = 0;           ///< elastic and weight, against flat [J]
  int nodes = 0;               ///< folds at its rim
  int starts = 0, rested = 0;  ///< rested: residual <= 1e-3
  std::size_t vertices = 0;
  geometry::Mesh mesh;  ///< y up [m]; with f:warp
};
/// Throws std::invalid_argument for rings or a friction that do not fit, or a material without a density;
/// physics::Cancelled if the listener cancels.
DiscReport drape_disc(const DiscJob& job, Listener& listener);

/// A strip 6 cm wide and 20 cm long, cut at an angle to the warp, its ends clamped and pulled apart.
struct SwatchReport {
  double force = 0;    ///< over width [N/m]
  double modulus = 0;  ///< force over strain [N/m]; with clamped ends, so somewhat above a free strip's
  double wanted = 0;   ///< of a long strip (physics::strip_modulus) [N/m]
  bool rested = false;
  geometry::Mesh mesh;
};
/// angle [degrees]; strain of the pull [-].
SwatchReport pull_swatch(const io::SceneMaterial& material, double angle, double strain);

/// The material with all rigidities times the factor at which its disc drapes most nearly as it was measured,
/// of a bisection in [1/32, 32] to 2 %; `coefficient` is what it then has. That may be off by some 0.02, as
/// it jumps where the disc takes another number of folds. Throws std::invalid_argument for a measured
/// coefficient that no factor reaches.
struct RigidityFit {
  double factor = 1, coefficient = 0;
  io::SceneMaterial material;
};
RigidityFit fit_rigidity(const DiscJob& job, double measured, Listener& listener);

/// A fabric from a table of KES or FAST figures (docs/threads.md), as the settings of [material]. Throws
/// geometry::ContentError for a table of neither kind, or with a figure missing or out of its range.
Json fabric_from_table(const io::TomlDocument& table);

/// The material of a scene that says no more than this.
io::SceneMaterial material_of_settings(const Json& settings);

}  // namespace furrow::jobs
