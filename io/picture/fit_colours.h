// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <span>
#include <string>

#include "geometry/mesh/mesh.h"
#include "io/picture/png_file.h"
#include "io/picture/render.h"

namespace furrow::io {

/// What a garment's colours tell.
/// - strain: pale where the cloth is as it was made, through yellow and orange to dark red where it is
///   stretched, blue where it is pressed together.
/// - distance: dark violet on the body, through blue and green to pale yellow where it is far.
/// Along each scale the lightness (L of OKLab) changes in even steps one way, and no two sides differ by red
/// against green alone. So the order can be seen by colour-blind eyes and on grey paper.
enum class FitQuantity { strain, distance };

struct FitScale {
  FitQuantity quantity = FitQuantity::strain;
  double limit =
      0.10;         ///< where the colours end: strain [-], from -limit to limit; distance [m], from 0; > 0
  double mark = 0;  ///< a threshold that the legend marks, in (0, limit]; 0: none
};

/// The colour of a value. Beyond the ends it is that of the end; NaN has a grey of its own. Throws
/// std::invalid_argument if the limit is not finite and > 0.
Colour fit_colour(double value, const FitScale& scale);

/// Sets v:color by a value of each vertex, by its index, in whole steps of 1/255, alpha 1. Throws
/// std::invalid_argument, the mesh untouched, for fewer values than vertices and as fit_colour() does.
void colour_by_fit(geometry::Mesh& mesh, std::span<const double> values, const FitScale& scale);

/// The picture with a legend below: the colours as a bar with numbers, their meaning, the mark. `words`: a
/// first line such as the garment's name, "" for none. At least 200 pixels wide. Throws std::invalid_argument
/// for a smaller picture, a mark out of its range, and as fit_colour() does.
Image with_fit_legend(const Image& picture, const FitScale& scale, const std::string& words = "");

}  // namespace furrow::io
