// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <array>
#include <limits>
#include <optional>
#include <string>

#include "geometry/mesh/mesh.h"

/// Every map that stays on a mesh: its name, key, type, unit and the value of what nobody set. What
/// insertion, subdivision and PLY files do with each stands in attribute_register.h.
/// CGAL 5.5 and 6 return different types from property_map(): only this file calls it.
namespace furrow::geometry {

template <class KeyType, class ValueType>
struct PropertyName {
  using Key = KeyType;
  using Value = ValueType;
  const char* name;
  Value default_value;
};

inline constexpr double unset_value = std::numeric_limits<double>::quiet_NaN();
using Color = std::array<double, 4>;         ///< red, green, blue, alpha in [0, 1]
using RestPosition = std::array<double, 3>;  ///< x, y, z [m]; NaN = not known

/// The maps themselves: find_map(mesh, attribute::rest_length).
namespace attribute {

/// Line that a vertex belongs to: the index of its stroke, -1 = none.
inline constexpr PropertyName<Vertex, int> line{"v:line", -1};
/// Mass lumped to a vertex [kg].
inline constexpr PropertyName<Vertex, double> mass{"v:mass", unset_value};
/// Velocity [m/s]; insertion interpolates it. (Not constexpr: CGAL's vectors are not.)
inline const PropertyName<Vertex, Vector> velocity{"v:velocity", {0, 0, 0}};
/// Spring force that insertion added to a vertex and that a simulation fades in [N], see
/// bridge/keeping/draw_more.h.
inline const PropertyName<Vertex, Vector> force_jump{"v:force_jump", {0, 0, 0}};
/// Where contact last asked the body's field (in the body's frame) [m], and its value there [m]; NaN = never.
inline const PropertyName<Vertex, Vector> contact_point{"v:contact_point", {0, 0, 0}};
inline constexpr PropertyName<Vertex, double> contact_level{"v:contact_level", unset_value};
inline constexpr PropertyName<Vertex, Color> color{"v:color", {1, 1, 1, 1}};
/// Where a vertex lay before lines, pose and motion: on the surface of the mesh that the first line was drawn
/// on. Insertion sets it where it is unset and gives new vertices the interpolated one; nothing moves it.
inline constexpr PropertyName<Vertex, RestPosition> rest_position{"v:rest_position",
                                                                  {unset_value, unset_value, unset_value}};
/// The vertex that this one is one with at a seam that its file leaves open; no face has it; -1 = none.
inline constexpr PropertyName<Vertex, int> joined{"v:joined", -1};
/// Rest length of the structural spring on an edge [m].
inline constexpr PropertyName<Edge, double> rest_length{"e:rest_length", unset_value};
/// Rest length of the bending spring that joins the two vertices opposite an edge [m]; NaN = none.
inline constexpr PropertyName<Edge, double> bending_rest_length{"e:bending_rest_length", unset_value};
/// How many edges share the bending spring of this one (two hinges with one vertex pair); 0 = no spring.
inline constexpr PropertyName<Edge, int> bending_count{"e:bending_count", 0};
/// Angle at rest between the two faces of an edge [rad]; NaN = as the shape lies, or a border.
inline constexpr PropertyName<Edge, double> rest_angle{"e:rest_angle", unset_value};
/// Of an edge: stiffness of its structural spring [N/m], of its bending spring, whatever that one's count
/// [N/m], of its hinge [N m], its tension at the strain 1 [N]; >= 0; NaN = by the material
/// (bridge/arrays/gather.h).
inline constexpr PropertyName<Edge, double> stiffness{"e:stiffness", unset_value},
    bending_stiffness{"e:bending_stiffness", unset_value}, hinge_stiffness{"e:hinge_stiffness", unset_value},
    tension{"e:tension", unset_value};
/// Diagonal of a cell of the cloth's threads: cuts a four-sided face, or is parallel to such in a
/// subdivision.
inline constexpr PropertyName<Edge, bool> diagonal{"e:diagonal", false};
/// Rest length of edge(h) in the membrane triangle of face(h) alone [m]; NaN = rest_length, as its neighbour.
inline constexpr PropertyName<Halfedge, double> triangle_rest_length{"h:rest_length", unset_value};
/// Edge of a drawn line, in a chain of line vertices: it is never flipped.
inline constexpr PropertyName<Edge, bool> line_edge{"e:line_edge", false};
/// Texture coordinate of the corner of face(h) at target(h).
inline constexpr PropertyName<Halfedge, TextureCoordinate> texture{"h:texture", {unset_value, unset_value}};
/// The same in a second texture map, which a glTF may have.
inline constexpr PropertyName<Halfedge, TextureCoordinate> second_texture{"h:second_texture",
                                                                          {unset_value, unset_value}};
/// How often insertion has split a face or the one it came from; after two splits it is left alone.
inline constexpr PropertyName<Face, int> generation{"f:generation", 0};
/// Index into the document's group names (OBJ g and o), -1 = none.
inline constexpr PropertyName<Face, int> group{"f:group", -1};
/// Index into the document's material names (OBJ usemtl), -1 = none.
inline constexpr PropertyName<Face, int> material{"f:material", -1};
/// As `material`, of the back of a face: a lining, for which files have a face of its own; -1 = none.
inline constexpr PropertyName<Face, int> lining{"f:lining", -1};
/// How the part of a face rides on other cloth (figure/attached_parts.h): 0 = not.
inline constexpr PropertyName<Face, int> rides{"f:rides", 0};

}  // namespace attribute

/// The map of that name, added with its default value where the mesh has none.
template <class K, class V>
Map<K, V> ensure_map(Mesh& mesh, const PropertyName<K, V>& p) {
  return mesh.add_property_map<K, V>(p.name, p.default_value).first;
}
/// The map of that name, or nothing. A Map is a handle: writing through it changes the mesh.
template <class K, class V>
std::optional<Map<K, V>> find_map(const Mesh& mesh, const PropertyName<K, V>& p) {
  auto [map, found] = mesh.property_map<K, V>(p.name);
  return found ? std::optional(map) : std::nullopt;
}

}  // namespace furrow::geometry
