// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <optional>
#include <utility>
#include <vector>

#include "geometry/mesh/mesh_fwd.h"
#include "physics/base/arrays.h"
#include "physics/cloth/cloth.h"

namespace furrow::geometry {
struct Body;  // geometry/figure/repair_body.h
}

namespace furrow::bridge {

/// What resists stretching. The laws of the springs differ on uneven meshes only.
enum class Membrane {
  paper,       ///< springs of k = (r / r_avg) k_std (method S1.7)
  uniform,     ///< k = k_std
  inverse,     ///< k = (r_avg / r) k_std: that of a thread
  van_gelder,  ///< k = Y sum of the rest areas beside the edge / r^2 (Van Gelder 1998)
  triangles,   ///< triangles of constant strain: a plane sheet of Y and Poisson's ratio on every mesh
  tension,     ///< quadratic, asymmetric tension (method S2.2, bridge/arrays/tension_constants.h)
  patches      ///< triangles that physics::join_patches() is to be called for, once pins are set
};

/// The word of each in scenes and flags.
inline constexpr std::pair<const char*, Membrane> membrane_words[] = {
    {"paper", Membrane::paper},           {"uniform", Membrane::uniform},     {"inverse", Membrane::inverse},
    {"van-gelder", Membrane::van_gelder}, {"triangles", Membrane::triangles}, {"tension", Membrane::tension},
    {"patches", Membrane::patches}};

/// The array of a cloth that a membrane of triangles fills: calls visit(elements); false if it is none of
/// triangles. The kind must be a physics::MembraneTriangle or derive from it.
template <class Visit>
bool visit_triangles(Membrane membrane, physics::Cloth& cloth, Visit&& visit) {
  switch (membrane) {
    case Membrane::triangles:
    case Membrane::patches:
      visit(cloth.membrane);
      return true;
    default:
      return false;
  }
}

/// What resists bending.
enum class Bending {
  cross,   ///< springs across the edges (method S1.1): a look, without a rigidity about flat
  hinge,   ///< signed hinges with a rest angle, k = B l^2 / (A1 + A2): a plate of rigidity B
  cosine,  ///< the same k in the law of method S2.3: none of first order about rest
  plate    ///< hinges that couple_bending() makes one plate of: the same bending on every mesh
};

/// How a garment's mass lies on its vertices.
enum class MassRule {
  area,  ///< v:mass as it is: by area (method S1.8)
  equal  ///< the garment's mass divided by the number of its vertices (method S2.5)
};

/// Woven cloth: what strips along warp and weft resist with. Its directions are the mesh's (f:warp).
struct Weave {
  double warp, weft, shear;            ///< Y1, Y2, G of triangles [N/m]; > 0
  double poisson;                      ///< nu12 of triangles [-]; nu12^2 < Y1 / Y2
  double bend_warp, bend_weft, twist;  ///< B1, B2, B_t of Bending::plate [N m]; > 0
};

/// How a mesh's maps become masses, springs, triangles and hinges.
struct GatherOptions {
  double structural_stiffness = 1000;  ///< k_std of the structural springs [N/m]; > 0
  double bending_stiffness = 10;       ///< k_std of the bending springs [N/m]; >= 0
  double mean_structural_length = 0;   ///< r_avg of the initial model's structural springs [m]; > 0
  double mean_bending_length = 0;  ///< r_avg of the initial model's bending springs [m]; > 0 if there are any
  Membrane membrane = Membrane::paper;
  Bending bending = Bending::cross;
  double stretch = 1000;     ///< Y, Young's modulus times thickness [N/m], of van_gelder and triangles; > 0
  double poisson = 0.3;      ///< of triangles [-]; in (-1, 1)
  double rigidity = 1e-5;    ///< B of hinge, cosine and plate [N m]; >= 0
  double tension = 50000;    ///< c of tension, see tension_constants() [N/m]; > 0
  double compression = 0.2;  ///< push over pull of tension at the same |e| [-]; in [0, 1]
  double shear = 0.2;        ///< of diagonals over that of threads in tension [-]; in [0, 1]
  MassRule mass_rule = MassRule::area;
  /// In place of stretch and poisson of triangles, and of rigidity of a plate.
  std::optional<Weave> weave = {};
  /// By line id: factors on the hinges in a line's region [-], >= 1, and the lines' widths [m], NaN: none
  /// (geometry/fold/line_press.h). What is missing at the end counts as 1, and as none.
  std::vector<double> line_presses = {}, line_widths = {};
};

/// The mesh as plain arrays: particles by gather_particles(), springs, triangles and hinges by the options.
/// Only what the options choose is filled. O(edges log edges). Throws std::invalid_argument if an option is
/// out of its range, a map is missing, or the mesh has removed elements (collect its garbage first);
/// ContentError for a rest length or a mass that is not > 0, a stiffness that is set and not >= 0 and finite,
/// a triangle without area at rest, a face of woven cloth without a direction of the warp.
///
/// \details Rest lengths come from e:rest_length (of a triangle h:rest_length where it is set) and
/// e:bending_rest_length, rest angles from e:rest_angle (0 where it is unset). Stiffnesses come from
/// e:stiffness, e:bending_stiffness, e:hinge_stiffness and e:tension where they are set. Elsewhere they
/// follow the options' law: a hinge's is multiplied by the press of its lines, and a bending spring that
/// stands for several hinges has their number (e:bending_count) times the stiffness. Struts follow among the
/// bending springs, whatever the law of bending.
physics::Cloth gather(const geometry::Mesh& mesh, const GatherOptions& options);

/// A cloth, and where its elements come from, in their order.
struct GatheredCloth {
  physics::Cloth cloth;
  /// The null edge for a strut: among the bending springs or, in a mesh without faces, the structural ones.
  std::vector<geometry::Edge> structural, tension, bending, hinges;
  std::vector<geometry::Halfedge> membrane;  ///< to vertices[0] of each triangle, in its face
};
/// gather(), with the elements' origin.
GatheredCloth gather_with_origin(const geometry::Mesh& mesh, const GatherOptions& options);

/// The k_std [N/m] with which springs on equilateral triangles are a sheet of Y [N/m] (and of Poisson's ratio
/// 1/3): k = sqrt(3)/2 Y.
double spring_constant_of(double stretch);

/// Writes the particles' positions back to the vertices they were gathered from. All maps stay.
/// Throws std::invalid_argument, the mesh untouched, if the counts differ.
void scatter(const physics::Particles& particles, geometry::Mesh& mesh);
/// The same with their velocities, into v:velocity.
void scatter_velocities(const physics::Particles& particles, geometry::Mesh& mesh);

/// A repaired body as the plain triangles that distance queries take.
physics::TriangleMesh to_triangle_mesh(const geometry::Body& body);

}  // namespace furrow::bridge
