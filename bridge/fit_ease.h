// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "geometry/figure/torso_levels.h"
#include "geometry/mesh/mesh.h"

namespace furrow::bridge {

/// Heights of the sections where ease is measured, y [m]; finite where told.
struct SectionHeights {
  std::optional<double> chest, waist, hip;
};

/// Room between garment and body at one height. What cannot be measured is missing, and `note` says why.
struct FitEase {
  std::string name;                     ///< chest, waist or hip
  double height = 0;                    ///< y [m]
  std::optional<double> body_girth;     ///< by the tape measure (geometry/figure/horizontal_section.h) [m]
  std::optional<double> garment_girth;  ///< the garment's curve around the body, all its folds followed [m]
  std::optional<double> ease;           ///< garment_girth - body_girth [m]
  std::optional<double> rest_girth;     ///< the same curve with the cloth unstrained [m]; none without rest
  std::optional<double>
      rest_ease;     ///< rest_girth - body_girth [m]: < 0, the garment is smaller than the body
  std::string note;  ///< "" or why something is missing
};

/// A body by its closed surface, faces outwards, y up, and its torso.
struct FitBody {
  std::span<const geometry::Point> points;
  std::span<const std::array<int, 3>> triangles;
  std::span<const geometry::TorsoLevel> levels;  ///< of this body; may be empty
};

/// Ease at the sections whose height is known. The garment's curve is the largest closed one around the
/// middle of the body's torso there. O(triangles) a section. Throws geometry::ContentError where
/// horizontal_section() and rest_lengths() do.
///
/// \details The curve may run around another curve of the body, too, such as an arm in a sleeve that has
/// grown together with the chest. Then it is cut halfway between torso and arm, at right angles to the
/// shortest way between them, and closed by a straight line. Where no curve is closed, because a sleeve ends
/// at this height, what is left between such cuts counts if no border ends in it and it covers more than half
/// of the torso.
std::vector<FitEase> measure_ease(const geometry::Mesh& garment, const FitBody& body,
                                  const SectionHeights& heights);

}  // namespace furrow::bridge
