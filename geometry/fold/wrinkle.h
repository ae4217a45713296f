// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <array>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "geometry/fold/taubin_smooth.h"
#include "geometry/insert/insertion.h"
#include "geometry/rest/rest_state.h"
#include "geometry/stroke/stroke.h"

namespace furrow::geometry {

class FoldMemory;
std::shared_ptr<FoldMemory> make_fold_memory();

enum class SmoothingRegion { two_ring, whole_mesh };

struct WrinkleOptions {
  InsertionOptions insertion = {.rule = InsertionRule::fold};
  TaubinOptions smoothing;
  SmoothingRegion region = SmoothingRegion::two_ring;
  RestRule rest = RestRule::drawn;
  double density = 0.15;            ///< rho [kg/m^2]; > 0
  std::vector<Index<Vertex>> held;  ///< vertices of the mesh given that keep their places, as pins do
  int first_line = 0;               ///< id of the first stroke's line; above those that the mesh has
  /// r_avg of the garment before its first line [m]; > 0; none: of the mesh given. For a second round of
  /// lines.
  std::optional<double> mean_structural_length, mean_bending_length;
  // Of rule fold alone, which takes lambda and mu of `smoothing`, and no more of it, and no `region`:
  Detail detail = Detail::normal;
  bool flat_base =
      false;  ///< new vertices stay on the facets of the mesh given, so that k = 0 is an isometry
  int fold_iterations = 5;  ///< pairs of smoothing steps; [0, 100000]
  /// Of a program that draws the same lines again and again, and more: folds that it has drawn before on this
  /// mesh are taken from there, to the same bits. Several threads may share one.
  std::shared_ptr<FoldMemory> memory = nullptr;
};

struct WrinkledLine {
  std::string name;
  double height = 0;  ///< k as asked for [m]
  /// line_heights() before displacement: of the curvature of the cloth, or of earlier lines [m].
  double base_height = 0;
  double drawn_height = 0;     ///< line_heights() after displacement, less base_height [m]
  double smoothed_height = 0;  ///< after smoothing, less base_height [m]
  std::vector<std::vector<Index<Vertex>>> chains;  ///< its vertices, a list for each connected part
  std::optional<double> width = {};                ///< as asked for [m], as the next two
  double sharpness = 0.5, press = 1;
  /// Rule fold: mean height over the surface before, along its normals, of the vertices where the fold is
  /// full, scaled to `height` where that varies [m].
  std::optional<double> crest_height = {};
  std::optional<double> gather = {};  ///< as asked for [-]; of rule fold (gather_lines.h)
  /// The stroke as it lies on the cloth before it is raised, as segments; of rule fold smoothed [m].
  std::vector<std::array<Coordinates<Point>, 2>> path = {};
};

/// What rule fold did.
struct FoldReport {
  /// Sum of the absolute angle defects of inner vertices over the area: how knobbly cloth is [rad/m^2].
  double angle_defect_before = 0, angle_defect_after = 0;
  double min_angle_before_deg = 0, min_angle_deg = 0;  ///< at rest, of the refined faces [degrees]
  double lateral = 0;                   ///< largest distance of a line's vertex from its smoothed stroke [m]
  std::size_t snapped = 0;              ///< vertices of the mesh given that were moved onto a line
  std::size_t reshaped_faces = 0;       ///< faces at rest that took the lengths of their displaced shape
  std::size_t invalid_faces = 0;        ///< faces at rest that break the triangle inequality
  std::size_t unsmoothed_vertices = 0;  ///< vertices whose smoothing would have spoiled a face
};

struct WrinkleReport {
  InsertionReport insertion;        ///< sums over all lines
  std::vector<WrinkledLine> lines;  ///< of stroke i, id first_line + i; a later line owns what two share
  std::size_t structural_springs = 0, bending_springs = 0;
  double rest_area_before = 0, rest_area_after = 0;  ///< [m^2]
  double total_mass = 0;                             ///< [kg]
  double mean_structural_length = 0,
         mean_bending_length = 0;     ///< r_avg of the mesh before any line [m] (S1.7)
  std::vector<std::string> warnings;  ///< lines for whose width the mesh is too coarse, and more
  std::optional<FoldReport> fold;     ///< of rule fold
  std::vector<Coordinates<Point>>
      undisplaced;  ///< where each vertex would lie without the lines' heights [m]
};

/// The stages of method S1.21 that geometry makes.
enum class Stage { inserted, displaced, smoothed };
using StageObserver = std::function<void(Stage, const Mesh&)>;

/// Turns strokes into wrinkles (method, Algorithm 1, steps 2 to 4): inserts all lines into the undisplaced
/// surface, one after the other (Algorithm 2), displaces their vertices along the normals, smooths once,
/// rebuilds the bending springs, and updates rest lengths and masses; options.rest says what of the rest
/// state learns of the displacement. An unset rest length is the length as it is. Throws
/// std::invalid_argument for an option out of its range and ContentError for a stroke that cannot be used;
/// the mesh is then as it was. Cost: about O(faces log faces) for each stroke.
/// \details A line with a width is raised by its profile (line_profile.h), along the angle-weighted normals,
/// and not smoothed. Where several lines raise a vertex the highest ridge and the deepest valley count, and
/// add up; lines without a width raise their own vertices alone. Presses change stored hinge stiffnesses
/// only; where none is stored, hinge_presses() (line_press.h) gives the factors to the code that makes
/// hinges. Rule fold does all of this otherwise: fold_lines.h. Sets attribute::line, line_edge, rest_length,
/// bending_rest_length, bending_count, rest_angle and mass.
WrinkleReport wrinkle(Mesh& mesh, std::span<const Stroke> strokes, const WrinkleOptions& options = {},
                      const StageObserver& observer = {});

}  // namespace furrow::geometry
