// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/fold/fold_clusters.h"

#include <algorithm>
#include <map>

#include "geometry/band/base_surface.h"

namespace furrow::geometry {
namespace {

constexpr int rings_around = 8;  ///< averaged_normals() reads seven

/// The lowest line of each set of lines that hang together.
class Joined {
 public:
  int of(int line) {
    while (first_.try_emplace(line, line).first->second != line) line = first_[line];
    return line;
  }
  void join(int a, int b) {
    const int x = of(a), y = of(b);
    first_[std::max(x, y)] = std::min(x, y);
  }

 private:
  std::map<int, int> first_;
};

bool is_as_before(const Mesh& mesh, const Mesh& garment, Face f) {
  const auto corners = corners_of(garment, f);
  return corners_of(mesh, f) == corners && std::all_of(corners.begin(), corners.end(), [&](Vertex v) {
           return mesh.point(v) == garment.point(v);
         });
}

Face face_at(const Mesh& mesh, Vertex v) {
  for (Face f : mesh.faces_around_target(mesh.halfedge(v)))
    if (f.is_valid()) return f;
  return {};
}

void measure_arc(FoldCurve& curve) {
  for (std::size_t i = 1; i < curve.points.size(); ++i)
    curve.arc[i] = curve.arc[i - 1] + (curve.points[i] - curve.points[i - 1]).norm();
  curve.length = curve.arc.back() + (curve.closed ? (curve.points.front() - curve.points.back()).norm() : 0);
}

}  // namespace

std::vector<FoldCluster> clusters_of(const Mesh& mesh, std::span<const FoldCurve> curves,
                                     const BandOptions& options) {
  Joined joined;
  std::vector<int> owner(mesh.num_faces(), -1);
  for (const FoldCurve& curve : curves)
    for (Face f : faces_of_band(mesh, {&curve, 1}, options, false)) {
      if (owner[f.idx()] >= 0) joined.join(owner[f.idx()], curve.line);
      owner[f.idx()] = curve.line;
    }
  std::map<int, FoldCluster> by_first;
  for (const FoldCurve& curve : curves) {
    FoldCluster& cluster = by_first[joined.of(curve.line)];
    if (cluster.lines.empty() || cluster.lines.back() != curve.line) cluster.lines.push_back(curve.line);
    cluster.curves.push_back(curve);
  }
  std::vector<FoldCluster> clusters;
  for (auto& entry : by_first) clusters.push_back(std::move(entry.second));
  std::sort(clusters.begin(), clusters.end(),
            [](const FoldCluster& a, const FoldCluster& b) { return a.lines.back() < b.lines.back(); });
  return clusters;
}

FoldCurve carried_to(const Mesh& mesh, const Mesh& garment, const FoldCurve& curve) {
  FoldCurve carried = curve;
  Face last;
  bool moved = false;
  for (std::size_t i = 0; i < curve.points.size(); ++i) {
    const Face before = curve.places[i].face;
    if (is_as_before(mesh, garment, before)) {
      last = before;
      continue;
    }
    const Eigen::Vector3d& p = curve.points[i];
    const Face from = last.is_valid() ? last : face_at(mesh, corners_of(garment, before)[0]);
    carried.places[i] = walk_towards(mesh, from, {p.x(), p.y(), p.z()}, [](Edge) { return true; });
    last = carried.places[i].face;
    const Point at = position_of(mesh, carried.places[i]);
    carried.points[i] = {at.x(), at.y(), at.z()};
    moved = true;
  }
  if (moved) measure_arc(carried);
  return carried;
}

std::vector<Face> faces_to_fold(const Mesh& mesh, std::span<const FoldCurve> curves,
                                const BandOptions& options) {
  std::vector<Face> faces = faces_of_band(mesh, curves, options, true);
  std::vector<bool> inside(mesh.num_faces(), false);
  for (Face f : faces) inside[f.idx()] = true;
  std::size_t first = 0;
  for (int ring = 0; ring < rings_around; ++ring)
    for (const std::size_t end = faces.size(); first < end; ++first)
      for (Vertex v : corners_of(mesh, faces[first]))
        for (Face f : mesh.faces_around_target(mesh.halfedge(v)))
          if (f.is_valid() && !inside[f.idx()]) inside[f.idx()] = true, faces.push_back(f);
  std::sort(faces.begin(), faces.end());
  return faces;
}

}  // namespace furrow::geometry
