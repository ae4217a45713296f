// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <vector>

#include "io/scene/scene.h"

namespace furrow::io {

/// A scene with several garments, as `[[garment]]`, once for each of them, the innermost first: in the order
/// of their `layer`, without one in the order of the file. All other settings are common to them. Each stays
/// where it was written, for messages. A scene with one garment, or none, is the only one. Throws
/// geometry::ContentError where two have the same layer, one has none that others have, or two have one mesh.
std::vector<TomlDocument> scenes_by_garment(const TomlDocument& document);

}  // namespace furrow::io
