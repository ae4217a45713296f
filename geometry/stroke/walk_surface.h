// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <optional>
#include <vector>

#include "geometry/mesh/face_point.h"

namespace furrow::geometry {

/// A point where a path leaves a face: `halfedge` belongs to the face that it leaves.
struct EdgeCrossing {
  Halfedge halfedge;
  double t = 0;    ///< position on the halfedge from its source [-]; [0, 1]
  Point position;  ///< [m]
};

struct SurfaceWalk {
  enum class End {
    reached,   ///< the target's face
    border,    ///< the last crossing leads off the mesh
    stopped,   ///< as far as the target along the chord, no border met (only without a target face)
    too_long,  ///< longer than the limit
    no_way,    ///< the chord is normal to the surface or has no length
  };
  End end = End::no_way;
  std::vector<EdgeCrossing> crossings;  ///< in order
  double length = 0;                    ///< up to the last crossing [m]
};

/// Walks from face to face along the plane that holds `start`, `target` and `normal`. A vertex on the plane
/// counts as beside it, always on the same side, so a path never passes through a vertex. `start` must lie
/// strictly inside `face`. Ends in `target_face` if given, else at the border or where the target is passed.
/// O(crossed faces).
SurfaceWalk walk_surface(const Mesh& mesh, Face face, const Point& start, const Point& target,
                         const Vector& normal, std::optional<Face> target_face, double length_limit);

/// The faces that can be reached from `face` through faces with a corner within `radius` [m] of `centre`;
/// ascending.
std::vector<Face> faces_reachable_within(const Mesh& mesh, Face face, const Point& centre, double radius);

/// Crossings of the way from face to face with the fewest edges; each at the point of its edge closest to
/// `guide`, but never nearer to an end than 1e-3 of it. Empty if `to` is `from` or more than `most` edges
/// away. O(faces within `most`).
std::vector<EdgeCrossing> fewest_crossings(const Mesh& mesh, Face from, Face to, const Point& guide,
                                           std::size_t most);

}  // namespace furrow::geometry
