// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/band/band_report.h"

#include <algorithm>
#include <limits>
#include <numbers>

namespace furrow::geometry {
namespace {

BandChain chain_of(const BandMesh& band, const CurveArcs& arcs, std::size_t index) {
  BandChain chain{-1, {}, {}, arcs.closed[index], 0};
  std::vector<const std::map<double, Vertex>*> on;
  for (std::size_t i = 0; i < arcs.arcs.size(); ++i) {
    const BandCurve& curve = band.curves[i];
    on.push_back(&curve.vertices);
    if (arcs.curve[i] != index) continue;
    chain.line = arcs.arcs[i].line;
    for (const auto& [along, v] : curve.vertices)
      chain.lateral =
          std::max(chain.lateral, curve.nearest(band.mesh.point(v), along, curve.h_at(along)).distance);
  }
  for (const auto& [along, v] : arcs.joined(index, on)) {
    chain.vertices.push_back(v);
    chain.along.push_back(along);
  }
  return chain;
}

}  // namespace

double smallest_angle_of(const BandMesh& band) {
  double least = std::numbers::pi / 3;
  for (Face f : band.mesh.faces())
    if (band.in_band[f.idx()])
      least = std::min(least, smallest_angle(rest_lengths_of(band.mesh, band.rest, f)));
  return least * 180 / std::numbers::pi;
}

BandReport report_on(const BandMesh& band, const CurveArcs& arcs) {
  BandReport report;
  for (std::size_t i = 0; i < arcs.length.size(); ++i) report.chains.push_back(chain_of(band, arcs, i));
  report.places = band.place;
  report.in_band = band.in_band;
  report.split_edges = band.cut_lines;
  report.inserted = band.splits;
  report.flipped = band.flips;
  report.detours = band.detours;
  report.changed_faces.assign(band.editor.changed().begin(), band.editor.changed().end());
  for (std::size_t i = 0; i < band.old_vertices; ++i)
    if (band.moved[i]) report.snapped.push_back(Vertex(static_cast<Vertex::size_type>(i)));
  report.min_angle_deg = smallest_angle_of(band);
  report.shortest_edge = std::numeric_limits<double>::infinity();
  for (Face f : band.mesh.faces())
    if (band.in_band[f.idx()])
      for (double l : rest_lengths_of(band.mesh, band.rest, f))
        report.shortest_edge = std::min(report.shortest_edge, l);
  return report;
}

}  // namespace furrow::geometry
