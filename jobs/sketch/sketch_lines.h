// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "jobs/sketch/sketch.h"

/// Strokes made of other strokes, where a person has drawn one and wants more of it. Metres, y up.
namespace furrow::jobs {

/// Where the plane of symmetry x = const is taken to lie [m]: the middle of the body, else of the garment.
/// O(vertices).
double middle_of(const Sketch& sketch);

/// The stroke on the other side of the plane x = `middle` [m]: its points mirrored, all else as it is. Throws
/// std::invalid_argument for a stroke that is not given by points.
Json mirrored(const Json& stroke, double middle);

/// Whether a stroke keeps to the plane x = `middle` so closely, within half of its fold's width, that its
/// mirror image would lie on it. false for a stroke that is not given by points.
bool lies_in_middle(const Json& stroke, double middle);

/// The stroke moved sideways along the cloth by 1.2 of its fold's width, to the right of the way that it runs
/// as seen from outside; where the cloth ends there, to the left. Throws std::invalid_argument for a stroke
/// that is not given by points. Cost: a search tree over the garment, then O(log n) a point.
Json beside(const Sketch& sketch, const Json& stroke);

}  // namespace furrow::jobs
