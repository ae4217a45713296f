// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <cstddef>
#include <string>
#include <vector>

#include "geometry/mesh/mesh.h"

namespace furrow::jobs {

/// Something that is wrong with a mesh, or odd about it.
struct Ailment {
  std::string code;  ///< stable: "soup", "z_up", "two_units", "exchanged", "two_sided", "holes", …
  std::string text;  ///< a sentence with figures, without the file's name
  std::string help;  ///< what mends it: an option, or furrow doctor --repair
  std::size_t count = 0;
  bool fatal = false;                        ///< jobs refuse it: what they are asked for cannot work so
  bool mendable = false;                     ///< furrow doctor --repair mends it
  bool told_by_reader = false;               ///< every job that reads the file warns of it already
  std::vector<geometry::Point> places = {};  ///< where; the first 50 [m]
};

}  // namespace furrow::jobs
