// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <array>
#include <limits>
#include <optional>
#include <string>

#include "geometry/mesh/mesh.h"

/// Every map that stays on a mesh: its name, key, type, unit and the value of what nobody set.
/// CGAL 5.5 and 6 return different types from property_map(): only this file calls it.
namespace furrow::geometry {

template <class KeyType, class ValueType>
struct PropertyName {
  using Key = KeyType;
  using Value = ValueType;
  const char* name;
  Value default_value;
};

inline constexpr double kUnset = std::numeric_limits<double>::quiet_NaN();
using TextureCoordinate = std::array<double, 2>;  ///< (u, v); NaN = none
using Color = std::array<double, 4>;              ///< red, green, blue, alpha in [0, 1]
using RestPosition = std::array<double, 3>;       ///< x, y, z [m]; NaN = not known

/// Line that a vertex belongs to: the index of its stroke, -1 = none.
inline constexpr PropertyName<Vertex, int> kLine{"v:line", -1};
/// Mass lumped to a vertex [kg].
inline constexpr PropertyName<Vertex, double> kMass{"v:mass", kUnset};
/// Velocity [m/s]; insertion interpolates it. (Not constexpr: CGAL's vectors are not.)
inline const PropertyName<Vertex, Vector> kVelocity{"v:velocity", {0, 0, 0}};
/// Spring force that insertion added to a vertex and that a simulation fades in [N], see bridge/draw_more.h.
inline const PropertyName<Vertex, Vector> kForceJump{"v:force_jump", {0, 0, 0}};
/// Where contact last asked the body's field (in the body's frame) [m], and its value there [m]; NaN = never.
inline const PropertyName<Vertex, Vector> kContactPoint{"v:contact_point", {0, 0, 0}};
inline constexpr PropertyName<Vertex, double> kContactLevel{"v:contact_level", kUnset};
inline constexpr PropertyName<Vertex, Color> kColor{"v:color", {1, 1, 1, 1}};
/// Where a vertex lay before lines, pose and motion: on the surface of the mesh that the first line was drawn
/// on. Insertion sets it where it is unset and gives new vertices the interpolated one; nothing moves it.
inline constexpr PropertyName<Vertex, RestPosition> kRestPosition{"v:rest_position",
                                                                  {kUnset, kUnset, kUnset}};
/// Rest length of the structural spring on an edge [m].
inline constexpr PropertyName<Edge, double> kRestLength{"e:rest_length", kUnset};
/// Rest length of the bending spring that joins the two vertices opposite an edge [m]; NaN = none.
inline constexpr PropertyName<Edge, double> kBendingRestLength{"e:bending_rest_length", kUnset};
/// How many edges share the bending spring of this one (two hinges with one vertex pair); 0 = no spring.
inline constexpr PropertyName<Edge, int> kBendingCount{"e:bending_count", 0};
/// Angle at rest between the two faces of an edge [rad]; NaN = as the shape lies, or a border.
inline constexpr PropertyName<Edge, double> kRestAngle{"e:rest_angle", kUnset};
/// Of an edge: stiffness of its structural spring [N/m], of its bending spring, whatever that one's count
/// [N/m], of its hinge [N m], its tension at the strain 1 [N]; >= 0; NaN = by the material (bridge/gather.h).
inline constexpr PropertyName<Edge, double> kStiffness{"e:stiffness", kUnset},
    kBendingStiffness{"e:bending_stiffness", kUnset}, kHingeStiffness{"e:hinge_stiffness", kUnset},
    kTension{"e:tension", kUnset};
/// Diagonal of a cell of the cloth's threads: cuts a four-sided face, or is parallel to such in a
/// subdivision.
inline constexpr PropertyName<Edge, bool> kDiagonal{"e:diagonal", false};
/// Rest length of edge(h) in the membrane triangle of face(h) alone [m]; NaN = kRestLength, as its neighbour.
inline constexpr PropertyName<Halfedge, double> kTriangleRestLength{"h:rest_length", kUnset};
/// Edge of a drawn line, in a chain of line vertices: it is never flipped.
inline constexpr PropertyName<Edge, bool> kLineEdge{"e:line_edge", false};
/// Texture coordinate of the corner of face(h) at target(h).
inline constexpr PropertyName<Halfedge, TextureCoordinate> kTexture{"h:texture", {kUnset, kUnset}};
/// How often insertion has split a face or the one it came from; after two splits it is left alone.
inline constexpr PropertyName<Face, int> kGeneration{"f:generation", 0};
/// Index into the document's group names (OBJ g and o), -1 = none.
inline constexpr PropertyName<Face, int> kGroup{"f:group", -1};
/// Index into the document's material names (OBJ usemtl), -1 = none.
inline constexpr PropertyName<Face, int> kMaterial{"f:material", -1};

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
