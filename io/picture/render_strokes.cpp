// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>

#include "geometry/mesh/edge_metric.h"
#include "geometry/mesh/errors.h"
#include "geometry/stroke/trace_stroke.h"
#include "io/picture/render_scene.h"

namespace furrow::io {
namespace {

using geometry::Mesh;
using geometry::Stroke;

/// The way from crossing to crossing, over the node in each face.
std::vector<Position> polyline(const Mesh& mesh, const geometry::SubStroke& part) {
  std::vector<Position> points;
  for (const geometry::CrossedFace& visit : part.faces) {
    if (visit.entry) points.push_back(position_of(visit.entry->position));
    points.push_back(position_of(geometry::position_of(mesh, {visit.face, visit.node})));
    if (visit.exit) points.push_back(position_of(visit.exit->position));
  }
  return points;
}

std::vector<std::vector<Position>> as_drawn(const Stroke& stroke) {
  std::vector<std::vector<Position>> parts(1);
  for (std::size_t i = 0; i < stroke.points.size(); ++i) {
    if (std::binary_search(stroke.breaks.begin(), stroke.breaks.end(), i)) parts.emplace_back();
    parts.back().push_back(position_of(stroke.points[i]));
  }
  if (stroke.closed && !stroke.points.empty()) parts[0].push_back(position_of(stroke.points.front()));
  return parts;
}

}  // namespace

std::vector<RenderLine> render_lines_from(const Mesh& mesh, const std::vector<Stroke>& strokes,
                                          std::vector<std::string>& warnings, const LineColours& colours) {
  const geometry::SurfaceProjector projector(mesh);
  double length = 0;
  for (geometry::Edge e : mesh.edges()) length += geometry::spatial_length(mesh, e);
  geometry::TraceOptions options;
  options.mean_edge = length / static_cast<double>(mesh.number_of_edges());
  std::vector<RenderLine> lines;
  for (const Stroke& stroke : strokes) {
    std::vector<std::vector<Position>> parts;
    try {
      const geometry::TracedStroke traced = trace_stroke(mesh, projector, stroke, options);
      warnings.insert(warnings.end(), traced.warnings.begin(), traced.warnings.end());
      for (const geometry::SubStroke& part : traced.sub_strokes) parts.push_back(polyline(mesh, part));
    } catch (const geometry::ContentError& error) {
      warnings.push_back(std::string(error.what()) + "; it is shown as it was drawn");
      parts = as_drawn(stroke);
    }
    const Colour& colour = stroke.height > 0   ? colours.ridge
                           : stroke.height < 0 ? colours.valley
                                               : colours.other;
    for (auto& part : parts) lines.push_back({std::move(part), colour});
  }
  return lines;
}

}  // namespace furrow::io
