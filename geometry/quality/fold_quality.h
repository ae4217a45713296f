// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <array>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "geometry/quality/fold_sections.h"

/// How well a fold is shaped, and the cloth around it: measures for which people have names like beads,
/// zigzag and welts. Shares are of one, angles degrees unless they say otherwise.
namespace furrow::geometry {

/// Of one piece of a line. None: `missing` says why.
struct LineQuality {
  int line = -1;
  std::string name;
  double length = 0, width = 0, asked = 0;  ///< of the stroke; k [m]
  std::size_t sections = 0;
  std::optional<double> crest_height;  ///< mean height of the crest [m]
  std::optional<double> crest_ripple;  ///< RMS of the crest's height about its trend, over crest_height
  std::optional<double> lateral;       ///< RMS of the crest beside the stroke, over the width
  std::optional<double> sweep;         ///< RMS of all section points about their trends, over crest_height
  std::optional<double> normals_deg;   ///< RMS angle of face normals to their mean along the line
  std::optional<double> fit;           ///< RMS to the best k phi(2 d / w), over that k
  std::optional<double> fitted_height, fitted_width;  ///< that k and w [m]
  std::vector<std::string> missing;                   ///< a sentence for what could not be measured
};

using LinePath = std::vector<std::array<Eigen::Vector3d, 2>>;  ///< segments of a stroke on the surface [m]

/// Measures a line whose stroke is the curve; `path`, where not empty, is the stroke that the crest is to lie
/// on. Trends are parabolas over half a width on either side. phi is the fold's section (fold_heights.h),
/// (1 - t^2)^(5/2) where the line is not sharp; a line that flares, or whose height or width varies, has no
/// fit. `crest_alone`: height, ripple and lateral. About O(faces of the mesh + sections).
LineQuality measure_line(const FoldSurface& surface, const FoldCurve& curve, const LinePath& path = {},
                         bool crest_alone = false);

/// The lines that a mesh carries (attribute::line, line_edge), as curves over the feet of their vertices,
/// smoothed by a tenth of their widths; by id. `widths` and `heights` by id [m]: NaN or none, a width is five
/// heights, and a height the mean over the line. Closed and open pieces each are a curve.
std::vector<FoldCurve> carried_curves(const FoldSurface& surface, std::span<const double> widths = {},
                                      std::span<const double> heights = {});

/// A curve through vertices of a chain; closed: first and last are the same.
FoldCurve curve_of_chain(const FoldSurface& surface, std::span<const Vertex> chain, double width,
                         double height);

/// Of one border loop.
struct HemTurn {
  double length = 0;    ///< [m]
  double turn_deg = 0;  ///< RMS angle between its directions 6 mm of arc apart
  Point centre{0, 0, 0};
};

/// Of a mesh, with or without folds.
struct MeshQuality {
  std::size_t vertices = 0;
  double angle_defect = 0;        ///< as angle_defect() of fold/fold_base.h [rad/m^2]
  double min_angle_deg = 0;       ///< smallest corner of a face in space
  double min_rest_angle_deg = 0;  ///< by the rest lengths; 0 where a face breaks the triangle inequality
  std::vector<HemTurn> hems;      ///< longest first
};

/// O(faces log faces). Throws ContentError if a face is no triangle.
MeshQuality measure_quality(const Mesh& mesh, bool with_hems = true);

/// Angle between the directions of a closed polygon `apart` [m] of arc from each other, as an exact RMS over
/// its length [rad]; NaN where it is shorter than that.
double turn_of(std::span<const Point> loop, double apart);

}  // namespace furrow::geometry
