// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/mesh/weld.h"

#include <algorithm>
#include <span>

#include "geometry/figure/border_seams.h"
#include "geometry/mesh/face_point.h"
#include "geometry/mesh/measures.h"
#include "geometry/mesh/preconditions.h"
#include "geometry/mesh/property_names.h"
#include "geometry/mesh/vertex_attributes.h"
#include "io/mesh/merge_points.h"
#include "io/mesh/mesh_readers.h"

namespace furrow::io {
namespace {

using namespace geometry;

/// The seams, and each vertex with the first one at its place.
BorderSeams at_one_place(const Mesh& mesh, BorderSeams seams) {
  PointNumbers numbers;
  std::vector<Vertex> first;
  for (Vertex v : mesh.vertices()) {
    if (mesh.is_isolated(v)) continue;
    const auto [number, is_new] = numbers.number(mesh.point(v));
    is_new ? first.push_back(v) : seams.pairs.push_back({first[number], v});
  }
  return seams;
}

/// Of vertices that are joined, the first, in order; returns the point of each vertex. Of the first `kept`
/// each has a point, which no face need have.
std::vector<std::size_t> take_points(const Mesh& mesh, const std::vector<Vertex>& joined, std::size_t kept,
                                     PolygonSoup& soup) {
  const auto color = find_map(mesh, attribute::color);
  const auto others = vertex_attributes(mesh);
  for (const VertexAttribute& a : others) soup.attributes.push_back({a.name, {}});
  std::vector<std::size_t> point(mesh.num_vertices(), 0);
  for (Vertex v : mesh.vertices()) {
    const bool is_first = joined[v.idx()] == v;
    point[v.idx()] = is_first ? soup.points.size() : point[joined[v.idx()].idx()];
    if (v.idx() >= kept && (!is_first || mesh.is_isolated(v))) continue;
    soup.points.push_back(mesh.point(v));
    if (color) soup.colors.push_back((*color)[v]);
    for (std::size_t k = 0; k < others.size(); ++k) soup.attributes[k].values.push_back(others[k].values[v]);
  }
  return point;
}

struct SplitCorner {
  std::size_t point;
  TextureCoordinate texture;
};
using SplitCorners = std::array<SplitCorner, 3>;

/// Parts the triangle that has the side from one corner to the other by a corner amid it.
void cut_side(std::vector<SplitCorners>& parts, std::size_t from, std::size_t to, const SplitCorner& amid) {
  for (std::size_t i = 0; i < 3 * parts.size(); ++i) {
    SplitCorners& part = parts[i / 3];
    if (part[i % 3].point != from || part[(i + 1) % 3].point != to) continue;
    SplitCorners rest = part;
    part[(i + 1) % 3] = rest[i % 3] = amid;
    return parts.push_back(rest);
  }
}

/// A triangle, or its parts where vertices lie amid its sides. Corner k is the target of its halfedge k.
std::vector<SplitCorners> parts_of(const SplitCorners& corners, const std::array<Halfedge, 3>& borders,
                                   std::span<const SeamSplit> splits, const std::vector<std::size_t>& point) {
  std::vector<SplitCorners> parts{corners};
  for (std::size_t k = 0; k < 3; ++k) {
    const SplitCorner &a = corners[(k + 2) % 3], &b = corners[k];
    std::size_t to = b.point;
    auto s = std::lower_bound(splits.begin(), splits.end(), borders[k],
                              [](const SeamSplit& split, Halfedge h) { return split.border < h; });
    for (; s != splits.end() && s->border == borders[k]; ++s) {  // the border goes from b to a
      SplitCorner amid{point[s->at.idx()], {}};
      for (std::size_t i = 0; i < 2; ++i) amid.texture[i] = s->t * a.texture[i] + (1 - s->t) * b.texture[i];
      cut_side(parts, a.point, to, amid);
      to = amid.point;
    }
  }
  return parts;
}

void take_faces(const Mesh& mesh, const std::vector<std::size_t>& point, std::span<const SeamSplit> splits,
                PolygonSoup& soup) {
  const auto texture = find_map(mesh, attribute::texture);
  const auto group = find_map(mesh, attribute::group), material = find_map(mesh, attribute::material),
             lining = find_map(mesh, attribute::lining);
  const auto take = [&](Face f, const SplitCorners& corners, const std::optional<FaceMap<int>>& own) {
    for (const SplitCorner& corner : corners) {
      soup.corners.push_back(corner.point);
      if (texture) soup.textures.push_back(corner.texture);
    }
    soup.close_face();
    if (group) soup.groups.push_back((*group)[f]);
    if (material || lining) soup.materials.push_back(own ? (*own)[f] : -1);
  };
  for (Face f : mesh.faces()) {
    auto sides = halfedges_of(mesh, f);
    SplitCorners corners;
    for (std::size_t k = 0; k < 3; ++k)
      corners[k] = {point[mesh.target(sides[k]).idx()], texture ? (*texture)[sides[k]] : TextureCoordinate{}};
    for (Halfedge& h : sides) h = mesh.opposite(h);
    for (const SplitCorners& part : parts_of(corners, sides, splits, point)) {
      take(f, part, material);
      if (lining && (*lining)[f] >= 0) take(f, {part[0], part[2], part[1]}, lining);
    }
  }
}

void take_diagonals(const Mesh& before, const std::vector<std::size_t>& point, Mesh& mesh) {
  const auto was = find_map(before, attribute::diagonal);
  if (!was) return;
  auto diagonal = ensure_map(mesh, attribute::diagonal);
  const auto at = [&](Vertex v) { return Vertex(Vertex::size_type(point[v.idx()])); };
  for (const Edge e : before.edges())
    if (const Halfedge h = mesh.halfedge(at(before.vertex(e, 0)), at(before.vertex(e, 1)));
        (*was)[e] && h != Mesh::null_halfedge())
      diagonal[mesh.edge(h)] = true;
}

/// The file with pairs of vertices joined into the first of them, and faces split; the first `kept` vertices
/// stay, if without faces.
MeshFile rebuilt(const MeshFile& file, const std::string& name, const std::vector<Vertex>& into,
                 const BorderSeams& seams, std::size_t kept = 0) {
  PolygonSoup soup;
  const std::vector<std::size_t> point = take_points(file.mesh, into, kept, soup);
  take_faces(file.mesh, point, seams.splits, soup);
  MeshFile result = file;
  result.mesh = Mesh();
  result.polylines.clear();
  result.warnings.clear();
  result.repairs = {};
  result.repairs.merged_vertices = file.mesh->number_of_vertices() - soup.points.size();
  set_mesh(result, soup, name);
  take_diagonals(file.mesh, point, result.mesh);
  return result;
}

/// The same with vertices that lie at one place joined, too.
MeshFile rebuilt_at_places(const MeshFile& file, const std::string& name, BorderSeams seams) {
  seams = at_one_place(file.mesh, std::move(seams));
  return rebuilt(file, name, joined_vertices(file.mesh, seams), seams);
}

/// The file as it was read, with these seams joined.
MeshFile joined(const MeshFile& file, const std::string& name, const std::vector<Vertex>& into,
                const BorderSeams& seams, bool keeps) {
  const std::size_t own = file.mesh->num_vertices() - file.repairs.duplicated_vertices;
  MeshFile result = rebuilt(file, name, into, seams, keeps ? own : 0);
  std::size_t doubled = result.repairs.duplicated_vertices, merged = result.repairs.merged_vertices;
  for (std::size_t v = own; v < into.size(); ++v) doubled += into[v].idx() == v;  // these are still the last
  result.repairs = file.repairs;
  result.repairs.duplicated_vertices = doubled;
  result.repairs.merged_vertices += merged;
  result.warnings = file.warnings;
  if (!keeps) return result;
  auto same = ensure_map(result.mesh, attribute::joined);
  for (std::size_t v = 0; v < own; ++v)
    if (into[v].idx() != v) same[Vertex(Vertex::size_type(v))] = int(into[v]);
  return result;
}

}  // namespace

MeshFile welded(const MeshFile& file, const std::string& name) {
  require_triangles(file.mesh, "weld");
  MeshFile result = rebuilt_at_places(file, name, {});
  const BorderSeams seams = find_border_seams(result.mesh);
  if (!seams.any()) return result;
  result = rebuilt_at_places(result, name, seams);
  result.repairs.merged_vertices = file.mesh->number_of_vertices() + result.repairs.duplicated_vertices -
                                   result.mesh->number_of_vertices();
  return result;
}

MeshFile with_joined_seams(MeshFile file, const std::string& name) {
  const BorderSeams seams = find_border_seams(file.mesh, {.within_groups = true, .split = false});
  if (!seams.any()) return file;
  MeshFile result = joined(file, name, joined_vertices(file.mesh, seams), seams, false);
  result.warnings.push_back(
      name + ": seams joined that lay open by a rounding: " + std::to_string(seams.apart.size()) +
      " vertices, up to " + length_text(seams.gap) + " apart");
  return result;
}

MeshFile with_seams_as_one(MeshFile file, const std::string& name) {
  if (find_map(file.mesh, attribute::rest_length)) return file;
  const BorderSeams seams = find_border_seams(file.mesh, {.closed = true});
  if (!seams.any()) return file;
  const std::vector<Vertex> into = joined_vertices(file.mesh, seams);
  std::size_t count = 0;
  for (std::size_t v = 0; v < into.size(); ++v) count += into[v].idx() != v;
  MeshFile result = joined(file, name, into, seams, true);
  result.polylines = std::move(file.polylines);
  result.warnings.push_back(name + ": seams joined that its file leaves open: " + std::to_string(count) +
                            " vertices, up to " + length_text(seams.gap) + " from the other side, and " +
                            std::to_string(seams.splits.size()) + " amid an edge of it");
  return result;
}

}  // namespace furrow::io
