// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/insert/flip_rules.h"

namespace furrow::geometry {
namespace {

/// A flipped pair's smaller face keeps at least this part of the pair's area.
constexpr double least_area = 1e-3;

bool too_few_edges_left(const Mesh& mesh, Vertex v) {
  const std::size_t least = mesh.is_border(v) ? 2 : 3;
  return mesh.degree(v) < least + 1;
}

bool convex(const MeshEditor& editor, Edge edge, double least_part) {
  const auto areas = unfold(editor.mesh(), editor.rest(), edge).flipped_areas();
  const double least = least_part * (areas[0] + areas[1]);
  return areas[0] > 0 && areas[1] > 0 && areas[0] >= least && areas[1] >= least;  // false for NaN
}

/// Whether the flip keeps the triangles of texture maps the right way round; where they are not now, it may.
bool convex_in_texture(const MeshEditor& editor, Edge edge) {
  for (const auto& areas : editor.texture_areas(edge)) {
    if (!(areas[0] * areas[1] > 0)) continue;  // NaN, folded or flat already
    const double whole = areas[0] + areas[1];
    if (!(areas[2] / whole >= least_area && areas[3] / whole >= least_area)) return false;
  }
  return true;
}

}  // namespace

std::optional<Refusal> refusal_of_flip(const MeshEditor& editor, Edge edge, const InsertionOptions& options) {
  const Mesh& mesh = editor.mesh();
  if (mesh.is_border(edge)) return Refusal::border;
  const Halfedge h = mesh.halfedge(edge), o = mesh.opposite(h);
  const Vertex a = mesh.source(h), b = mesh.target(h);
  const Vertex c = mesh.target(mesh.next(h)), d = mesh.target(mesh.next(o));
  const bool duplicate = c == d || mesh.halfedge(c, d).is_valid();
  if (options.rule == InsertionRule::paper)
    return duplicate ? std::optional(Refusal::duplicate_edge) : std::nullopt;
  if (editor.line_edge()[edge]) return Refusal::line_edge;
  if (editor.is_seam(edge)) return Refusal::seam;
  if (duplicate) return Refusal::duplicate_edge;
  if (!convex(editor, edge, least_area) || !convex_in_texture(editor, edge)) return Refusal::not_convex;
  if (too_few_edges_left(mesh, a) || too_few_edges_left(mesh, b)) return Refusal::valence;
  if (options.may_flip && !options.may_flip({mesh.point(a), mesh.point(b), mesh.point(c), mesh.point(d)})) {
    return Refusal::layer;
  }
  return std::nullopt;
}

bool folds_over(const MeshEditor& editor, Edge edge) { return !convex(editor, edge, 0); }

}  // namespace furrow::geometry
