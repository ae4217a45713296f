// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "jobs/inputs.h"

namespace furrow::jobs {

/// A place where cloth passes through itself: faces that cross each other or share a vertex.
struct CrossingPlace {
  geometry::Point centre{0, 0, 0};   ///< [m]
  double extent = 0;                 ///< longest side of the box around its faces [m]
  std::size_t pairs = 0;             ///< of faces that cross here
  std::size_t from_start = 0;        ///< of them, where the garment crossed itself from the start
  std::array<std::string, 2> parts;  ///< of the garment that cross; twice the same: it crosses itself
};

/// Pairs of faces of a garment that cross or touch each other and share no vertex: none where it is sound.
struct ClothCrossings {
  std::optional<std::size_t> at_start;  ///< pairs as it was given; none: only one state was measured
  std::size_t pairs = 0;                ///< now
  std::size_t from_start = 0;           ///< of them, where it crossed itself from the start
  std::vector<geometry::Face> faces;    ///< that cross another, in ascending order
  std::vector<std::size_t> corners;     ///< vertices of those faces by index, in ascending order
  std::vector<CrossingPlace> places;    ///< most pairs first
};

/// How a garment crossed itself as it was given.
struct CrossedStart {
  std::size_t pairs = 0;
  std::vector<char> vertices;  ///< by index, whether a face at it crossed; of the refined mesh
};

/// "43 pairs of faces of the cloth cross (12 of them from the start), 40 of them within 6.0 cm of
/// (0.11, 1.32, -0.02) m, between 'shirt' and 'button'".
std::string words(const ClothCrossings& crossings);

/// The numbers, the corners (left out: nothing crosses), and the ten places that have most pairs.
Json to_json(const ClothCrossings& crossings);

}  // namespace furrow::jobs
