// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <string>
#include <vector>

#include "geometry/insert/insert_along_stroke.h"

namespace furrow::tests {

/// What must hold after a line was drawn; each string says what does not. Empty: all holds.
/// `before` has its rest lengths set. `flat`: both meshes lie in z = 0 with normals up.
std::vector<std::string> faults_of_insertion(const geometry::Mesh& before, const geometry::Mesh& after,
                                             const geometry::Insertion& insertion, bool flat);

/// The largest distance of a sample on cloth from the line, in units of half the longest edge of the crossed
/// faces around it: the sample's own, the one before and the one after.
double relative_deviation(const geometry::Mesh& before, const geometry::Mesh& after,
                          const geometry::Stroke& stroke, const geometry::Insertion& insertion,
                          double mean_edge);

/// Everything on the mesh in one string, for comparing bits.
std::string fingerprint(const geometry::Mesh& mesh);

}  // namespace furrow::tests
