// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <array>

#include "geometry/mesh/mesh.h"

/// How a step with the topology of Loop's scheme numbers what it makes: for those who follow it.
namespace furrow::geometry {

/// The middle of an edge of the mesh before: they are appended in the order of the edges.
inline Vertex middle_of(const Mesh& before, Edge e) {
  return Vertex(static_cast<Vertex::size_type>(before.number_of_vertices() + e.idx()));
}

/// A face keeps its index for one of its four parts; the other three are appended, face by face. `faces`: how
/// many there were before.
inline std::array<Face, 4> parts_of(Face f, std::size_t faces) {
  const auto first = static_cast<Face::size_type>(faces + 3 * f.idx());
  return {f, Face(first), Face(first + 1), Face(first + 2)};
}
/// The face of before that a part belongs to.
inline Face whole_of(Face part, std::size_t faces) {
  return part.idx() < faces ? part : Face(static_cast<Face::size_type>((part.idx() - faces) / 3));
}

}  // namespace furrow::geometry
