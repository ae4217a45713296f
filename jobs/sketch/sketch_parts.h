// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <string>
#include <vector>

#include "jobs/sketch/sketch.h"

/// Parts of a sketch's garment, and which of them go with other cloth, as a person sets it: in the settings'
/// "garment.attach_parts" and "garment.free_parts".
namespace furrow::jobs {

struct SketchPart {
  std::string name;   ///< by which settings have it, see parts_called()
  bool goes = false;  ///< with the cloth that it lies on
};

/// All but the largest, which carries others; the largest twelve of them. O(faces log faces).
std::vector<SketchPart> loose_parts_of(const Sketch& sketch);

/// The garment's settings with the part of that name going along, or by itself.
Json with_part(Json garment, const std::string& name, bool goes);

}  // namespace furrow::jobs
