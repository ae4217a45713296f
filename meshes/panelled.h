// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <nlohmann/json.hpp>
#include <string>

/// A skirt of six gores. Each gore is cut flat (a sector of a ring), and the six, sewn together, make a cone
/// without stretching. The texture coordinates are the flat pattern, scaled alike in both directions.
namespace furrow::meshes {

/// The skirt as OBJ: metres, y up, front towards +z. Each gore has a texture chart and a group; two materials
/// alternate. Charts keep 0.02 of the unit square between them and from its border.
std::string panelled_obj();

/// Lines for it that cross its seams: obliquely, at a shallow angle, all around, and along one.
nlohmann::json panelled_strokes();

}  // namespace furrow::meshes
