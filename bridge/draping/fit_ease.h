// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <array>
#include <span>
#include <vector>

#include "bridge/draping/fit_report.h"
#include "geometry/figure/torso_levels.h"

namespace furrow::bridge {

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
/// grown together with the chest. Then the garment is measured around the trunk, 2.5 cm below its armholes
/// (which are found to 0.1 mm), as tailors do: so sizes that hang higher or lower are measured at the same
/// ring of cloth. Where its trunk does not close within 25 cm, the curve is cut halfway between torso and
/// arm, at right angles to the shortest way between them, and closed by a straight line. Where no curve is
/// closed, because a sleeve ends at this height, what is left between such cuts counts if no border ends in
/// it and it covers more than half of the torso.
std::vector<FitEase> measure_ease(const geometry::Mesh& garment, const FitBody& body,
                                  const SectionHeights& heights);

}  // namespace furrow::bridge
