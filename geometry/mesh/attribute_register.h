// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <array>
#include <tuple>

#include "geometry/mesh/press_map.h"
#include "geometry/mesh/property_names.h"
#include "geometry/mesh/warp_map.h"

/// What insertion, subdivision and PLY files do with each attribute of a mesh.
namespace furrow::geometry {

/// What an operation does with the values of the elements that it makes, cuts, flips or surrounds anew.
enum class CarryRule {
  blend,     ///< new vertices and corners: the weighted sum of those they lie between
  copy,      ///< faces: a part has what the whole had
  halves,    ///< edges: both halves of a cut edge have what it had; a new or flipped edge has the default
  fresh,     ///< new, cut and flipped elements have the default, the others keep their values
  unset,     ///< as fresh, and all sides of a changed face have the default, too; subdivision: every element
  computed,  ///< by the code that Carry::by names
};

/// The rules of one attribute.
struct Carry {
  CarryRule insertion;    ///< MeshEditor: a face split, an edge split, an edge flipped
  CarryRule subdivision;  ///< subdivide.h
  const char* by = "";    ///< the code that computes it, or that sets it anew where it became unset
};

/// What the numbers of a PLY column may be, and how they are written.
enum class PlyValue {
  none,       ///< not written
  color,      ///< in [0, 1]; bytes where nothing is lost, else doubles
  index,      ///< int, at least -1
  count,      ///< int, 0 to 1e6
  flag,       ///< byte, 0 or 1
  length,     ///< double in the file's unit, > 0 or NaN
  position,   ///< three doubles in the file's unit and axes, all NaN or all finite
  direction,  ///< three doubles in the file's axes, all NaN or all finite
  texture,    ///< a list of two doubles for each corner of a face
  mass,       ///< double [kg], >= 0 or NaN
  stiffness,  ///< double, >= 0 or NaN
  angle,      ///< double [rad], in [-pi, pi] or NaN
  state,      ///< doubles in SI units that only a saved state has: vectors finite, a lone number may be NaN
};

/// The columns of one attribute: one, or one for each component (for each edge of a face, by corners 01, 12,
/// 20, where the key is a halfedge and the value a number).
struct PlyColumns {
  PlyValue value = PlyValue::none;
  std::array<const char*, 4> names = {};  ///< the rest is null

  std::size_t size() const {
    std::size_t n = 0;
    while (n < names.size() && names[n]) ++n;
    return n;
  }
};

/// An entry of the register.
template <class KeyType, class ValueType>
struct Attribute : PropertyName<KeyType, ValueType> {
  const char* unit;  ///< "" = none
  Carry carry;
  PlyColumns ply;
};
template <class K, class V>
Attribute(PropertyName<K, V>, const char*, Carry, PlyColumns) -> Attribute<K, V>;

namespace rules {
using enum CarryRule;

/// Every attribute of property_names.h; the order is that of PLY columns. Insertion, subdivision and the PLY
/// reader and writer go through it: what stands here is kept by all of them. A transfer moves positions only.
/// \details Two things that stay on a mesh are no attributes: numbers that a file brings under names of its
/// own (vertex_attributes.h: blended, one PLY column each), and struts (struts.h: they stay with their
/// vertices, subdivision drops them, PLY has an element for them).
inline const std::tuple attribute_register{
    // Of vertices.
    Attribute{attribute::color, "", {blend, blend}, {PlyValue::color, {"red", "green", "blue", "alpha"}}},
    Attribute{attribute::line,
              "",
              {computed, computed, "draw_line; carry_lines of subdivide"},
              {PlyValue::index, {"line"}}},
    Attribute{attribute::mass, "kg", {fresh, unset, "lump_masses"}, {PlyValue::mass, {"mass"}}},
    Attribute{attribute::velocity, "m/s", {blend, blend}, {PlyValue::state, {"vx", "vy", "vz"}}},
    Attribute{attribute::force_jump,
              "N",
              {fresh, fresh, "draw_more"},
              {PlyValue::state, {"force_jump_x", "force_jump_y", "force_jump_z"}}},
    Attribute{attribute::contact_point,
              "m",
              {fresh, fresh, "simulate"},
              {PlyValue::state, {"contact_x", "contact_y", "contact_z"}}},
    Attribute{
        attribute::contact_level, "m", {fresh, fresh, "simulate"}, {PlyValue::state, {"contact_level"}}},
    Attribute{
        attribute::rest_position, "m", {blend, blend}, {PlyValue::position, {"rest_x", "rest_y", "rest_z"}}},
    Attribute{attribute::joined, "", {fresh, fresh}, {PlyValue::index, {"joined"}}},
    // Of faces and their corners.
    Attribute{attribute::texture, "", {computed, blend, "MeshEditor"}, {PlyValue::texture, {"texcoord"}}},
    Attribute{attribute::group, "", {copy, copy}, {PlyValue::index, {"group"}}},
    Attribute{attribute::material, "", {copy, copy}, {PlyValue::index, {"material"}}},
    Attribute{attribute::lining, "", {copy, copy}, {PlyValue::index, {"lining"}}},
    Attribute{attribute::warp, "", {copy, copy}, {PlyValue::direction, {"warp_x", "warp_y", "warp_z"}}},
    Attribute{attribute::rides, "", {copy, copy}, {PlyValue::count, {"rides"}}},
    Attribute{attribute::generation,
              "",
              {computed, computed, "MeshEditor; a subdivision leaves what CGAL's step leaves"},
              {PlyValue::index, {"generation"}}},
    Attribute{attribute::triangle_rest_length,
              "m",
              {unset, computed, "refine_rest"},
              {PlyValue::length, {"rest_length_01", "rest_length_12", "rest_length_20"}}},
    Attribute{
        attribute::second_texture, "", {computed, blend, "MeshEditor"}, {PlyValue::texture, {"texcoord_2"}}},
    // Of edges.
    Attribute{attribute::rest_length,
              "m",
              {computed, computed, "MeshEditor; refine_rest; ensure_rest_lengths"},
              {PlyValue::length, {"rest_length"}}},
    Attribute{attribute::bending_rest_length,
              "m",
              {unset, unset, "rebuild_bending_springs"},
              {PlyValue::length, {"bending_rest_length"}}},
    Attribute{attribute::rest_angle,
              "rad",
              {unset, unset, "ensure_rest_angles"},
              {PlyValue::angle, {"rest_angle"}}},
    Attribute{attribute::stiffness, "N/m", {unset, unset}, {PlyValue::stiffness, {"stiffness"}}},
    Attribute{attribute::bending_stiffness,
              "N/m",
              {unset, unset, "rebuild_bending_springs"},
              {PlyValue::stiffness, {"bending_stiffness"}}},
    Attribute{attribute::hinge_stiffness, "N m", {unset, unset}, {PlyValue::stiffness, {"hinge_stiffness"}}},
    Attribute{attribute::tension, "N", {unset, unset}, {PlyValue::stiffness, {"tension"}}},
    Attribute{attribute::bending_count,
              "",
              {unset, unset, "rebuild_bending_springs"},
              {PlyValue::count, {"bending_count"}}},
    Attribute{attribute::line_edge, "", {halves, halves}, {PlyValue::flag, {"line_edge"}}},
    Attribute{attribute::diagonal,
              "",
              {fresh, computed, "carry_diagonals of subdivide"},
              {PlyValue::flag, {"diagonal"}}},
    Attribute{attribute::press, "", {unset, unset}, {PlyValue::stiffness, {"press"}}},
};

}  // namespace rules
using rules::attribute_register;

}  // namespace furrow::geometry
