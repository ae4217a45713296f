// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/mesh/texture_charts.h"

#include <algorithm>
#include <cmath>

#include "geometry/mesh/errors.h"
#include "geometry/mesh/preconditions.h"

namespace furrow::geometry {
namespace {

constexpr double same = 1e-7;            ///< texture coordinates that differ by less agree
constexpr double inside_margin = -1e-9;  ///< least barycentric of a point in a triangle

bool agree(const TextureCoordinate& a, const TextureCoordinate& b) {
  return std::abs(a[0] - b[0]) <= same && std::abs(a[1] - b[1]) <= same;
}

double cross(const TextureCoordinate& o, const TextureCoordinate& a, const TextureCoordinate& b) {
  return (a[0] - o[0]) * (b[1] - o[1]) - (a[1] - o[1]) * (b[0] - o[0]);
}

HalfedgeMap<TextureCoordinate> texture_of(const Mesh& mesh) {
  const auto map = find_map(mesh, attribute::texture);
  const auto has = [&](Halfedge h) { return std::isfinite((*map)[h][0]) && std::isfinite((*map)[h][1]); };
  if (!map || std::none_of(mesh.halfedges().begin(), mesh.halfedges().end(), has))
    throw ContentError("the mesh has no texture coordinates; export them (vt in OBJ), or draw otherwise");
  return *map;
}

}  // namespace

TextureCharts::TextureCharts(const Mesh& mesh)
    : mesh_(mesh), texture_(texture_of(mesh)), chart_(mesh.num_faces(), -1) {
  require_triangles(mesh, "texture_charts");
  join_faces();
}

void TextureCharts::join_faces() {
  int next = 0;
  for (Face first : mesh_.faces()) {
    if (chart_[first.idx()] >= 0) continue;
    std::vector<Face> queue{first};
    chart_[first.idx()] = next;
    while (!queue.empty()) {
      const Face face = queue.back();
      queue.pop_back();
      for (Halfedge h : halfedges_of(mesh_, face)) {
        if (is_seam(mesh_.edge(h))) continue;
        const Face beyond = mesh_.face(mesh_.opposite(h));
        if (chart_[beyond.idx()] >= 0) continue;
        chart_[beyond.idx()] = next;
        queue.push_back(beyond);
      }
    }
    ++next;
  }
}

std::array<TextureCoordinate, 3> TextureCharts::corners(Face face) const {
  const auto h = halfedges_of(mesh_, face);
  return {at_source(h[0]), at_source(h[1]), at_source(h[2])};
}

double TextureCharts::signed_area(Face face) const {
  const auto [a, b, c] = corners(face);
  return cross(a, b, c);
}

Barycentrics TextureCharts::barycentrics(Face face, const TextureCoordinate& p) const {
  const auto [a, b, c] = corners(face);
  const double area = cross(a, b, c);
  return {cross(p, b, c) / area, cross(a, p, c) / area, cross(a, b, p) / area};
}

std::vector<Face> TextureCharts::faces_at(const TextureCoordinate& point) const {
  std::vector<Face> found;
  for (Face face : mesh_.faces()) {
    const Barycentrics b = barycentrics(face, point);
    // Also false for NaN: no texture there, or no area.
    if (std::min({b[0], b[1], b[2]}) >= inside_margin && b[0] + b[1] + b[2] < 2) found.push_back(face);
  }
  return found;
}

bool TextureCharts::is_seam(Edge edge) const {
  const Halfedge h = mesh_.halfedge(edge), o = mesh_.opposite(h);
  if (mesh_.is_border(h) || mesh_.is_border(o)) return true;
  return !agree(at_source(h), at_target(o)) || !agree(at_target(h), at_source(o));
}

}  // namespace furrow::geometry
