// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <span>
#include <string>

#include "geometry/mesh/mesh.h"

/// What operations ask of their options and of a mesh before they change anything. `operation` opens the
/// message.
namespace furrow::geometry {

/// Throws std::invalid_argument "<operation>: <what>"; `what` names the option and its value.
[[noreturn]] void refuse(const char* operation, const std::string& what);
/// Throws ContentError naming the first vertex whose position is not finite.
void require_finite(const Mesh& mesh, const char* operation);
/// Throws ContentError naming the first face that has not three corners.
void require_triangles(const Mesh& mesh, const char* operation);
/// Throws std::invalid_argument naming the first of `vertices` that the mesh has not (or no longer has).
void require_vertices(const Mesh& mesh, std::span<const Vertex> vertices, const char* operation);

}  // namespace furrow::geometry
