// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <array>
#include <optional>
#include <span>
#include <vector>

#include "geometry/figure/horizontal_section.h"

namespace furrow::geometry {

/// The torso of a standing body at one height.
struct TorsoLevel {
  double height = 0;               ///< y [m]
  double girth = 0;                ///< by tape_measure() [m]
  std::array<double, 2> centre{};  ///< centre (x, z) of its section [m]
  double breadth = 0;              ///< from side to side, by breadth() [m]
};

/// The torso from the crotch to the armpits, upwards, in steps of 0.5 % of the body's height: from 62 % of
/// it, where the largest curve is taken for the torso, the curve around the centre of the last one is
/// followed up and down (to at most 85 % and 40 %). Arms that hang apart are curves of their own and left
/// out; the torso ends where no curve lies around that centre, or where the girth changes by more than a
/// tenth in one step: above, arms grow out of it there (by 20 % and more on the bodies that were looked at,
/// while a bust changes by 4 %), below, legs part. Arms that are stretched out sideways grow out step by
/// step: above the waist it ends, too, where the breadth grows by more than 6 % in a step or 18 % in four,
/// and begins to do so (2 % a step) where they begin. `points` are of a closed body, y up, its faces
/// outwards. Empty if the body is lower than 0.9 m or higher than 2.5 m, or has no torso between 55 % and 70
/// % of its height. Throws as horizontal_section() does. O(100 triangles).
std::vector<TorsoLevel> torso_levels(std::span<const Point> points,
                                     std::span<const std::array<int, 3>> triangles);

/// Where clothes makers lay the tape measure [m].
struct TorsoHeights {
  double chest = 0;  ///< the largest girth between waist and armpits (and 78 % of the body's height)
  double waist = 0;  ///< the least girth between 55 % and 70 % of the body's height
  double hip = 0;    ///< the largest girth between crotch and waist
};

/// After EN 13402-1:2001 (ISO 3635:1981), which lays the tape measure under the armpits and across the chest,
/// round the natural waist, and round the fullest of the buttocks. `low` and `high` are the body's lowest and
/// highest y [m]. Nothing without levels.
std::optional<TorsoHeights> torso_heights(std::span<const TorsoLevel> levels, double low, double high);

/// A body cut at a height: the torso, and what else is there (arms).
struct TorsoSection {
  SectionLoop torso;
  std::vector<SectionLoop> others;
};

/// The torso is the largest closed curve around the centre of the nearest level; without levels the largest
/// one of all. Above the armpits arms belong to it, below the crotch there is none: nothing, as where the
/// plane misses the body. Throws as horizontal_section() does.
std::optional<TorsoSection> torso_section(std::span<const Point> points,
                                          std::span<const std::array<int, 3>> triangles,
                                          std::span<const TorsoLevel> levels, double height);

}  // namespace furrow::geometry
