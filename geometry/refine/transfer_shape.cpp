// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/refine/transfer_shape.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "geometry/mesh/errors.h"
#include "geometry/mesh/measures.h"
#include "geometry/mesh/preconditions.h"
#include "geometry/mesh/property_names.h"
#include "geometry/refine/subdivide.h"
#include "geometry/stroke/project_onto_surface.h"
#include "physics/base/cancel_scope.h"

namespace furrow::geometry {
namespace {

/// Positions as near as this are the same: what a change of units in a file may leave [m].
constexpr double same = 1e-9;

struct Frame {
  std::array<Vector, 3> axes;
};

/// First edge, normal and what is orthogonal to both.
Frame frame_of(const Mesh& mesh, Face face) {
  const auto c = corners_of(mesh, face);
  const Vector x = normalized(mesh.point(c[1]) - mesh.point(c[0])),
               z = normalized(area_normal_of(mesh, face));
  return {{x, CGAL::cross_product(z, x), z}};
}

/// The mesh as it was before lines, pose and motion.
Mesh at_rest(const Mesh& wrinkled) {
  const auto rest = find_map(wrinkled, attribute::rest_position);
  Mesh mesh = wrinkled;
  for (Vertex v : mesh.vertices()) {
    if (!rest || !std::isfinite((*rest)[v][0] + (*rest)[v][1] + (*rest)[v][2]))
      throw ContentError(
          "transfer: the wrinkled mesh does not say where its vertices lay before (vertex " +
          std::to_string(v.idx()) +
          "); take the PLY that `furrow wrinkle` wrote, or name the shape before with `rest_shape`");
    mesh.point(v) = {(*rest)[v][0], (*rest)[v][1], (*rest)[v][2]};
  }
  return mesh;
}

/// Where `steps` Loop subdivisions put the vertices of a mesh, by index; isolated ones stay.
std::vector<Point> loop_positions(const Mesh& mesh, int steps) {
  Mesh refined;
  for (Vertex v : mesh.vertices()) refined.add_vertex(mesh.point(v));
  for (Face f : mesh.faces()) {
    const auto c = corners_of(mesh, f);
    refined.add_face(c[0], c[1], c[2]);
  }
  loop_subdivide(refined, steps);
  std::vector<Point> positions;
  for (Vertex v : mesh.vertices()) positions.push_back(refined.point(v));
  return positions;
}

constexpr double near = 1e-7;  ///< what text with few digits leaves [m]

/// Those positions after as many subdivisions as put the original's vertices where those of the same index
/// rest in the other mesh; empty if none of one to four do.
std::vector<Point> positions_at_rest(const Mesh& original, const Mesh& rest) {
  constexpr double least_fitting = 0.75;  // share of the vertices
  if (original.has_garbage() || rest.has_garbage()) return {};
  std::size_t faces = 4 * original.number_of_faces();
  for (int steps = 1; steps <= 4 && faces <= rest.number_of_faces(); ++steps, faces *= 4) {
    const std::vector<Point> moved = loop_positions(original, steps);
    const auto fit = std::count_if(original.vertices().begin(), original.vertices().end(), [&](Vertex v) {
      return original.is_isolated(v) || CGAL::squared_distance(moved[v.idx()], rest.point(v)) <= near * near;
    });
    // The others slid onto a line: the rule fold moves a few within the surface.
    if (static_cast<double>(fit) >= least_fitting * static_cast<double>(original.number_of_vertices()))
      return moved;
  }
  return {};
}

class Transfer {
 public:
  Transfer(const Mesh& original, const Mesh& wrinkled, const TransferOptions& options)
      : original_(original), wrinkled_(wrinkled), options_(options), rest_(at_rest(wrinkled)) {
    require_triangles(rest_, "transfer");
    const bool same_mesh = std::all_of(original.vertices().begin(), original.vertices().end(),
                                       [&](Vertex v) { return original.is_isolated(v) || is_known(v); });
    if (!same_mesh) refined_ = positions_at_rest(original, rest_);
  }

  Point target(Vertex v) {
    physics::throw_if_cancelled("transfer");
    const Point& p = original_.point(v);
    if (is_known(v)) {
      ++report.copied;
      return moved(v) ? wrinkled_.point(v) : p;
    }
    if (original_.is_isolated(v)) return p;
    if (!refined_.empty() && CGAL::squared_distance(rest_.point(v), refined_[v.idx()]) <= near * near) {
      ++report.by_index;
      return by_index(v);
    }
    ++report.interpolated;
    return by_closest_point(v, refined_.empty() ? p : refined_[v.idx()]);
  }

  TransferReport report;

 private:
  bool is_known(Vertex v) const {
    return wrinkled_.has_valid_index(v) && !wrinkled_.is_removed(v) &&
           CGAL::squared_distance(rest_.point(v), original_.point(v)) <= same * same;
  }

  /// Follows the vertex of the same index; the way from there to the original is turned with a face at it.
  Point by_index(Vertex v) const {
    const Face face =
        wrinkled_.face(wrinkled_.is_border(wrinkled_.halfedge(v)) ? wrinkled_.opposite(wrinkled_.halfedge(v))
                                                                  : wrinkled_.halfedge(v));
    const Point& p = original_.point(v);
    const auto corners = corners_of(rest_, face);
    if (!moved(corners[0]) && !moved(corners[1]) && !moved(corners[2])) return p;
    return turned(wrinkled_.point(v), p - rest_.point(v), face);
  }

  /// A place of the wrinkled mesh, plus an offset at rest that is turned with a face.
  Point turned(Point place, const Vector& offset, Face face) const {
    const Frame before = frame_of(rest_, face), after = frame_of(wrinkled_, face);
    for (int i = 0; i < 3; ++i) place = place + (offset * before.axes[i]) * after.axes[i];
    return place;
  }

  bool moved(Vertex v) const { return wrinkled_.point(v) != rest_.point(v); }

  /// `at`: where the vertex would lie at rest, had no line moved it.
  Point by_closest_point(Vertex v, const Point& at) {
    if (!projector_) projector_.emplace(rest_);
    const Point& p = original_.point(v);
    const SurfaceHit hit = projector_->closest(at);
    if (!(hit.distance <= options_.max_distance))
      throw ContentError("transfer: vertex " + std::to_string(v.idx()) + " of the original lies " +
                         length_text(hit.distance) + " from the wrinkled mesh at rest, more than " +
                         length_text(options_.max_distance) +
                         "; are they the same garment, in one unit (`unit`)?");
    report.max_distance = std::max(report.max_distance, hit.distance);
    const auto corners = corners_of(rest_, hit.point.face);
    if (!moved(corners[0]) && !moved(corners[1]) && !moved(corners[2])) return p;
    return turned(position_of(wrinkled_, hit.point), p - hit.position, hit.point.face);
  }

  const Mesh &original_, &wrinkled_;
  const TransferOptions& options_;
  Mesh rest_;
  std::vector<Point> refined_;  ///< where Loop put the original's vertices; empty: it did not
  std::optional<SurfaceProjector> projector_;
};

}  // namespace

TransferReport transfer_shape(Mesh& original, const Mesh& wrinkled, const TransferOptions& options) {
  if (!(options.max_distance > 0))
    refuse("transfer", "max_distance must be > 0 m, not " + length_text(options.max_distance));
  for (const Mesh* mesh : {&std::as_const(original), &wrinkled}) {
    require_structure(*mesh, "transfer");
    require_finite(*mesh, "transfer");
  }
  Transfer transfer(original, wrinkled, options);
  std::vector<Point> targets(original.num_vertices());
  for (Vertex v : original.vertices()) targets[v.idx()] = transfer.target(v);
  for (Vertex v : original.vertices()) {
    transfer.report.unchanged += original.point(v) == targets[v.idx()];
    original.point(v) = targets[v.idx()];
  }
  return transfer.report;
}

}  // namespace furrow::geometry
