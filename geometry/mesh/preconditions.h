// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <span>
#include <string>

#include "geometry/mesh/mesh.h"

/// What operations ask of their options and of a mesh before they change anything. `operation` opens the
/// message.
namespace furrow::geometry {

inline constexpr int most_lines = 1'000'000;  ///< that a garment may have

/// Throws std::invalid_argument "<operation>: <what>"; `what` names the option and its value.
[[noreturn]] void refuse(const char* operation, const std::string& what);
/// Throws std::invalid_argument naming the first vertex, half-edge or face whose neighbours are not there, or
/// do not name it in return: what reads such a mesh reads beyond its arrays, or never ends. Removed elements
/// are passed over. O(half-edges), and nothing is allocated.
void require_structure(const Mesh& mesh, const char* operation);
/// What every public operation asks of a mesh, but for what its docstring lets through: require_structure(),
/// no removed elements, require_finite() and require_triangles(); and that attribute::line, which other code
/// counts up to, is below most_lines (ContentError).
void check_mesh(const Mesh& mesh, const char* operation);
/// Throws ContentError naming the first vertex whose position is not finite.
void require_finite(const Mesh& mesh, const char* operation);
/// Throws ContentError naming the first face that has not three corners.
void require_triangles(const Mesh& mesh, const char* operation);
/// Throws std::invalid_argument naming the first of `vertices` that the mesh has not (or no longer has).
void require_vertices(const Mesh& mesh, std::span<const Vertex> vertices, const char* operation);

}  // namespace furrow::geometry
