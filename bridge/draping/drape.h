// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "geometry/mesh/mesh_fwd.h"
#include "physics/body/collider.h"
#include "physics/pairs/untangle_contours.h"
#include "physics/rest/settle.h"

namespace furrow::bridge {

/// What drapes of one garment share, one after the other: the patterns of each level
/// (physics::StiffnessWork).
struct DrapeWork {
  std::vector<physics::StiffnessWork> levels;
};

/// Where a garment is refined (want_of_refinement()).
struct RefineWhere {
  double finest = 0;   ///< a face that is cut has the area of one with edges 1.5 times as long [m]; >= 0
  double bend = 0.15;  ///< angle across an edge that asks for finer ones [rad]; > 0
  double seen = 2e-4;  ///< height of folds that would be seen [m]; > 0
  std::size_t most_vertices = 20000;  ///< about
};

struct DrapeOptions {
  int refinements = 0;  ///< Loop subdivisions between the given mesh and the fitted one; in [0, 6]
  /// Faces are refined where they ask for it, as often at most; none: all are.
  std::optional<RefineWhere> where;
  /// Of the last level; others end at coarse_tolerance, at any depth. self.drawn: the garment as it was made.
  /// With self.on, starts are guarded, too.
  physics::SettleOptions settle;
  /// Paper 2's plain scheme (displace_by_force()), to compare with: it takes a hundred times as
  /// long. It has the same friction, gap, tolerance and contact of cloth with cloth; max_iterations bounds
  /// its passes.
  bool plain = false;
  double coarse_tolerance = 100;  ///< residual force at which the next level takes over [-]; > 0
  /// How far the start is disturbed along its normals, as a share of the diagonal of the garment's box (root
  /// mean square) [-]; >= 0; half as far on each finer level. Without it cloth that must buckle balances on
  /// the way to it. It belongs to places of the garment as it was given, not to vertices (place_noise.h).
  double disturbance = 1e-4;
  std::uint64_t seed = 0;     ///< of the disturbance: another one may lead to another rest
  DrapeWork* work = nullptr;  ///< shared with drapes of the same garment; null: none
  /// How many times softer the triangles of the first level are in a search that comes before its own and
  /// ends at coarse_tolerance [-]; >= 1; 1: none. Stiff cloth with many folds is slow to find its way, as
  /// every step that turns a fold stretches it; it finds it in a third of the iterations from where soft
  /// cloth rests.
  double soft_start = 1;
  /// Whether what is held are parts laid aside, as nothing carries them: they carry nothing either, and where
  /// all others fall, there are no finer levels.
  bool held_aside = false;
  /// Internal friction of bending on the last level, as a moment a metre of crease [N]; >= 0, 0: none. It
  /// needs linear hinges or a plate, and not plain. See physics/rest/hinge_friction.h, plate_friction.h.
  double bending_friction = 0;
  /// Asked when a search was stopped, and on the way up to the next level: true: the drape ends with the
  /// level that it has come to. Empty: a search that was stopped is carried up to the last level.
  std::function<bool()> interrupted = {};
};

/// The energy of a cloth by what stores it [J].
struct EnergyParts {
  double stretch = 0;  ///< structural springs, tension and triangles
  double bending = 0;  ///< hinges, plates and other energies; without any, the springs across edges
  double ties = 0;     ///< struts: bands, joined seams
  double weight = 0;   ///< against where it lay before
  double contact = 0;  ///< with the body, its friction, and of the cloth with itself
  double total() const { return stretch + bending + ties + weight + contact; }
};

struct DrapeLevel {
  std::size_t vertices = 0;
  physics::PushOutReport pushed;     ///< out of the body before it began
  int stopped = 0;                   ///< vertices that cloth kept from where they were to begin
  physics::ContourReport untangled;  ///< where it crossed itself then, with contact of cloth with cloth
  physics::SettleReport settle;      ///< iterations of the plain scheme: its passes
  physics::SettleReport soft;        ///< of the search before, with a soft_start

  /// Whether contact of cloth with cloth changed anything: else all is as without, bit by bit.
  bool acted() const { return stopped > 0 || untangled.at_start > 0 || settle.self.acted || soft.self.acted; }
};
struct DrapeReport {
  std::vector<DrapeLevel> levels;    ///< coarse to fine
  double disturbance = 0;            ///< of the last level [m]
  int friction_rounds = 0;           ///< rests after each of which what bends too far gave way
  double slip = 0;                   ///< of a hinge or an edge in the last of them [rad]
  EnergyParts energy;                ///< of the last level; weight against the garment as it was given
  bool stopped = false;              ///< by go_on, or interrupted
  bool falls = false;                ///< a coarse level came to lie on nothing: there are no finer ones
  std::size_t uniform_vertices = 0;  ///< with DrapeOptions::where: as many it would have, refined everywhere
  bool ran_out = false;              ///< of vertices, or cuts of a face, where more were asked for
  bool local() const { return uniform_vertices > 0; }
};

/// Makes a garment cloth: fills its maps, gathers and pins. Called once for each level, with the mesh as it
/// was made.
using MakeCloth = std::function<physics::Cloth(geometry::Mesh&)>;
/// Gets the level, the progress of its settle() and its cloth. Returns false to stop here.
using DrapeObserver = std::function<bool(int level, const physics::SettleProgress&, const physics::Cloth&)>;

/// Fits a garment on a body (null: it only hangs), from the coarse mesh to the finest. On return the mesh is
/// refined, has the maps of make_cloth, and its vertices lie where they rest. `cloth` belongs to it, with the
/// hinges of friction at its end. If stopped on a coarse level, the rest of the way is only carried; if
/// interrupted, or where the garment falls past the body, it ends with that level. Same input, same bits.
/// Cost: most of it is the last level's. Throws std::invalid_argument for an option out of its range, the
/// mesh unchanged; physics::Cancelled if interrupted before there is a level; and as loop_subdivide(),
/// make_cloth and settle() do.
///
/// \details Each level first brings out what lies nearer than the gap (a finer one only what lies deeper than
/// cloth does at rest), then finds rest, and carries that shape to the next finer level: Loop's masks take
/// positions as they take the rest shape.
DrapeReport drape(geometry::Mesh& garment, physics::Cloth& cloth, const physics::Collider* body,
                  const DrapeOptions& options, const MakeCloth& make_cloth, const DrapeObserver& go_on = {});

}  // namespace furrow::bridge
