// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/refine/transfer_shape.h"

#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "geometry/mesh/errors.h"
#include "geometry/mesh/preconditions.h"
#include "geometry/mesh/property_names.h"
#include "geometry/stroke/project_onto_surface.h"

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
      throw ContentError("transfer: the wrinkled mesh does not say where its vertices lay before (vertex " +
                         std::to_string(v.idx()) + "); take the PLY that insertion wrote, or a rest mesh");
    mesh.point(v) = {(*rest)[v][0], (*rest)[v][1], (*rest)[v][2]};
  }
  return mesh;
}

class Transfer {
 public:
  Transfer(const Mesh& original, const Mesh& wrinkled, const TransferOptions& options)
      : original_(original), wrinkled_(wrinkled), options_(options), rest_(at_rest(wrinkled)) {
    require_triangles(rest_, "transfer");
  }

  Point target(Vertex v) {
    const Point& p = original_.point(v);
    const bool known = wrinkled_.has_valid_index(v) && !wrinkled_.is_removed(v);
    if (known && CGAL::squared_distance(rest_.point(v), p) <= same * same) {
      ++report.copied;
      return moved(v) ? wrinkled_.point(v) : p;
    }
    if (original_.is_isolated(v)) return p;
    ++report.interpolated;
    return by_closest_point(v);
  }

  TransferReport report;

 private:
  bool moved(Vertex v) const { return wrinkled_.point(v) != rest_.point(v); }

  Point by_closest_point(Vertex v) {
    if (!projector_) projector_.emplace(rest_);
    const Point& p = original_.point(v);
    const SurfaceHit hit = projector_->closest(p);
    if (!(hit.distance <= options_.max_distance))
      throw ContentError("transfer: vertex " + std::to_string(v.idx()) + " of the original lies " +
                         std::to_string(hit.distance) + " m from the wrinkled mesh at rest, more than " +
                         std::to_string(options_.max_distance) +
                         " m; are they the same garment, in one unit (--unit)?");
    report.max_distance = std::max(report.max_distance, hit.distance);
    const auto corners = corners_of(rest_, hit.point.face);
    if (!moved(corners[0]) && !moved(corners[1]) && !moved(corners[2])) return p;
    const Frame before = frame_of(rest_, hit.point.face), after = frame_of(wrinkled_, hit.point.face);
    const Vector offset = p - hit.position;
    Point result = position_of(wrinkled_, hit.point);
    for (int i = 0; i < 3; ++i) result = result + (offset * before.axes[i]) * after.axes[i];
    return result;
  }

  const Mesh &original_, &wrinkled_;
  const TransferOptions& options_;
  Mesh rest_;
  std::optional<SurfaceProjector> projector_;
};

}  // namespace

TransferReport transfer_shape(Mesh& original, const Mesh& wrinkled, const TransferOptions& options) {
  if (!(options.max_distance > 0))
    refuse("transfer", "max_distance must be > 0 m, not " + std::to_string(options.max_distance));
  require_finite(original, "transfer");
  require_finite(wrinkled, "transfer");
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
