// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/mesh/soup_to_mesh.h"

#include <algorithm>
#include <array>
#include <functional>
#include <map>
#include <numeric>
#include <optional>
#include <span>
#include <utility>

#include "geometry/mesh/add_all_faces.h"
#include "geometry/mesh/errors.h"
#include "geometry/mesh/vertex_attributes.h"
#include "io/mesh/make_manifold.h"
#include "io/mesh/triangulate_polygon.h"

namespace furrow::io {
namespace {

using namespace geometry;
using Triangles = std::vector<SoupTriangle>;

std::string place_of_face(const PolygonSoup& soup, const std::string& name, std::size_t face) {
  if (!soup.face_lines.empty()) return name + ":" + std::to_string(soup.face_lines[face]) + ": ";
  return name + ": face " + std::to_string(face) + ": ";
}

void check_corners(const PolygonSoup& soup, const std::string& name) {
  for (std::size_t f = 0; f < soup.faces(); ++f)
    for (std::size_t c = soup.first_corner[f]; c < soup.first_corner[f + 1]; ++c)
      if (soup.corners[c] >= soup.points.size())
        throw ContentError(place_of_face(soup, name, f) + "a corner names a vertex beyond the last of " +
                           std::to_string(soup.points.size()) + "; correct the index or add the vertex");
}

Triangles cut_faces(const PolygonSoup& soup, const std::string& name, RepairReport& repairs) {
  Triangles triangles;
  triangles.reserve(soup.corners.size() - std::min(soup.corners.size(), 2 * soup.faces()));
  std::vector<Point> points;
  std::vector<std::array<std::size_t, 3>> cut;
  for (std::size_t f = 0; f < soup.faces(); ++f) {
    const std::size_t first = soup.first_corner[f], last = soup.first_corner[f + 1];
    points.clear();
    for (std::size_t c = first; c < last; ++c) points.push_back(soup.points[soup.corners[c]]);
    cut.clear();
    try {
      triangulate_polygon(points, cut);
    } catch (const ContentError& error) {
      throw ContentError(place_of_face(soup, name, f) + error.what());
    }
    if (last - first > 3) ++repairs.triangulated_faces;
    if (last - first < 3) ++repairs.degenerate_faces;
    for (const auto& [i, j, k] : cut)
      triangles.push_back({{soup.corners[first + i], soup.corners[first + j], soup.corners[first + k]},
                           {first + i, first + j, first + k},
                           f});
  }
  return triangles;
}

void drop_degenerate(Triangles& triangles, RepairReport& repairs) {
  repairs.degenerate_faces += std::erase_if(triangles, [](const SoupTriangle& t) {
    return t.points[0] == t.points[1] || t.points[1] == t.points[2] || t.points[2] == t.points[0];
  });
}

/// The points round a face, from the least on, as it is wound or the other way.
std::vector<std::size_t> ring(const PolygonSoup& soup, std::size_t f, bool turned) {
  std::vector<std::size_t> points(soup.corners.begin() + std::ptrdiff_t(soup.first_corner[f]),
                                  soup.corners.begin() + std::ptrdiff_t(soup.first_corner[f + 1]));
  if (turned) std::reverse(points.begin(), points.end());
  std::rotate(points.begin(), std::min_element(points.begin(), points.end()), points.end());
  return points;
}

/// Whether a face has the texture coordinates of another one with the same points.
bool has_textures_of(const PolygonSoup& soup, std::size_t f, std::size_t other) {
  if (soup.textures.empty()) return true;
  for (std::size_t c = soup.first_corner[f]; c < soup.first_corner[f + 1]; ++c) {
    const auto first = soup.corners.begin() + std::ptrdiff_t(soup.first_corner[other]);
    const auto same = std::find(first, soup.corners.end(), soup.corners[c]) - soup.corners.begin();
    if (soup.textures[c] != soup.textures[std::size_t(same)]) return false;
  }
  return true;
}

/// Takes off linings: faces that are the first back of an earlier one in another material. Returns that
/// material by face, -1 where there is none; empty: nowhere.
std::vector<int> take_linings(const PolygonSoup& soup, Triangles& triangles, RepairReport& repairs) {
  std::vector<int> linings;
  const std::vector<int>& material = soup.materials;
  if (std::ranges::adjacent_find(material, std::ranges::not_equal_to()) == material.end()) return linings;
  std::vector<char> taken(soup.faces(), 0);
  std::map<std::vector<std::size_t>, std::size_t> fronts;
  for (std::size_t f = 0; f < soup.faces(); ++f) {
    if (soup.first_corner[f] == soup.first_corner[f + 1]) continue;
    const auto front = fronts.find(ring(soup, f, true));
    if (front == fronts.end()) {
      fronts.emplace(ring(soup, f, false), f);
    } else if (material[f] >= 0 && material[f] != material[front->second]) {
      linings.resize(soup.faces(), -1);
      if (linings[front->second] >= 0) continue;  // it has one: this one is a duplicate
      linings[front->second] = material[f];
      repairs.lining_textures += !has_textures_of(soup, f, front->second);
      taken[f] = 1;
    }
  }
  std::erase_if(triangles, [&](const SoupTriangle& t) { return taken[t.face] != 0; });
  return linings;
}

void drop_duplicates(Triangles& triangles, RepairReport& repairs) {
  std::vector<std::pair<std::array<std::size_t, 3>, std::size_t>> keys(triangles.size());
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    keys[t] = {triangles[t].points, t};
    std::sort(keys[t].first.begin(), keys[t].first.end());
  }
  std::sort(keys.begin(), keys.end());
  std::vector<char> drop(triangles.size(), 0);
  for (std::size_t i = 1; i < keys.size(); ++i) drop[keys[i].second] = keys[i].first == keys[i - 1].first;
  std::size_t kept = 0;
  for (std::size_t t = 0; t < triangles.size(); ++t)
    if (!drop[t]) triangles[kept++] = triangles[t];
  repairs.duplicate_faces += triangles.size() - kept;
  triangles.resize(kept);
}

/// Whether all faces around each vertex are one fan; add_face() lets two fans share a vertex.
bool has_one_fan_per_vertex(const Mesh& mesh) {
  std::vector<std::size_t> corners(mesh.number_of_vertices(), 0);
  for (const Face f : mesh.faces())
    for (const Vertex v : mesh.vertices_around_face(mesh.halfedge(f))) ++corners[v];
  for (const Vertex v : mesh.vertices()) {
    if (mesh.is_isolated(v)) continue;
    std::size_t faces = 0, borders = 0;
    for (const Halfedge h : mesh.halfedges_around_target(mesh.halfedge(v)))
      ++(mesh.is_border(h) ? borders : faces);
    if (faces != corners[v] || borders > 1) return false;
  }
  return true;
}

/// False if some face does not fit into an oriented manifold.
bool build(const PolygonSoup& soup, const Triangles& triangles, SoupMesh& out) {
  out.mesh.clear();
  out.mesh.reserve(static_cast<Mesh::size_type>(out.origin.size()),
                   static_cast<Mesh::size_type>(triangles.size() * 3 / 2 + 16),
                   static_cast<Mesh::size_type>(triangles.size()));
  for (const std::size_t point : out.origin) out.mesh.add_vertex(soup.points[point]);
  std::vector<CornerIndices> corners;
  for (const SoupTriangle& t : triangles) corners.push_back(t.points);
  if (has_crowded_point(corners, out.origin.size()))
    return add_all_faces<Mesh>(corners, out.mesh) && has_one_fan_per_vertex(out.mesh);
  for (const SoupTriangle& t : triangles) {
    const auto vertex = [&](int k) { return Vertex(static_cast<Mesh::size_type>(t.points[k])); };
    if (out.mesh.add_face(vertex(0), vertex(1), vertex(2)) == Mesh::null_face()) return false;
  }
  return has_one_fan_per_vertex(out.mesh);
}

template <class K, class V, class Values>
void fill_vertex_map(SoupMesh& out, const PropertyName<K, V>& name, const Values& values) {
  if (values.empty()) return;
  auto map = ensure_map(out.mesh, name);
  for (const Vertex v : out.mesh.vertices()) map[v] = values[out.origin[v]];
}

/// Texture coordinates of corners, and rest lengths of edges that are a face's own.
void fill_corners(const PolygonSoup& soup, const Triangles& triangles, Mesh& mesh) {
  std::optional<HalfedgeMap<TextureCoordinate>> textures, second_textures;
  std::optional<HalfedgeMap<double>> rest_lengths;
  if (!soup.textures.empty()) textures = ensure_map(mesh, attribute::texture);
  if (!soup.second_textures.empty()) second_textures = ensure_map(mesh, attribute::second_texture);
  if (!soup.triangle_rest_lengths.empty()) rest_lengths = ensure_map(mesh, attribute::triangle_rest_length);
  if (!textures && !second_textures && !rest_lengths) return;
  for (const Face f : mesh.faces())
    for (const Halfedge h : mesh.halfedges_around_face(mesh.halfedge(f))) {
      const auto corner_at = [&](std::size_t v) {
        const SoupTriangle& t = triangles[f];
        return t.corners[t.points[0] == v ? 0 : t.points[1] == v ? 1 : 2];
      };
      const std::size_t to = corner_at(mesh.target(h)), from = corner_at(mesh.source(h));
      if (textures) (*textures)[h] = soup.textures[to];
      if (second_textures) (*second_textures)[h] = soup.second_textures[to];
      // The corner before the other one on the way round; a face that was turned over is walked backwards.
      const std::size_t low = std::min(from, to), high = std::max(from, to);
      if (rest_lengths) (*rest_lengths)[h] = soup.triangle_rest_lengths[high - low == 1 ? low : high];
    }
}

/// Where a face of four corners was cut.
void mark_diagonals(const PolygonSoup& soup, const Triangles& triangles, Mesh& mesh) {
  const auto is_quad = [&](std::size_t f) { return soup.first_corner[f + 1] - soup.first_corner[f] == 4; };
  if (std::ranges::none_of(triangles, [&](const SoupTriangle& t) { return is_quad(t.face); })) return;
  auto diagonal = ensure_map(mesh, attribute::diagonal);
  for (const Edge e : mesh.edges()) {
    if (mesh.is_border(e)) continue;
    const std::size_t a = triangles[mesh.face(mesh.halfedge(e))].face,
                      b = triangles[mesh.face(mesh.opposite(mesh.halfedge(e)))].face;
    diagonal[e] = a == b && is_quad(a);
  }
}

void fill_face_map(Mesh& mesh, const Triangles& triangles, const PropertyName<Face, int>& name,
                   const std::vector<int>& values) {
  if (values.empty()) return;
  auto map = ensure_map(mesh, name);
  for (const Face f : mesh.faces()) map[f] = values[triangles[f].face];
}

void fill_maps(const PolygonSoup& soup, const Triangles& triangles, const std::vector<int>& linings,
               SoupMesh& out) {
  fill_vertex_map(out, attribute::color, soup.colors);
  for (const SoupAttribute& attribute : soup.attributes) {
    auto values = ensure_vertex_attribute(out.mesh, attribute.name);
    for (const Vertex v : out.mesh.vertices()) values[v] = attribute.values[out.origin[v]];
  }
  Mesh& mesh = out.mesh;
  fill_face_map(mesh, triangles, attribute::group, soup.groups);
  fill_face_map(mesh, triangles, attribute::material, soup.materials);
  fill_face_map(mesh, triangles, attribute::lining, linings);
  fill_corners(soup, triangles, mesh);
  mark_diagonals(soup, triangles, mesh);
}

/// Drops triangles of faces of four corners and more whose corners are those of an earlier one: the back of a
/// garment with two sides, cut along its other diagonal. False if there are none.
bool drop_backs(const PolygonSoup& soup, Triangles& triangles, RepairReport& repairs) {
  std::vector<std::pair<std::vector<std::size_t>, std::size_t>> keys;
  for (std::size_t f = 0; f < soup.faces(); ++f) {
    if (soup.first_corner[f + 1] - soup.first_corner[f] < 4) continue;
    keys.push_back({{soup.corners.begin() + std::ptrdiff_t(soup.first_corner[f]),
                     soup.corners.begin() + std::ptrdiff_t(soup.first_corner[f + 1])},
                    f});
    std::sort(keys.back().first.begin(), keys.back().first.end());
  }
  std::sort(keys.begin(), keys.end());
  std::vector<char> drop(soup.faces(), 0);
  std::size_t dropped = 0;
  for (std::size_t i = 1; i < keys.size(); ++i)
    if (keys[i].first == keys[i - 1].first) drop[keys[i].second] = 1, ++dropped;
  if (dropped == 0) return false;
  std::erase_if(triangles, [&](const SoupTriangle& t) { return drop[t.face] != 0; });
  repairs.duplicate_faces += dropped;
  return true;
}

[[noreturn]] void refuse_without_faces(const PolygonSoup& soup, const std::string& name) {
  if (soup.faces() == 0 && soup.has_lines)
    throw ContentError(name +
                       ": no faces, only lines: a chain, which `furrow simulate` moves; here a mesh with at "
                       "least one triangle is needed");
  throw ContentError(name + ": no faces" + (soup.faces() ? " but degenerate ones" : "") +
                     "; a mesh with at least one triangle is needed");
}

}  // namespace

SoupMesh soup_to_mesh(const PolygonSoup& soup, const std::string& name, bool chains) {
  check_corners(soup, name);
  SoupMesh out;
  Triangles triangles = cut_faces(soup, name, out.repairs);
  drop_degenerate(triangles, out.repairs);
  const std::vector<int> linings = take_linings(soup, triangles, out.repairs);
  drop_duplicates(triangles, out.repairs);
  const bool chain = chains && soup.has_lines && soup.faces() == 0;
  if (triangles.empty() && !chain) refuse_without_faces(soup, name);
  out.origin.resize(soup.points.size());
  std::iota(out.origin.begin(), out.origin.end(), std::size_t{0});
  if (!build(soup, triangles, out) &&
      !(drop_backs(soup, triangles, out.repairs) && build(soup, triangles, out))) {
    const ManifoldReport parted = make_manifold(triangles, soup.points.size());
    out.repairs.reversed_faces = parted.reversed_faces;
    out.repairs.duplicated_vertices = parted.added_points.size();
    out.origin.insert(out.origin.end(), parted.added_points.begin(), parted.added_points.end());
    if (!build(soup, triangles, out))
      throw ContentError(name +
                         ": the faces cannot be parted into a manifold; repair the mesh in a modeller");
  }
  for (const SoupTriangle& t : triangles) out.face_origin.push_back(t.face);
  fill_maps(soup, triangles, linings, out);
  if (!chain)
    for (const Vertex v : out.mesh.vertices()) out.repairs.isolated_vertices += out.mesh.is_isolated(v);
  return out;
}

}  // namespace furrow::io
