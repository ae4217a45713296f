// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <string>
#include <vector>

#include "geometry/band/refine_band.h"

namespace furrow::tests {

/// A curve on a mesh through points near it, every h / 4 of a fold of that width and height; it begins or
/// ends at the border where its first or last points lie beyond it.
geometry::FoldCurve curve_on(const geometry::Mesh& mesh, const std::vector<geometry::Point>& points,
                             double width, double height, bool closed = false, int line = 0);

/// What must hold after refine_band; each string says what does not. Empty: all holds.
std::vector<std::string> faults_of_band(const geometry::Mesh& before, const geometry::Mesh& after,
                                        const std::vector<geometry::FoldCurve>& curves,
                                        const geometry::BandReport& report);

/// Smallest angle of the band's faces that the rules ask for [degrees].
double least_angle(const geometry::BandReport& report, double width, double height);

}  // namespace furrow::tests
